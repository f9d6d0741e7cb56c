// scenario.cpp -- derived values of a scenario: each sonar's water and defaults, number of pings.

#include "insonify/scenario.h"

#include <algorithm>
#include <cmath>

namespace insonify {

bool Scenario::has_even_rows(const SonarConfig& sonar) const {
  const ReceiverConfig& own = receiver_of(sonar);
  return model == EchoModel::kPaper || (own.beam_shape == BeamShape::kWedge && !sonar.has_cones() &&
                                        sonar.elevation_pattern_beside(own) == BeamPattern::kTopHat &&
                                        sonar.sent_elevation_pattern(own) == BeamPattern::kTopHat);
}

Water Scenario::water_at(const SonarConfig& sonar) const {
  Water at_depth = water;
  if (surface) {
    const double height = (trajectory.at(0) * sonar.position).z();
    at_depth.depth = std::max(0.0, surface->level - height);
  }
  return at_depth;
}

double Scenario::surface_height(const SonarConfig& sonar) const {
  return surface ? surface->level : (trajectory.at(0) * sonar.position).z() + water.depth;
}

SonarConfig Scenario::filled_in(SonarConfig sonar) const {
  sonar.assumed_sound_speed = sonar.assumed_sound_speed.value_or(water_at(sonar).true_sound_speed());
  sonar.ping_period = sonar.ping_period.value_or(sonar.shortest_ping_period(*sonar.assumed_sound_speed));
  if (model == EchoModel::kCalibrated) {
    sonar.sampling = sonar.sampling_by_rule();
  }
  return sonar;
}

std::uint64_t Scenario::ping_count(const SonarConfig& sonar) const {
  constexpr double kSlack = 1e-9;  // A duration of a whole number of periods must not get one ping more by rounding.
  const auto pings_before = [](double time, double period) {
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(time / period * (1 - kSlack))));
  };
  if (duration) {
    return pings_before(*duration, *sonar.ping_period);
  }
  if (!turns) {
    return static_cast<std::uint64_t>(pings);
  }
  const auto pings_of_turns = [&](const SonarConfig& head) {
    return pings_before(*turns * static_cast<double>(head.pings_per_turn()), 1);
  };
  if (sonar.scans()) {
    return pings_of_turns(sonar);
  }
  double longest = 0;
  for (const SonarConfig& head : sonars) {
    if (head.scans()) {
      longest = std::max(longest, static_cast<double>(pings_of_turns(head)) * *filled_in(head).ping_period);
    }
  }
  return pings_before(longest, *sonar.ping_period);
}

}  // namespace insonify
