// layered_water.cpp -- compares a profile with the depths of scene and sonars, and makes refractions of it.

#include "simulator/layered_water.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "insonify/error.h"

namespace insonify {
namespace {

constexpr double kProfileSlack = 1e-3;  // By which rounding may have moved a bed [m].

// World z of the lowest vertex of an instance [m].
double lowest(const Instance& instance) {
  const Pose& pose = instance.world_from_mesh;
  const Vec3 up = pose.orientation.inverse() * Vec3::UnitZ();
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3f& vertex : instance.mesh->vertices) {
    least = std::min(least, up.dot(vertex.cast<double>()));
  }
  return pose.position.z() + least;
}

}  // namespace

void check_profile_covers(const Scenario& scenario, const Scene& scene) {
  if (scenario.water.profile.empty()) {
    return;
  }
  double surface = -std::numeric_limits<double>::infinity();
  for (const SonarConfig& sonar : scenario.sonars) {
    surface = std::max(surface, scenario.surface_height(sonar));
  }
  const double end = scenario.water.profile.back().depth;
  for (const Instance& instance : scene.instances) {
    if (!instance.present || instance.endless) {
      continue;
    }
    const double depth = surface - lowest(instance);
    if (depth > end + kProfileSlack) {
      throw Error("water.profile", "",
                  fmt::format(" ends at {:.7g} m, above {}, which reaches down to {:.7g} m", end, instance.name, depth))
          .located(scenario.places);
    }
  }
}

LayeredWater::LayeredWater(const Scenario& scenario)
    : profile_(std::make_shared<const SoundSpeedProfile>(scenario.water.profile, "water.profile")) {}

bool LayeredWater::is_of(const Scenario& scenario) {
  return !scenario.water.profile.empty() && !SoundSpeedProfile(scenario.water.profile, "water.profile").is_constant();
}

void LayeredWater::check(const Scenario& scenario, const SonarConfig& sonar, const Vec3& position) const {
  const double depth = scenario.surface_height(sonar) - position.z();
  if (depth > profile_->last_depth() + kProfileSlack) {
    throw Error(fmt::format("the sonar is {:.7g} m deep, below the end of water.profile at {:.7g} m", depth,
                            profile_->last_depth()));
  }
}

std::unique_ptr<Refraction> LayeredWater::refraction(const Scenario& scenario, const SonarConfig& sonar,
                                                     const PingView& view, Workers& workers,
                                                     const Refraction* before) const {
  return std::make_unique<Refraction>(profile_, view.world_from_sonar.position, scenario.surface_height(sonar),
                                      scenario.water_at(sonar).true_sound_speed(), double{view.plan->reach()}, workers,
                                      before);
}

}  // namespace insonify
