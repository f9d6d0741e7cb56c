// find_corners.cpp -- tests all triples of perpendicular mirrors that touch, and measures the octants around their
// common point.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "echo/targets/corners.h"

namespace insonify {
namespace {

constexpr double kMargin = 1e-5;  // Enlarges triangles on each side, so that rays along a shared side hit one [m].

// Three perpendicular mirrors: their common point, and axes along their common edges. Mirror k is perpendicular to axis
// k.
struct Crossing {
  Vec3 apex;
  Eigen::Matrix3d axes;
  std::array<const PlaneMirror*, 3> mirrors;
};

bool perpendicular(const PlaneMirror& a, const PlaneMirror& b) {
  return std::abs(a.normal.dot(b.normal)) < Corner::kPerpendicular;
}

bool touch(const PlaneMirror& a, const PlaneMirror& b) {
  return (a.low.array() < b.high.array() + Corner::kGap).all() && (b.low.array() < a.high.array() + Corner::kGap).all();
}

bool may_reach(const PlaneMirror& mirror, const Vec3& point) {
  return (mirror.low.array() < point.array() + Corner::kGap).all() &&
         (point.array() < mirror.high.array() + Corner::kGap).all();
}

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

// One quarter of a mirror around the apex, with extents as in Corner::extents.
class Quarter {
 public:
  // @param one, two  Unit vectors along the edges that bound it.
  Quarter(const PlaneMirror& mirror, const Vec3& apex, const Vec3& one, const Vec3& two) {
    const Vec3 inside = apex + Corner::kLeastEdge * (one + two);
    if (mirror.endless) {
      extents_.fill(Corner::kEndless);
      surface_ = mirror.water;
      exists_ = true;
      return;
    }
    const PlaneMirror::Triangle* here = mirror.triangle_at(inside, kMargin);
    if (here == nullptr) {
      return;
    }
    exists_ = true;
    surface_ = here->surface;
    normal_ = here->front ? mirror.normal : Vec3(-mirror.normal);
    for (const PlaneMirror::Triangle& triangle : mirror.triangles) {
      const auto flat = [&](int k) -> Eigen::Vector2d {
        const Vec3 place = triangle.corners[k] - apex;
        return {place.dot(one), place.dot(two)};
      };
      flat_.push_back({flat(0), flat(1), flat(2)});
    }
    for (int step = 0; step <= Corner::kSteps; ++step) {
      // Slightly off the edges, along which triangles of the neighbouring quarters end.
      constexpr double kOff = 1e-3;
      const double share = std::clamp(static_cast<double>(step) / Corner::kSteps, kOff, 1 - kOff);
      extents_[step] = static_cast<float>(extent_along({1 - share, share}));
    }
  }

  [[nodiscard]] bool exists() const { return exists_; }
  [[nodiscard]] SurfaceLabel surface() const { return surface_; }
  [[nodiscard]] const Vec3& normal() const { return normal_; }  // By the winding at the apex; 0 for water.
  [[nodiscard]] const std::array<float, Corner::kSteps + 1>& extents() const { return extents_; }

 private:
  // Where the mirror first ends along a ray from the apex. The ray's components add up to 1.
  double extent_along(const Eigen::Vector2d& ray) {
    parts_.clear();
    for (const auto& triangle : flat_) {
      if (const auto part = within(triangle, ray); part.first < part.second) {
        parts_.push_back(part);
      }
    }
    std::ranges::sort(parts_);
    double end = 0;
    for (const auto& [from, to] : parts_) {
      if (from > end + Corner::kGap) {
        break;
      }
      end = std::max(end, to);
    }
    return std::min(end, double{Corner::kEndless});
  }

  bool exists_ = false;
  SurfaceLabel surface_ = 0;
  Vec3 normal_ = Vec3::Zero();
  std::array<float, Corner::kSteps + 1> extents_ = {};
  std::vector<std::array<Eigen::Vector2d, 3>> flat_;
  std::vector<std::pair<double, double>> parts_;
};

// Adds those of the eight octants around a crossing in which all three mirrors exist.
void add_octants(const Crossing& crossing, int instance, std::vector<Corner>& corners) {
  std::array<std::vector<Quarter>, 3> quarters;  // [mirror][signs of the two axes]
  for (int k = 0; k < 3; ++k) {
    for (int signs = 0; signs < 4; ++signs) {
      quarters[k].emplace_back(*crossing.mirrors[k], crossing.apex,
                               (signs & 1 ? -1.0 : 1.0) * crossing.axes.col((k + 1) % 3),
                               (signs & 2 ? -1.0 : 1.0) * crossing.axes.col((k + 2) % 3));
    }
    if (std::ranges::none_of(quarters[k], &Quarter::exists)) {
      return;
    }
  }
  for (int octant = 0; octant < 8; ++octant) {
    Corner corner{.instance = instance, .apex = crossing.apex, .from_behind = true};
    bool whole = true;
    for (int k = 0; k < 3; ++k) {
      const double sign = octant >> k & 1 ? -1.0 : 1.0;
      corner.axes.col(k) = sign * crossing.axes.col(k);
      const int one = octant >> (k + 1) % 3 & 1, two = octant >> (k + 2) % 3 & 1;
      const Quarter& quarter = quarters[k][one + 2 * two];
      const bool above_water = crossing.mirrors[k]->endless && corner.axes.col(k).z() > 0;
      whole = whole && quarter.exists() && !above_water;
      corner.surfaces[k] = quarter.surface();
      corner.extents[k] = quarter.extents();
      corner.from_behind = corner.from_behind && quarter.normal().dot(corner.axes.col(k)) < 0;
    }
    if (whole) {
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

void add_corners(const std::vector<PlaneMirror>& mirrors, int instance, std::vector<Corner>& all) {
  std::vector<Corner> corners;
  std::vector<std::vector<std::size_t>> beside(
      mirrors.size());  // [mirror] Mirrors of higher index, perpendicular to it and touching.
  for (std::size_t i = 0; i < mirrors.size(); ++i) {
    for (std::size_t j = i + 1; j < mirrors.size(); ++j) {
      if (perpendicular(mirrors[i], mirrors[j]) && touch(mirrors[i], mirrors[j])) {
        beside[i].push_back(j);
      }
    }
  }
  for (std::size_t i = 0; i < mirrors.size(); ++i) {
    for (const std::size_t j : beside[i]) {
      for (const std::size_t k : beside[j]) {
        if (!std::ranges::binary_search(beside[i], k)) {
          continue;
        }
        const PlaneMirror &a = mirrors[i], &b = mirrors[j], &c = mirrors[k];
        Eigen::Matrix3d normals;
        normals << a.normal.transpose(), b.normal.transpose(), c.normal.transpose();
        const Vec3 apex = normals.inverse() * Vec3(a.offset, b.offset, c.offset);
        if (!may_reach(a, apex) || !may_reach(b, apex) || !may_reach(c, apex)) {
          continue;
        }
        const Vec3 second = (b.normal - b.normal.dot(a.normal) * a.normal).normalized();
        Eigen::Matrix3d axes;
        axes << a.normal, second, a.normal.cross(second);
        add_octants({apex, axes, {&a, &b, &c}}, instance, corners);
      }
    }
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

std::vector<Corner> find_corners(const Scene& scene, const std::vector<PlaneMirror>& still,
                                 const std::optional<WaterMirror>& water) {
  std::vector<Corner> corners;
  std::vector<PlaneMirror> mirrors = still;
  if (water) {
    mirrors.push_back(mirror_of(*water));
  }
  add_corners(mirrors, -1, corners);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (instance.moving && instance.present && !instance.endless) {
      add_corners(find_plane_mirrors(scene, static_cast<int>(i)), static_cast<int>(i), corners);
    }
  }
  return corners;
}

}  // namespace insonify
