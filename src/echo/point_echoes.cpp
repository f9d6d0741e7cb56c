// point_echoes.cpp -- seen, weakened by spreading and absorption, and deposited.

#include "echo/point_echoes.h"

#include <cmath>

#include "echo/ray_limits.h"

namespace insonify {

PointEchoes::PointEchoes(std::span<const PointTarget> points)
    : points_(points), rays_(points.size()), hits_(points.size()) {}

void PointEchoes::add(const PingPlan& plan, const Pose& world_from_sonar, Engine& engine, EchoGrid& grid) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3 there = points_[i].position - world_from_sonar.position;
    const double range = there.norm();
    rays_[i] = {world_from_sonar.position, range > 0 ? Vec3(there / range) : Vec3(Vec3::UnitX()), 0,
                range - double{kRayClearance}};
  }
  engine.trace(rays_, hits_);
  const Pose sonar_from_world = world_from_sonar.inverse();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3 local = sonar_from_world * points_[i].position;
    const double range = local.norm();
    const bool hidden = std::isfinite(hits_[i].distance);
    const Vec3f direction = (local / range).cast<float>();
    if (range == 0 || hidden || !plan.hears(direction)) {
      continue;
    }
    const PingPlan::Arrival arrival = plan.arrival_from(direction);
    const double intensity = std::pow(10.0, points_[i].target_strength_db / 10) / std::pow(range, 4) *
                             std::exp(-4 * double{plan.neper_per_metre} * range) * std::pow(double{arrival.heard}, 2);
    // A point has no extent: it takes no solid angle from what is behind it, and no surface to label the cell with.
    const int beam = plan.beam_of(arrival.bearing);
    const int bin = plan.bin_of(static_cast<float>(range));
    if (beam >= 0 && bin >= 0) {
      grid.energy(1, beam)[bin] += static_cast<float>(intensity);
    }
  }
}

}  // namespace insonify
