// find_corners.cpp -- measures the octants around the common point of three perpendicular mirrors.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "echo/targets/corners.h"
#include "echo/targets/mirror_crossings.h"
#include "echo/targets/mirror_tree.h"

namespace insonify {
namespace {

constexpr std::size_t kFew = 32;  // Triangles of a mirror that are tried one by one, without the tree.
constexpr double kMargin = 1e-5;  // Enlarges triangles on each side, so that rays along a shared side hit one [m].

// Parameters at which a ray from the apex enters and leaves a triangle; first > second if it misses. All in coordinates
// along the mirror's two axes.
std::pair<double, double> within(const std::array<Eigen::Vector2d, 3>& corners, const Eigen::Vector2d& ray) {
  const Eigen::Vector2d a = corners[1] - corners[0], b = corners[2] - corners[0];
  const double turn = a.x() * b.y() - a.y() * b.x() > 0 ? 1 : -1;
  double from = 0, to = double{Corner::kEndless};
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d side = (corners[(k + 1) % 3] - corners[k]).normalized();
    const Eigen::Vector2d inwards = turn * Eigen::Vector2d(-side.y(), side.x());
    const double start = kMargin - inwards.dot(corners[k]), rate = inwards.dot(ray);
    if (rate > 0) {
      from = std::max(from, -start / rate);
    } else if (rate < 0) {
      to = std::min(to, start / -rate);
    } else if (start < 0) {
      return {1, 0};
    }
  }
  return {from, to};
}

// One quarter of a mirror around the apex.
class Quarter {
 public:
  // @param here      The mirror's triangles near the apex, in order.
  // @param one, two  Unit vectors along the edges that bound it.
  Quarter(const PlaneMirror& mirror, std::uint32_t number, std::span<const std::uint32_t> here, const Vec3& apex,
          const Vec3& one, const Vec3& two)
      : mirror_(&mirror), number_(number), apex_(apex), one_(one), two_(two) {
    if (mirror.endless) {
      surface_ = mirror.water;
      exists_ = true;
      return;
    }
    const Vec3 inside = apex + Corner::kLeastEdge * (one + two);
    for (const std::uint32_t i : here) {
      const PlaneMirror::Triangle& triangle = mirror.triangles[i];
      if (mirror.contains(triangle, inside, kMargin)) {
        exists_ = true;
        surface_ = triangle.surface;
        normal_ = triangle.front ? mirror.normal : Vec3(-mirror.normal);
        return;
      }
    }
  }

  [[nodiscard]] bool exists() const { return exists_; }
  [[nodiscard]] SurfaceLabel surface() const { return surface_; }
  [[nodiscard]] const Vec3& normal() const { return normal_; }  // By the winding at the apex; 0 for water.

  // Extents as in Corner::extents.
  [[nodiscard]] std::array<float, Corner::kSteps + 1> extents(const MirrorTree& tree) const {
    std::array<float, Corner::kSteps + 1> extents;
    extents.fill(Corner::kEndless);
    for (int step = 0; step <= Corner::kSteps && !mirror_->endless; ++step) {
      // Slightly off the edges, along which triangles of the neighbouring quarters end.
      constexpr double kOff = 1e-3;
      const double share = std::clamp(static_cast<double>(step) / Corner::kSteps, kOff, 1 - kOff);
      extents[step] = static_cast<float>(extent_along({1 - share, share}, tree));
    }
    return extents;
  }

 private:
  // Whether a ray from the apex may meet a triangle of the mirror in a box, within a limit.
  [[nodiscard]] bool meets(const Eigen::Vector2d& ray, double limit, const MirrorBox& box) const {
    const Vec3 middle = box.middle(), half = box.half();
    if (std::abs(mirror_->normal.dot(middle) - mirror_->offset) >
        half.dot(mirror_->normal.cwiseAbs()) + kCrossingReach) {
      return false;
    }
    const double u = (middle - apex_).dot(one_), reach_u = half.dot(one_.cwiseAbs());
    const double v = (middle - apex_).dot(two_), reach_v = half.dot(two_.cwiseAbs());
    const double enters = std::max((u - reach_u) / ray.x(), (v - reach_v) / ray.y());
    const double leaves = std::min((u + reach_u) / ray.x(), (v + reach_v) / ray.y());
    return enters <= std::min(leaves, limit) && leaves >= 0;
  }

  // Intervals of a ray from the apex on the mirror's triangles, in order; all that begin within the limit.
  void find_parts(const Eigen::Vector2d& ray, double limit, const MirrorTree& tree,
                  std::vector<std::pair<double, double>>& parts) const {
    parts.clear();
    const auto add = [&](const PlaneMirror::Triangle& triangle) {
      const auto flat = [&](int k) -> Eigen::Vector2d {
        const Vec3 place = triangle.corners[k] - apex_;
        return {place.dot(one_), place.dot(two_)};
      };
      if (const auto part = within({flat(0), flat(1), flat(2)}, ray); part.first < part.second) {
        parts.push_back(part);
      }
    };
    if (mirror_->triangles.size() <= kFew) {
      std::ranges::for_each(mirror_->triangles, add);
    } else {
      tree.visit(
          [&](const MirrorBox& box) {
            return (box.mirror == number_ || box.mirror == MirrorBox::kSeveral) && meets(ray, limit, box);
          },
          [&](const MirrorTree::Item& item) {
            if (item.box.mirror == number_) {
              add(mirror_->triangles[item.triangle]);
            }
          });
    }
    std::ranges::sort(parts);
  }

  // Where the mirror first ends along a ray from the apex. The ray's components add up to 1.
  [[nodiscard]] double extent_along(const Eigen::Vector2d& ray, const MirrorTree& tree) const {
    std::vector<std::pair<double, double>> parts;
    for (double limit = 1;; limit *= 16) {
      find_parts(ray, limit, tree, parts);
      double end = 0;
      for (const auto& [from, to] : parts) {
        if (from > end + Corner::kGap) {
          break;
        }
        end = std::max(end, to);
      }
      if (end + Corner::kGap < limit || limit > double{Corner::kEndless}) {
        return std::min(end, double{Corner::kEndless});
      }
    }
  }

  const PlaneMirror* mirror_;
  std::uint32_t number_;
  Vec3 apex_, one_, two_;
  bool exists_ = false;
  SurfaceLabel surface_ = 0;
  Vec3 normal_ = Vec3::Zero();
};

// Adds those of the eight octants around a crossing in which all three mirrors exist.
void add_octants(const Crossing& crossing, const std::vector<PlaneMirror>& mirrors, const MirrorTree& tree,
                 int instance, std::vector<Corner>& corners) {
  std::array<std::vector<std::uint32_t>, 3> here;  // Triangles near the apex.
  const Vec3f apex = crossing.apex.cast<float>();
  tree.visit(
      [&](const MirrorBox& box) {
        return box.meets({apex, apex});
      },
      [&](const MirrorTree::Item& item) {
        for (int k = 0; k < 3; ++k) {
          if (item.box.mirror == crossing.mirrors[k]) {
            here[k].push_back(item.triangle);
          }
        }
      });
  std::array<std::vector<Quarter>, 3> quarters;  // [mirror][signs of the two axes]
  for (int k = 0; k < 3; ++k) {
    std::ranges::sort(here[k]);
    for (int signs = 0; signs < 4; ++signs) {
      quarters[k].emplace_back(mirrors[crossing.mirrors[k]], crossing.mirrors[k], here[k], crossing.apex,
                               (signs & 1 ? -1.0 : 1.0) * crossing.axes.col((k + 1) % 3),
                               (signs & 2 ? -1.0 : 1.0) * crossing.axes.col((k + 2) % 3));
    }
    if (std::ranges::none_of(quarters[k], &Quarter::exists)) {
      return;
    }
  }
  for (int octant = 0; octant < 8; ++octant) {
    const auto quarter_of = [&](int k) -> const Quarter& {
      return quarters[k][(octant >> (k + 1) % 3 & 1) + 2 * (octant >> (k + 2) % 3 & 1)];
    };
    Corner corner{.instance = instance, .apex = crossing.apex, .from_behind = true};
    bool whole = true;
    for (int k = 0; k < 3; ++k) {
      corner.axes.col(k) = (octant >> k & 1 ? -1.0 : 1.0) * crossing.axes.col(k);
      const Quarter& quarter = quarter_of(k);
      const bool above_water = mirrors[crossing.mirrors[k]].endless && corner.axes.col(k).z() > 0;
      whole = whole && quarter.exists() && !above_water;
      corner.surfaces[k] = quarter.surface();
      corner.from_behind = corner.from_behind && quarter.normal().dot(corner.axes.col(k)) < 0;
    }
    if (whole) {
      for (int k = 0; k < 3; ++k) {
        corner.extents[k] = quarter_of(k).extents(tree);
      }
      corners.push_back(corner);
    }
  }
}

// Size by which corners are ranked: square of the smallest mirror's mean extent [m^2].
double size_of(const Corner& corner) {
  double size = double{Corner::kEndless} * double{Corner::kEndless};
  for (const auto& extents : corner.extents) {
    double mean = 0;
    for (const float extent : extents) {
      mean += double{extent} / (Corner::kSteps + 1);
    }
    size = std::min(size, mean * mean);
  }
  return size;
}

void add_corners(const std::vector<PlaneMirror>& mirrors, int instance, Workers& workers, std::vector<Corner>& all) {
  const MirrorTree tree(mirrors, kMargin, kCrossingReach, workers);
  const std::vector<Crossing> crossings = find_crossings(mirrors, tree, workers);
  std::vector<std::vector<Corner>> found(crossings.size());
  workers.for_each(static_cast<int>(crossings.size()),
                   [&](int i, int) { add_octants(crossings[i], mirrors, tree, instance, found[i]); });
  std::vector<Corner> corners;
  for (std::vector<Corner>& some : found) {
    corners.insert(corners.end(), some.begin(), some.end());
    std::vector<Corner>().swap(some);
  }
  std::ranges::stable_sort(corners, [](const Corner& a, const Corner& b) {
    return std::pair(!a.from_behind, size_of(a)) > std::pair(!b.from_behind, size_of(b));
  });
  corners.resize(std::min(corners.size(), Corner::kMost));
  all.insert(all.end(), corners.begin(), corners.end());
}

PlaneMirror mirror_of(const WaterMirror& water) {
  constexpr double kFar = 1e9;
  PlaneMirror mirror;
  mirror.offset = water.level;
  mirror.low = {-kFar, -kFar, water.level};
  mirror.high = {kFar, kFar, water.level};
  mirror.endless = true;
  mirror.water = water.surface;
  return mirror;
}

}  // namespace

std::vector<Corner> find_corners(const Scene& scene, std::vector<PlaneMirror>& still,
                                 const std::optional<WaterMirror>& water, Workers& workers) {
  std::vector<Corner> corners;
  if (water) {
    still.push_back(mirror_of(*water));
  }
  add_corners(still, -1, workers, corners);
  if (water) {
    still.pop_back();
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (instance.moving && instance.present && !instance.endless) {
      add_corners(find_plane_mirrors(scene, static_cast<int>(i), workers), static_cast<int>(i), workers, corners);
    }
  }
  return corners;
}

}  // namespace insonify
