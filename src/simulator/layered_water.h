// layered_water.h -- the sound-speed profile of a scenario: what it must cover, and the rays that it bends.

#pragma once

#include <memory>
#include <optional>

#include "echo/model/refraction.h"
#include "insonify/scenario.h"
#include "simulator/simulated_sonar.h"

namespace insonify {

/// Checks that a scenario's profile, if it has one, reaches down to the scene.
/// @throws Error "water.profile ends at 40 m, above bed, which reaches down to 52.3 m"
void check_profile_covers(const Scenario& scenario, const Scene& scene);

/// The water of a scenario whose profile bends rays.
class LayeredWater {
 public:
  explicit LayeredWater(const Scenario& scenario);

  /// Whether a scenario's water bends rays.
  [[nodiscard]] static bool is_of(const Scenario& scenario);

  /// Checks that a sonar is not below the profile.
  /// @param position  In the world [m].
  void check(const Scenario& scenario, const SonarConfig& sonar, const Vec3& position) const;

  /// How it bends the rays of a view.
  /// @param before  See Refraction.
  [[nodiscard]] std::unique_ptr<Refraction> refraction(const Scenario& scenario, const SonarConfig& sonar,
                                                       const PingView& view, Workers& workers,
                                                       const Refraction* before) const;

 private:
  std::shared_ptr<const SoundSpeedProfile> profile_;
};

}  // namespace insonify
