// shown_scale.cpp -- fits levels to the pings of a sonar.

#include "serve/shown_scale.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "insonify/picture.h"

namespace insonify {
namespace {

constexpr double kDepth = 50;                 // From the darkest to the brightest level [dB].
constexpr std::size_t kMostKept = 4'000'000;  // Intensities.

// Number of pings from one end of the scanned sector to the other.
std::size_t pings_of_turn(const SonarConfig& sonar) {
  if (!sonar.scans() || sonar.head.step == 0) {
    return 1;
  }
  return static_cast<std::size_t>(std::ceil(sonar.head.sector_width / std::abs(sonar.head.step)));
}

}  // namespace

double shown_gain(const LiveWorld& world, int sonar) {
  const Scenario& scenario = world.scenario;
  return usual_display(scenario.model, scenario.receiver_of(world.sonars[static_cast<std::size_t>(sonar)]))
      .raised_per_decade;
}

bool ShownScale::add(const LivePing& live) {
  if (complete_) {
    return false;
  }
  const SonarConfig& sonar = live.world->sonars[static_cast<std::size_t>(live.sonar)];
  const Ping raised = raised_by_range(live.ping, sonar, shown_gain(*live.world, live.sonar));
  const std::vector<float> to_fit = intensities_to_fit(raised, sonar);
  intensities_.insert(intensities_.end(), to_fit.begin(), to_fit.end());
  ++pings_;
  complete_ = pings_ >= pings_of_turn(sonar) || intensities_.size() > kMostKept;
  // Refits at the 1st, 2nd, 4th, 8th ... ping, at the end, and when an echo is far louder than all
  // before.
  const double alone = fitting_full_scale(to_fit);
  if (!complete_ && !std::has_single_bit(pings_) && alone <= full_scale_) {
    return false;
  }
  full_scale_ = fitting_full_scale(intensities_);
  if (complete_) {
    intensities_ = {};
  }
  const double high = 10 * std::log10(full_scale_);
  const std::optional<ShownLevels> before = std::exchange(levels_, ShownLevels(high - kDepth, high));
  return before != levels_;
}

}  // namespace insonify
