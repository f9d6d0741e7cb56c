// receiver_config.cpp -- validates a ReceiverConfig and evaluates its gain over range.

#include "insonify/receiver_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/error.h"

namespace insonify {
namespace {

void check_gain_table(const ReceiverConfig& receiver) {
  const std::vector<double>& ranges = receiver.gain_ranges;
  if (ranges.size() != receiver.gains_db.size()) {
    throw Error(fmt::format("receiver.gains_db has {} values for the {} of receiver.gain_ranges",
                            receiver.gains_db.size(), ranges.size()));
  }
  for (std::size_t i = 1; i < ranges.size(); ++i) {
    if (ranges[i] <= ranges[i - 1]) {
      throw Error(fmt::format("receiver.gain_ranges[{}] = {} m must be greater than the one before it, {} m", i,
                              ranges[i], ranges[i - 1]));
    }
  }
  if (!ranges.empty() && receiver.time_varied_gain) {
    throw Error("receiver.time_varied_gain must be none where receiver.gain_ranges has a table");
  }
}

}  // namespace

void ReceiverConfig::validate() const {
  check_fields("receiver", *this);
  if (pulse == PulseKind::kLfm && pulse_duration * pulse_bandwidth < 10) {
    throw Error(
        fmt::format("receiver.pulse_bandwidth = {:.4g} Hz times receiver.pulse_duration = {:.4g} s is {:.3g}, must be "
                    "at least 10 for "
                    "a chirp",
                    pulse_bandwidth, pulse_duration, pulse_duration * pulse_bandwidth));
  }
  check_gain_table(*this);
  if (field && !speckle) {
    throw Error("receiver.field needs receiver.speckle: without it echoes have no phase");
  }
  if (counts && !full_scale_db) {
    throw Error("receiver.counts needs receiver.full_scale_db, the recorded level that fills them");
  }
}

double ReceiverConfig::gain_db(double range, double absorption_db_per_m) const {
  if (time_varied_gain) {
    return *time_varied_gain * std::log10(range) + 2 * absorption_db_per_m * range;
  }
  if (gain_ranges.empty()) {
    return 0;
  }
  const auto above = std::ranges::upper_bound(gain_ranges, range) - gain_ranges.begin();
  if (above == 0 || above == std::ssize(gain_ranges)) {
    return above == 0 ? gains_db.front() : gains_db.back();
  }
  const double part = (range - gain_ranges[above - 1]) / (gain_ranges[above] - gain_ranges[above - 1]);
  return std::lerp(gains_db[above - 1], gains_db[above], part);
}

}  // namespace insonify
