// lines_of_sight.cpp -- lines of sight to places, and the beams that receive sound from there.

#include "echo/targets/lines_of_sight.h"

#include <cmath>

#include "echo/model/hit.h"
#include "echo/model/refraction.h"

namespace insonify {

std::optional<int> beam_hearing(const FlatPlan& plan, const Vec3f& direction, bool has_array) {
  const FlatPlan::Arrival arrival = plan.arrival_from(direction);
  const double off = double{arrival.elevation} - plan.elevation_center;
  if (plan.received_across.empty() && std::abs(off) > 0.5 * plan.elevation_aperture) {
    return {};
  }
  if (const int beam = plan.beam_of(arrival.bearing); beam >= 0) {
    return beam;
  }
  if (!has_array || !(direction.x() > 0)) {
    return {};
  }
  return plan.nearest_beam(arrival.bearing);
}

LinesOfSight::LinesOfSight(std::vector<Vec3> places) : places_(std::move(places)), sights_(places_.size()) {}

void LinesOfSight::ask(const PingView& view, RayList& rays) {
  apparent_.clear();
  for (const Vec3& place : places_) {
    apparent_.push_back(apparent_place(view.refraction, place));
    const Vec3 there = apparent_.back().value_or(view.world_from_sonar.position) - view.world_from_sonar.position;
    const double range = there.norm();
    rays.sights.push_back({view.world_from_sonar.position, range > 0 ? Vec3(there / range) : Vec3(Vec3::UnitX()), 0,
                           range - double{kRayClearance}});
  }
}

// @param beam_of  Beam that a direction is received in, if any.
template <typename BeamOf>
std::span<const std::optional<LinesOfSight::Sight>> LinesOfSight::see(const PingView& view, const RayAnswers& hits,
                                                                      const BeamOf& beam_of) {
  const Pose sonar_from_world = view.world_from_sonar.inverse();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Vec3 local = sonar_from_world * apparent_[i].value_or(view.world_from_sonar.position);
    const double range = local.norm();
    const Vec3f direction = (local / range).cast<float>();
    sights_[i].reset();
    if (!apparent_[i] || !(range >= kNearest) || !hits.is_clear(i)) {
      continue;
    }
    if (const std::optional<int> beam = beam_of(direction)) {
      sights_[i] =
          Sight{.range = range, .beam = *beam, .arrival = view.plan->arrival_from(direction), .passed = hits.passed(i)};
    }
  }
  return sights_;
}

std::span<const std::optional<LinesOfSight::Sight>> LinesOfSight::look(const PingView& view, const RayAnswers& hits) {
  const FlatPlan& plan = *view.plan;
  return see(view, hits, [&](const Vec3f& direction) -> std::optional<int> {
    if (!plan.receives(direction)) {
      return {};
    }
    return plan.beam_of(plan.arrival_from(direction).bearing);
  });
}

std::span<const std::optional<LinesOfSight::Sight>> LinesOfSight::listen(const PingView& view, bool has_array,
                                                                         const RayAnswers& hits) {
  return see(view, hits, [&](const Vec3f& direction) { return beam_hearing(*view.plan, direction, has_array); });
}

}  // namespace insonify
