// scenario.cpp -- derived values of a scenario: each sonar's water and defaults, number of pings.

#include "insonify/scenario.h"

#include <algorithm>
#include <cmath>

#include "simulator/checks.h"

namespace insonify {
namespace {

// Number of pings before a time, the first at 0.
std::uint64_t pings_before(double time, double period) {
  constexpr double kSlack = 1e-9;  // A duration of a whole number of periods must not get one ping more by rounding.
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(time / period * (1 - kSlack))));
}

}  // namespace

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

double ping_time(std::span<const PingSpan> spans, double period, std::uint64_t number) {
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const std::uint64_t pings_of_span = pings_before(spans[i].end - spans[i].begin, period);
    if (number < pings_of_span || i + 1 == spans.size()) {
      return spans[i].begin + static_cast<double>(number) * period;
    }
    number -= pings_of_span;
  }
  return static_cast<double>(number) * period;
}

std::uint64_t Scenario::ping_count(const SonarConfig& sonar) const {
  if (duration && !ping_spans.empty()) {
    std::uint64_t count = 0;
    for (const PingSpan& span : ping_spans) {
      const double end = std::min(span.end, *duration);
      count += end > span.begin ? pings_before(end - span.begin, *sonar.ping_period) : 0;
    }
    return std::max<std::uint64_t>(1, count);
  }
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
