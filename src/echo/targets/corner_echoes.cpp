// corner_echoes.cpp -- traces a line of sight to each corner that opens towards the sonar.

#include "echo/targets/corner_echoes.h"

#include <cmath>

#include "echo/model/coherent_share.h"
#include "echo/targets/point_echoes.h"

namespace insonify {
namespace {

// Least component of the unit line of sight along each axis. Below it, a mirror is at grazing incidence.
constexpr double kLeastSine = 0.01;

// Product of the coherent reflectances of the three mirrors.
double reflectance_of(const PingPlan& plan, const Corner& corner, const Vec3& sight) {
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

CornerEchoes::CornerEchoes(std::shared_ptr<const std::vector<Corner>> corners) : corners_(std::move(corners)) {
  const std::size_t most = corners_ ? corners_->size() : 0;
  views_.reserve(most);
  rays_.reserve(most);
  hits_.resize(most);
  sight_rays_ = SightRays(most);
}

bool CornerEchoes::act(const PingPlan& plan) const {
  return corners_ && !corners_->empty() && plan.secondary != SecondaryEchoes::kNone && plan.max_surfaces >= 3;
}

void CornerEchoes::add(const PingPlan& plan, const Pose& world_from_sonar, std::span<const Pose> world_from_mesh,
                       Engine& engine, EchoGrid& grid) {
  if (!act(plan)) {
    return;
  }
  views_.clear();
  rays_.clear();
  const Pose sonar_from_world = world_from_sonar.inverse();
  for (const Corner& corner : *corners_) {
    const Pose frame = corner.instance < 0 ? Pose{} : world_from_mesh[static_cast<std::size_t>(corner.instance)];
    const Vec3 apex = frame * corner.apex;
    const Vec3 to_sonar = world_from_sonar.position - apex;
    const double range = to_sonar.norm();
    const Vec3 sight = corner.axes.transpose() * (frame.orientation.inverse() * to_sonar) / range;
    if (!(sight.minCoeff() > kLeastSine) || plan.bin_of(static_cast<float>(range)) < 0) {
      continue;
    }
    const Vec3f direction = (sonar_from_world * apex).normalized().cast<float>();
    if (plan.receives(direction)) {
      views_.push_back({&corner, sight, range, plan.arrival_from(direction)});
      rays_.push_back({world_from_sonar.position, -to_sonar / range, 0, range - Corner::kGap});
    }
  }
  sight_rays_.trace(plan, engine, rays_, std::span(hits_).first(rays_.size()));
  for (std::size_t i = 0; i < views_.size(); ++i) {
    if (std::isfinite(hits_[i].distance)) {
      continue;
    }
    const View& view = views_[i];
    // Carrier cycles per metre of range: two wavelengths of path.
    const double wavelength = 2 / plan.turns_per_metre;
    const double intensity = view.corner->reflected(view.sight, view.range, wavelength) *
                             reflectance_of(plan, *view.corner, view.sight) *
                             std::exp(-4 * double{plan.neper_per_metre} * view.range) * view.arrival.both_ways() *
                             sight_rays_.passed(i) * sight_rays_.passed(i);
    const double turns = plan.turns_per_metre * view.range + (has_water(*view.corner) ? 0.5 : 0.0);
    add_discrete_echo(plan, view.arrival, 3, view.range, intensity, turns, grid);
  }
}

}  // namespace insonify
