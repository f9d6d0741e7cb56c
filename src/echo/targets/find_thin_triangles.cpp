// find_thin_triangles.cpp -- measures the thickness of bodies by rays through them.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "echo/targets/thin_parts.h"

namespace insonify {
namespace {

constexpr float kThinnest = 1e-4F;  // Rays start this far from a surface [m].
constexpr int kAcross =
    8;  // Directions across the normal in which the extent is measured; the least is at most 2 % too large.
constexpr int kOthers = 3;       // Most surfaces of other instances that a ray passes.
constexpr double kWidest = 1.5;  // Triangles of greater altitude than this, in kThickest, are not sides of thin parts.
constexpr float kShortest = 3,
                kLongest = 24;           // Length of pieces [thicknesses]: doubled until they are at most kMostPieces.
constexpr std::size_t kTogether = 4096;  // Triangles measured together.

// A triangle in world coordinates.
struct Wall {
  std::uint32_t triangle;
  Vec3 middle, normal;  // The normal points outwards, by the winding.
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

Ray probe_ray(const Vec3& from, const Vec3& direction) {
  return {from, direction, double{kThinnest}, double{ThinParts::kThickest}};
}

// Triangles that are narrow enough to be sides of a thin part.
std::vector<Wall> walls_of(const Instance& instance) {
  const Mesh& mesh = *instance.mesh;
  std::vector<Wall> walls;
  walls.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (const std::size_t slot = mesh.slot_of(t); slot < instance.reliefs.size() && instance.reliefs[slot] != nullptr) {
      continue;
    }
    std::array<Vec3, 3> corners;
    for (int k = 0; k < 3; ++k) {
      corners[k] = instance.world_from_mesh * mesh.vertices[mesh.triangles[t][k]].cast<double>().eval();
    }
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double edge = std::max(
        {(corners[1] - corners[0]).norm(), (corners[2] - corners[1]).norm(), (corners[0] - corners[2]).norm()});
    const double length = normal.norm();
    if (length > 0 && length < kWidest * double{ThinParts::kThickest} * edge) {
      walls.push_back({t, (corners[0] + corners[1] + corners[2]) / 3, normal / length});
    }
  }
  return walls;
}

}  // namespace

std::vector<ThinTriangle> find_thin_triangles(const Scene& scene, int index, Engine& engine) {
  const Instance& instance = scene.instances[index];
  const std::vector<Wall> walls = walls_of(instance);
  std::vector<ThinTriangle> thin;
  Probe through(index, engine), across(index, engine);
  std::vector<Ray> rays, cross_rays;
  std::vector<std::pair<const Wall*, double>> near;  // Walls with an opposite wall within kThickest, and its distance.
  for (std::size_t first = 0; first < walls.size(); first += kTogether) {
    const std::span<const Wall> some(&walls[first], std::min(kTogether, walls.size() - first));
    rays.clear();
    for (const Wall& wall : some) {
      rays.push_back(probe_ray(wall.middle, -wall.normal));
    }
    const std::span<const double> depths = through.distances(rays);
    near.clear();
    cross_rays.clear();
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (!std::isfinite(depths[i])) {
        continue;
      }
      near.emplace_back(&some[i], depths[i]);
      const Vec3 inside = some[i].middle - 0.5 * depths[i] * some[i].normal;
      const Vec3 one = some[i].normal.unitOrthogonal(), two = some[i].normal.cross(one);
      for (int k = 0; k < kAcross; ++k) {
        const double angle = std::numbers::pi * k / kAcross;
        const Vec3 direction = std::cos(angle) * one + std::sin(angle) * two;
        cross_rays.push_back(probe_ray(inside, direction));
        cross_rays.push_back(probe_ray(inside, -direction));
      }
    }
    const std::span<const double> sides = across.distances(cross_rays);
    for (std::size_t i = 0; i < near.size(); ++i) {
      const auto& [wall, depth] = near[i];
      const auto width_in = [&](std::size_t k) {
        return sides[2 * (kAcross * i + k)] + sides[2 * (kAcross * i + k) + 1];
      };
      std::size_t narrowest = 0;
      for (std::size_t k = 1; k < kAcross; ++k) {
        narrowest = width_in(k) < width_in(narrowest) ? k : narrowest;
      }
      const double thickness = std::max(depth, width_in(narrowest));
      if (thickness < double{ThinParts::kThickest}) {
        const Vec3 axis = instance.world_from_mesh.orientation.conjugate() *
                          wall->normal.cross(cross_rays[2 * (kAcross * i + narrowest)].direction);
        int along = 0;
        axis.cwiseAbs().maxCoeff(&along);
        thin.push_back({wall->triangle, static_cast<float>(thickness), along});
      }
    }
  }
  return thin;
}

ThinParts find_thin_parts(const Scene& scene, Engine& engine) {
  ThinParts parts;
  LeftOut triangles;
  triangles.thickness.resize(scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (!instance.present || instance.endless) {
      continue;
    }
    std::vector<ThinTriangle> thin = find_thin_triangles(scene, static_cast<int>(i), engine);
    // Thickness is rounded up to quarter octaves, so that a piece and its triangles pass to the lattice at the same
    // range.
    for (ThinTriangle& triangle : thin) {
      triangle.thickness = 1e-3F * std::exp2(0.25F * std::ceil(4 * std::log2(triangle.thickness / 1e-3F)));
    }
    if (thin.empty()) {
      continue;
    }
    float slab = kShortest;
    while (slab <= kLongest && !cut_thin_triangles(instance, static_cast<int>(i), thin, slab, parts)) {
      slab *= 2;
    }
    if (slab > kLongest) {
      parts.left_out.push_back(instance.name);
      continue;
    }
    triangles.thickness[i].assign(instance.mesh->triangles.size(), std::numeric_limits<float>::infinity());
    for (const ThinTriangle& triangle : thin) {
      triangles.thickness[i][triangle.triangle] = triangle.thickness;
    }
  }
  if (!parts.pieces.empty()) {
    parts.triangles = std::make_shared<const LeftOut>(std::move(triangles));
  }
  return parts;
}

}  // namespace insonify
