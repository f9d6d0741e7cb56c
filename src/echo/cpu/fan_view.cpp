// fan_view.cpp -- tests the bounding spheres of clusters against the fan.

#include "echo/cpu/fan_view.h"

#include <algorithm>
#include <cmath>

namespace insonify {

void ColumnFinder::prepare(const Lattice& lattice) {
  constexpr int kStepsAColumn = 2;
  const int steps = kStepsAColumn * lattice.columns;
  columns_ = lattice.columns;
  port_ = lattice.azimuth.front();
  const float span = std::max(port_ - lattice.azimuth.back(), 1e-6F);
  steps_per_radian_ = static_cast<float>(steps) / span;
  first_.resize(static_cast<std::size_t>(steps) + 2);
  int column = 0;
  for (int step = 0; step < steps + 2; ++step) {
    // One step early, to allow for rounding.
    const float edge = port_ - static_cast<float>(step - 1) / steps_per_radian_;
    while (column < lattice.columns && lattice.azimuth[column] > edge) {
      ++column;
    }
    first_[step] = column;
  }
}

ColumnFinder::Columns ColumnFinder::between(float low, float high) const {
  const auto last_step = static_cast<float>(first_.size() - 1);
  const float from = (port_ - high) * steps_per_radian_;
  const float to = (port_ - low) * steps_per_radian_ + 3;
  if (to < 0 || from > last_step) {
    return {0, 0};
  }
  const int first = from <= 0 ? 0 : first_[static_cast<int>(from)];
  const int last = to >= last_step ? columns_ : first_[static_cast<int>(to)];
  return {first, last};
}

// Columns that a sphere may touch; none if it lies outside the range or the elevation aperture.
ColumnFinder::Columns FanView::columns_of(const Sphere& sphere, const Placement& placement,
                                          const FlatPlan& plan) const {
  const Lattice& lattice = plan.lattice;
  const Vec3f centre = placement.sonar_from_part * (sphere.centre - placement.sonar);
  const float radius = sphere.radius;
  if (centre.norm() > plan.true_max_range + radius) {
    return {0, 0};
  }
  // Distances of the centre above the upper and below the lower edge of the fan, in the half-plane of its azimuth.
  const float across = std::hypot(centre.x(), centre.y());
  const Lattice::Edges& edges = lattice.edges_of(0);
  if (centre.z() * edges.cos_high - across * edges.sin_high > radius ||
      across * edges.sin_low - centre.z() * edges.cos_low > radius) {
    return {0, 0};
  }
  if (across > 1.001F * radius) {
    constexpr float kMargin = 1e-4F, kPi = 3.14159265F;
    const float azimuth = std::atan2(centre.y(), centre.x());
    const float half = std::asin(radius / across) + kMargin;
    if (azimuth + half < kPi && azimuth - half > -kPi) {
      return finder_.between(azimuth - half, azimuth + half);
    }
  }
  return {0, lattice.columns};
}

void FanView::look(const RasterScene& scene, const FlatPlan& plan, const Pose& scene_from_sonar) {
  finder_.prepare(plan.lattice);
  placements_.resize(scene.parts().size());
  visible_.clear();
  visible_.reserve(scene.clusters().size());
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    const RasterScene::Part& part = scene.parts()[i];
    const Pose part_from_sonar = part.scene_from_part.inverse() * scene_from_sonar;
    placements_[i] = {part_from_sonar.orientation.conjugate().toRotationMatrix().cast<float>(),
                      part_from_sonar.position.cast<float>()};
    const ColumnFinder::Columns all = columns_of(part.sphere, placements_[i], plan);
    if (all.first >= all.last) {
      continue;
    }
    for (std::uint32_t cluster = part.first_cluster; cluster < part.last_cluster; ++cluster) {
      const auto [first, last] = columns_of(scene.clusters()[cluster].sphere, placements_[i], plan);
      if (first < last) {
        visible_.push_back({cluster, first, last});
      }
    }
  }
}

}  // namespace insonify
