// corner_echoes.cpp -- asks for a line of sight to each corner that opens towards the sonar.

#include "echo/targets/corner_echoes.h"

#include <cmath>

#include "echo/model/flat_plan.h"
#include "echo/targets/point_echoes.h"

namespace insonify {
namespace {

// Least component of the unit line of sight along each axis. Below it, a mirror is at grazing incidence.
constexpr double kLeastSine = 0.01;

// Product of the coherent reflectances of the three mirrors.
double reflectance_of(const FlatPlan& plan, const Corner& corner, const Vec3& sight) {
  double share = 1;
  for (int k = 0; k < 3; ++k) {
    share *= coherent_reflectance(plan, corner.surfaces[k], sight[k]);
  }
  return share;
}

// Whether one of the mirrors is the water's surface, which inverts the phase.
bool has_water(const Corner& corner) {
  for (const auto& extents : corner.extents) {
    if (extents[0] >= Corner::kEndless) {
      return true;
    }
  }
  return false;
}

}  // namespace

CornerEchoes::CornerEchoes(std::shared_ptr<const std::vector<Corner>> corners) : corners_(std::move(corners)) {}

bool CornerEchoes::act(const std::vector<Corner>& corners, const FlatPlan& plan) {
  return !corners.empty() && plan.secondary != SecondaryEchoes::kNone && plan.max_surfaces >= 3;
}

void CornerEchoes::ask(const PingView& view, Workers&, RayList& rays) {
  openings_.clear();
  const FlatPlan& plan = *view.plan;
  const Pose sonar_from_world = view.world_from_sonar.inverse();
  for (const Corner& corner : *corners_) {
    const Pose frame = corner.instance < 0 ? Pose{} : (*view.placement)[corner.instance];
    const Vec3 apex = frame * corner.apex;
    const Vec3 to_sonar = view.world_from_sonar.position - apex;
    const double range = to_sonar.norm();
    const Vec3 sight = corner.axes.transpose() * (frame.orientation.inverse() * to_sonar) / range;
    if (!(sight.minCoeff() > kLeastSine) || plan.bin_of(static_cast<float>(range)) < 0) {
      continue;
    }
    const Vec3f direction = (sonar_from_world * apex).normalized().cast<float>();
    if (plan.receives(direction)) {
      openings_.push_back({&corner, sight, range, plan.arrival_from(direction)});
      rays.sights.push_back({view.world_from_sonar.position, -to_sonar / range, 0, range - Corner::kGap});
    }
  }
}

void CornerEchoes::answer(const PingView& view, const RayAnswers& hits, Workers&, RayList&, EchoList& found) {
  const FlatPlan& plan = *view.plan;
  for (std::size_t i = 0; i < hits.sights.size(); ++i) {
    if (!hits.is_clear(i)) {
      continue;
    }
    const Opening& open = openings_[i];
    // Carrier cycles per metre of range: two wavelengths of path.
    const double wavelength = 2 / plan.turns_per_metre;
    const double intensity = open.corner->reflected(open.sight, open.range, wavelength) *
                             reflectance_of(plan, *open.corner, open.sight) *
                             std::exp(-4 * double{plan.neper_per_metre} * open.range) * open.arrival.both_ways() *
                             hits.passed(i) * hits.passed(i);
    const double turns = plan.turns_per_metre * open.range + (has_water(*open.corner) ? 0.5 : 0.0);
    add_discrete_echo(plan, open.arrival, 3, open.range, intensity, turns, found);
  }
}

}  // namespace insonify
