// lines_of_sight.cpp -- traces all lines of sight in one call of the engine.

#include "echo/targets/lines_of_sight.h"

#include <cmath>

#include "echo/model/ray_limits.h"

namespace insonify {

LinesOfSight::LinesOfSight(std::vector<Vec3> places)
    : places_(std::move(places)),
      rays_(places_.size()),
      hits_(places_.size()),
      sight_rays_(places_.size()),
      sights_(places_.size()) {}

std::span<const std::optional<LinesOfSight::Sight>> LinesOfSight::look(const PingPlan& plan,
                                                                       const Pose& world_from_sonar, Engine& engine) {
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
    if (range > 0 && !std::isfinite(hits_[i].distance) && plan.receives(direction)) {
      const PingPlan::Arrival arrival = plan.arrival_from(direction);
      sights_[i] = Sight{
          .range = range, .beam = plan.beam_of(arrival.bearing), .arrival = arrival, .passed = sight_rays_.passed(i)};
    }
  }
  return sights_;
}

}  // namespace insonify
