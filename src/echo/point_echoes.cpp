// point_echoes.cpp -- seen, weakened by spreading and absorption, and deposited.

#include "echo/point_echoes.h"

#include <cmath>

#include "base/philox.h"
#include "echo/ray_limits.h"

namespace insonify {

namespace {

// 0..1.
float phase_of(const PingPlan& plan, std::size_t point, double range) {
  const PhiloxCounter counter = {static_cast<std::uint32_t>(point), 0, 0,
                                 static_cast<std::uint32_t>(RandomPurpose::kPointPhase)};
  const double turns = plan.turns_per_metre * range + double{uniform_open(philox(counter, philox_key(plan.seed))[0])};
  return static_cast<float>(turns - std::floor(turns));
}

}  // namespace

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
  grid.lone_echoes().clear();
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
    // A point has no extent: it takes no solid angle from what is behind it, and no surface to label a cell with.
    const int beam = plan.beam_of(arrival.bearing);
    const int bin = plan.bin_of(static_cast<float>(range));
    if (beam >= 0 && bin >= 0) {
      grid.lone_echoes().push_back({.beam = beam,
                                    .bin = bin,
                                    .bearing_sine = std::sin(arrival.bearing),
                                    .intensity = static_cast<float>(intensity),
                                    .turns = phase_of(plan, i, range)});
    }
  }
}

}  // namespace insonify
