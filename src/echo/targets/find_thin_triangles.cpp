// find_thin_triangles.cpp -- measures the thickness of bodies by rays through them.

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/parallel_blocks.h"
#include "echo/targets/alike.h"
#include "echo/targets/thin_parts.h"
#include "scene/same_places.h"

namespace insonify {
namespace {

constexpr float kThinnest = 1e-4F;  // Rays start this far from a surface [m].
constexpr int kAcross =
    8;  // Directions across the normal in which the extent is measured; the least is at most 2 % too large.
constexpr int kOthers = 3;  // Most surfaces of other instances that a ray passes.
constexpr double kMostAltitude =
    1.5;                        // Triangles of greater altitude than this, in Wall::reach, are not sides of thin parts.
constexpr double kRound = 1;    // Least change of the normal of a round surface over the body's depth [rad].
constexpr float kEven = 1e-3F;  // Differences of unit normals below this are rounding.
constexpr float kShortest = 3,
                kLongest = 24;           // Length of pieces [thicknesses]: doubled until they are at most kMostPieces.
constexpr std::size_t kTogether = 4096;  // Triangles measured together.

// A triangle in world coordinates.
struct Wall {
  std::uint32_t triangle;
  Vec3 middle, normal;  // The normal points outwards, by the winding.
  double curvature;     // Change of the vertices' normals per length, along the edge where it is greatest [rad/m].
  Vec3 around;          // That change: a direction around the body, of any length.
  // Whether a body up to kThickestRound thick may be round here.
  [[nodiscard]] bool is_round() const { return curvature * double{ThinParts::kThickestRound} >= kRound; }
  // Greatest thickness of a part with this side [m].
  [[nodiscard]] double reach() const { return double{is_round() ? ThinParts::kThickestRound : ThinParts::kThickest}; }
  // Distance from the surface at which rays into the body start [m]: more than coordinates are rounded by.
  [[nodiscard]] double clearance() const {
    return is_round() ? std::max(double{kThinnest}, 0.02 / curvature) : double{kThinnest};
  }
  [[nodiscard]] bool may_be_thin(double depth) const {
    return depth < double{ThinParts::kThickest} || curvature * depth >= kRound;
  }
};

// Traces rays to the first surface of one instance, through those of others.
class Probe {
 public:
  Probe(int instance, Engine& engine) : instance_(instance), engine_(engine) {}

  std::span<const double> distances(std::vector<Ray>& rays) {
    hits_.resize(rays.size());
    distances_.assign(rays.size(), std::numeric_limits<double>::infinity());
    for (int pass = 0; pass <= kOthers && !rays.empty(); ++pass) {
      engine_.trace(rays, hits_);
      bool any = false;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit& hit = hits_[i];
        if (!std::isfinite(hit.distance)) {
          continue;
        }
        if (hit.instance == instance_) {
          distances_[i] = hit.distance;
          rays[i].max_distance = 0;
        } else {
          rays[i].min_distance = hit.distance + double{kThinnest};
          any = true;
        }
      }
      if (!any) {
        break;
      }
    }
    return distances_;
  }

 private:
  int instance_;
  Engine& engine_;
  std::vector<Hit> hits_;
  std::vector<double> distances_;
};

Ray probe_ray(const Vec3& from, const Vec3& direction, const Wall& wall) {
  return {from, direction, wall.clearance(), wall.reach()};
}

// A triangle, if it is narrow enough to be a side of a thin part.
std::optional<Wall> wall_of(const Instance& instance, std::uint32_t t) {
  const Mesh& mesh = *instance.mesh;
  if (const std::size_t slot = mesh.slot_of(t); slot < instance.reliefs.size() && instance.reliefs[slot] != nullptr) {
    return {};
  }
  std::array<Vec3, 3> corners;
  for (int k = 0; k < 3; ++k) {
    corners[k] = instance.world_from_mesh * mesh.vertices[mesh.triangles[t][k]].cast<double>().eval();
  }
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double length = normal.norm();
  double longest = 0, curvature = 0;
  Vec3 around = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const double edge = (corners[next] - corners[k]).norm();
    const Vec3f change = mesh.normals[mesh.triangles[t][next]] - mesh.normals[mesh.triangles[t][k]];
    const float turn = change.norm();
    longest = std::max(longest, edge);
    if (turn > kEven && double{turn} > curvature * edge) {
      curvature = double{turn} / edge;
      around = change.cast<double>();
    }
  }
  const Wall wall{t, (corners[0] + corners[1] + corners[2]) / 3, normal / length, curvature,
                  instance.world_from_mesh.orientation * around};
  return length > 0 && length < kMostAltitude * wall.reach() * longest ? std::optional(wall) : std::nullopt;
}

// A wall with an opposite wall within reach, and the pairs of rays across from half-way between them. Where the body is
// deeper than kThickest, and so round, there are two pairs: around the body and along it.
class Near {
 public:
  Near(const Wall& wall, double depth, std::size_t first_ray)
      : wall_(&wall),
        depth_(depth),
        first_ray_(first_ray),
        directions_(depth < double{ThinParts::kThickest} ? kAcross : 2) {}

  [[nodiscard]] std::size_t last_ray() const { return first_ray_ + 2 * static_cast<std::size_t>(directions_); }

  // Sets the rays from first_ray to last_ray().
  void aim(std::vector<Ray>& rays) const {
    const Vec3 inside = wall_->middle - 0.5 * depth_ * wall_->normal;
    const Vec3 turned = wall_->around - wall_->normal.dot(wall_->around) * wall_->normal;
    const Vec3 one = directions_ == 2 ? turned.normalized() : wall_->normal.unitOrthogonal();
    const Vec3 two = wall_->normal.cross(one);
    for (int k = 0; k < directions_; ++k) {
      const double angle = std::numbers::pi * k / directions_;
      const Vec3 direction = std::cos(angle) * one + std::sin(angle) * two;
      rays[first_ray_ + 2 * k] = probe_ray(inside, direction, *wall_);
      rays[first_ray_ + 2 * k + 1] = probe_ray(inside, -direction, *wall_);
    }
  }

  [[nodiscard]] const Wall& wall() const { return *wall_; }

  // The second smallest extent, and the unit vector along the greatest one.
  [[nodiscard]] std::pair<double, Vec3> measure(const std::vector<Ray>& rays, std::span<const double> sides) const {
    const auto width = [&](std::size_t ray) { return sides[ray] + sides[ray + 1]; };
    std::size_t narrowest = first_ray_;
    for (std::size_t ray = first_ray_; ray < last_ray(); ray += 2) {
      narrowest = width(ray) < width(narrowest) ? ray : narrowest;
    }
    const double widest = directions_ == 2 ? std::max(width(first_ray_), width(first_ray_ + 2)) : depth_;
    if (depth_ > widest) {  // At the end of a long body.
      return {widest, wall_->normal};
    }
    return {std::max(depth_, width(narrowest)), wall_->normal.cross(rays[narrowest].direction)};
  }

 private:
  const Wall* wall_;
  double depth_;
  std::size_t first_ray_;
  int directions_;
};

// Of triangles that cover each other, of whatever winding, all are thin where one is, and one has the surface.
// @param first_of  repeated_triangles()
void share_thickness(const std::vector<std::uint32_t>& first_of, std::vector<ThinTriangle>& thin) {
  if (first_of.empty()) {
    return;
  }
  std::map<std::uint32_t, ThinTriangle> found;  // By the first of the triangles that cover each other.
  std::vector<std::uint8_t> known(first_of.size(), 0);
  for (ThinTriangle& triangle : thin) {
    const bool is_new = found.try_emplace(first_of[triangle.triangle], triangle).second;
    triangle.copy = triangle.body >= 0 ? triangle.copy : !is_new;
    known[triangle.triangle] = 1;
  }
  for (std::uint32_t t = 0; t < first_of.size(); ++t) {
    if (const auto other = found.find(first_of[t]); known[t] == 0 && other != found.end()) {
      thin.push_back(other->second);
      thin.back().triangle = t;
      thin.back().copy = true;
    }
  }
}

// Leaves thick round parts that are not compact to the lattice if they are an assembly of many. Returns their pieces if
// all that is thin is such a part, and stays.
ThinParts leave_assemblies(const Instance& instance, int index, std::vector<ThinTriangle>& thin) {
  const auto is_thick = [](const ThinTriangle& triangle) {
    return triangle.body < 0 && triangle.thickness > ThinParts::kThickest;
  };
  std::vector<ThinTriangle> thick;
  std::ranges::copy_if(thin, std::back_inserter(thick), is_thick);
  ThinParts parts;
  if (!cut_thin_triangles(instance, index, thick, kShortest, parts) ||
      parts.pieces.size() > ThinParts::kMostThickPieces) {
    std::erase_if(thin, is_thick);
    return {};
  }
  return thick.size() == thin.size() ? std::move(parts) : ThinParts{};
}

// Adds the pieces of `own`, if there is room for them.
bool append(const ThinParts& own, ThinParts& parts) {
  if (own.pieces.empty() || parts.pieces.size() + own.pieces.size() > ThinParts::kMostPieces) {
    return false;
  }
  const auto patches = static_cast<std::uint32_t>(parts.patches.size());
  for (ThinParts::Piece piece : own.pieces) {
    piece.first_patch += patches;
    piece.last_patch += patches;
    parts.pieces.push_back(piece);
  }
  parts.patches.insert(parts.patches.end(), own.patches.begin(), own.patches.end());
  return true;
}

// Adds the pieces of an instance, or its name where these are too many. Returns the thickness of its triangles.
LeftOut::ByTriangle<float> add_pieces(const Scene& scene, int index, Engine& engine, Workers& workers,
                                      ThinParts& parts) {
  const Instance& instance = scene.instances[index];
  std::vector<ThinTriangle> thin = find_thin_triangles(scene, index, engine, workers);
  // Thickness is rounded up to quarter octaves, so that a piece and its triangles pass to the lattice at the same
  // range.
  for (ThinTriangle& triangle : thin) {
    triangle.thickness = 1e-3F * std::exp2(0.25F * std::ceil(4 * std::log2(triangle.thickness / 1e-3F)));
  }
  const ThinParts round = leave_assemblies(instance, index, thin);
  if (thin.empty()) {
    return nullptr;
  }
  float slab = kShortest;
  while (slab <= kLongest && !append(round, parts) && !cut_thin_triangles(instance, index, thin, slab, parts)) {
    slab *= 2;
  }
  if (slab > kLongest) {
    parts.left_out.push_back(instance.name);
    return nullptr;
  }
  std::vector<float> thickness(instance.mesh->triangles.size(), std::numeric_limits<float>::infinity());
  for (const ThinTriangle& triangle : thin) {
    thickness[triangle.triangle] = triangle.thickness;
  }
  return std::make_shared<const std::vector<float>>(std::move(thickness));
}

// Measures the thickness of one instance at many triangles at a time.
class Gauge {
 public:
  Gauge(const Scene& scene, int index, Engine& engine, Workers& workers)
      : instance_(scene.instances[index]), through_(index, engine), across_(index, engine), workers_(workers) {}

  // Adds those of some triangles that belong to thin parts, and of those before, in their order.
  void measure(std::span<const std::uint32_t> triangles, bool last, std::vector<ThinTriangle>& thin) {
    find_walls(triangles);
    std::size_t first = 0;
    while (walls_.size() - first >= kTogether || (last && first < walls_.size())) {
      const std::size_t count = std::min(kTogether, walls_.size() - first);
      measure(std::span<const Wall>(walls_).subspan(first, count), thin);
      first += count;
    }
    walls_.erase(walls_.begin(), walls_.begin() + static_cast<std::ptrdiff_t>(first));
  }

 private:
  static constexpr std::size_t kTask = 512;  // Triangles of a task.

  void measure(std::span<const Wall> walls, std::vector<ThinTriangle>& thin) {
    rays_.clear();
    for (const Wall& wall : walls) {
      rays_.push_back(probe_ray(wall.middle, -wall.normal, wall));
    }
    const std::span<const double> depths = through_.distances(rays_);
    near_.clear();
    std::size_t cross_rays = 0;
    for (std::size_t i = 0; i < walls.size(); ++i) {
      if (std::isfinite(depths[i]) && walls[i].may_be_thin(depths[i])) {
        near_.emplace_back(walls[i], depths[i], cross_rays);
        cross_rays = near_.back().last_ray();
      }
    }
    cross_rays_.resize(cross_rays);
    for_each_block(workers_, near_.size(), kTask, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        near_[i].aim(cross_rays_);
      }
    });
    const std::span<const double> sides = across_.distances(cross_rays_);
    measured_.resize(near_.size());
    for_each_block(workers_, near_.size(), kTask, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        measured_[i] = thin_at(near_[i], sides);
      }
    });
    for (const std::optional<ThinTriangle>& one : measured_) {
      if (one) {
        thin.push_back(*one);
      }
    }
  }

  // Adds the walls among some triangles.
  void find_walls(std::span<const std::uint32_t> triangles) {
    found_.resize(triangles.size());
    for_each_block(workers_, triangles.size(), kTask, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        found_[i] = wall_of(instance_, triangles[i]);
      }
    });
    for (const std::optional<Wall>& wall : found_) {
      if (wall) {
        walls_.push_back(*wall);
      }
    }
  }

  [[nodiscard]] std::optional<ThinTriangle> thin_at(const Near& part, std::span<const double> sides) const {
    const auto [thickness, along] = part.measure(cross_rays_, sides);
    if (!(thickness < part.wall().reach() && part.wall().may_be_thin(thickness))) {
      return {};
    }
    int coordinate = 0;
    (instance_.world_from_mesh.orientation.conjugate() * along).cwiseAbs().maxCoeff(&coordinate);
    return ThinTriangle{part.wall().triangle, static_cast<float>(thickness), coordinate};
  }

  const Instance& instance_;
  Probe through_, across_;
  Workers& workers_;
  std::vector<std::optional<Wall>> found_;
  std::vector<Wall> walls_;  // Not measured yet.
  std::vector<Near> near_;
  std::vector<Ray> rays_, cross_rays_;
  std::vector<std::optional<ThinTriangle>> measured_;
};

}  // namespace

std::vector<ThinTriangle> find_thin_triangles(const Scene& scene, int index, Engine& engine, Workers& workers) {
  const Instance& instance = scene.instances[index];
  const std::size_t count = instance.mesh->triangles.size();
  const std::vector<std::uint32_t> first_of = repeated_triangles(*instance.mesh, workers);
  std::vector<ThinTriangle> thin = find_compact_bodies(instance, first_of);
  std::vector<std::uint8_t> compact(thin.empty() ? 0 : count, 0);
  for (const ThinTriangle& triangle : thin) {
    compact[triangle.triangle] = 1;
  }
  std::erase_if(thin, [](const ThinTriangle& triangle) { return triangle.thickness >= ThinParts::kThickestRound; });
  Gauge gauge(scene, index, engine, workers);
  std::vector<std::uint32_t> some;
  for (std::uint32_t t = 0; t < count; ++t) {
    if (compact.empty() || compact[t] == 0) {
      some.push_back(t);
    }
    if (some.size() == kTogether || t + 1 == count) {
      gauge.measure(some, t + 1 == count, thin);
      some.clear();
    }
  }
  share_thickness(first_of, thin);
  return thin;
}

ThinParts find_thin_parts(const Scene& scene, Engine& engine, Workers& workers) {
  ThinParts parts;
  LeftOut triangles;
  triangles.thickness.resize(scene.instances.size());
  const std::vector<std::size_t> first = first_alike(scene);
  std::vector<std::pair<std::size_t, std::size_t>> pieces(first.size());  // [instance] The range of its pieces.
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (!instance.present || instance.endless) {
      continue;
    }
    const auto [begin, end] = pieces[first[i]];
    pieces[i].first = parts.pieces.size();
    if (first[i] == i || parts.pieces.size() + (end - begin) > ThinParts::kMostPieces) {
      triangles.thickness[i] = add_pieces(scene, static_cast<int>(i), engine, workers, parts);
    } else {
      triangles.thickness[i] = triangles.thickness[first[i]];
      if (std::ranges::find(parts.left_out, scene.instances[first[i]].name) != parts.left_out.end()) {
        parts.left_out.push_back(instance.name);
      }
      for (std::size_t k = begin; k < end; ++k) {
        ThinParts::Piece piece = parts.pieces[k];
        piece.surface = surface_label(static_cast<std::uint16_t>(i), material_of(piece.surface));
        parts.pieces.push_back(piece);
      }
    }
    pieces[i].second = parts.pieces.size();
  }
  if (!parts.pieces.empty()) {
    parts.triangles = std::make_shared<const LeftOut>(std::move(triangles));
  }
  return parts;
}

}  // namespace insonify
