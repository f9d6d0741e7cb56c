// lines_of_sight.cpp -- traces all lines of sight in one call of the engine.

#include "echo/targets/lines_of_sight.h"

#include <cmath>

#include "echo/model/ray_limits.h"

namespace insonify {

std::optional<int> beam_hearing(const PingPlan& plan, const Vec3f& direction, bool has_array) {
  const PingPlan::Arrival arrival = plan.arrival_from(direction);
  const double off = double{arrival.elevation} - plan.sonar.elevation_center;
  if (!plan.elevation_pattern && std::abs(off) > 0.5 * plan.sonar.elevation_aperture) {
    return {};
  }
  if (const int beam = plan.beam_of(arrival.bearing); beam >= 0) {
    return beam;
  }
  if (!has_array || !(direction.x() > 0)) {
    return {};
  }
  return arrival.bearing > 0 ? 0 : plan.sonar.beam_count - 1;
}

LinesOfSight::LinesOfSight(std::vector<Vec3> places)
    : places_(std::move(places)),
      rays_(places_.size()),
      hits_(places_.size()),
      sight_rays_(places_.size()),
      sights_(places_.size()) {}

// @param beam_of  Beam that a direction is received in, if any.
template <typename BeamOf>
std::span<const std::optional<LinesOfSight::Sight>> LinesOfSight::see(const PingPlan& plan,
                                                                      const Pose& world_from_sonar, Engine& engine,
                                                                      const BeamOf& beam_of) {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Vec3 there = places_[i] - world_from_sonar.position;
    const double range = there.norm();
    rays_[i] = {world_from_sonar.position, range > 0 ? Vec3(there / range) : Vec3(Vec3::UnitX()), 0,
                range - double{kRayClearance}};
  }
  sight_rays_.trace(plan, engine, rays_, hits_);
  const Pose sonar_from_world = world_from_sonar.inverse();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Vec3 local = sonar_from_world * places_[i];
    const double range = local.norm();
    const Vec3f direction = (local / range).cast<float>();
    sights_[i].reset();
    if (!(range >= kNearest) || std::isfinite(hits_[i].distance)) {
      continue;
    }
    if (const std::optional<int> beam = beam_of(direction)) {
      sights_[i] = Sight{
          .range = range, .beam = *beam, .arrival = plan.arrival_from(direction), .passed = sight_rays_.passed(i)};
    }
  }
  return sights_;
}

std::span<const std::optional<LinesOfSight::Sight>> LinesOfSight::look(const PingPlan& plan,
                                                                       const Pose& world_from_sonar, Engine& engine) {
  return see(plan, world_from_sonar, engine, [&](const Vec3f& direction) -> std::optional<int> {
    if (!plan.receives(direction)) {
      return {};
    }
    return plan.beam_of(plan.arrival_from(direction).bearing);
  });
}

std::span<const std::optional<LinesOfSight::Sight>> LinesOfSight::listen(const PingPlan& plan,
                                                                         const Pose& world_from_sonar, bool has_array,
                                                                         Engine& engine) {
  return see(plan, world_from_sonar, engine,
             [&](const Vec3f& direction) { return beam_hearing(plan, direction, has_array); });
}

}  // namespace insonify
