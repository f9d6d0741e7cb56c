// receiver_config.cpp -- validates a ReceiverConfig and evaluates its gain over range.

#include "insonify/receiver_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/error.h"

namespace insonify {
namespace {

void check_gain_table(std::string_view object, const ReceiverConfig& receiver) {
  const std::vector<double>& ranges = receiver.gain_ranges;
  if (ranges.size() != receiver.gains_db.size()) {
    throw Error(
        object, "gains_db",
        fmt::format(" has {} values for the {} of {}.gain_ranges", receiver.gains_db.size(), ranges.size(), object),
        {member_name(object, "gain_ranges")});
  }
  for (std::size_t i = 1; i < ranges.size(); ++i) {
    if (ranges[i] <= ranges[i - 1]) {
      throw Error(object, fmt::format("gain_ranges[{}]", i),
                  fmt::format(" = {} m must be greater than the one before it, {} m", ranges[i], ranges[i - 1]));
    }
  }
  if (!ranges.empty() && receiver.time_varied_gain) {
    throw Error(object, "time_varied_gain", fmt::format(" must be none where {}.gain_ranges has a table", object));
  }
}

}  // namespace

void ReceiverConfig::validate(std::string_view object) const {
  check_fields(object, *this);
  if (pulse == PulseKind::kLfm && pulse_duration * pulse_bandwidth < kLeastCompression) {
    throw Error(
        object, "pulse_bandwidth",
        fmt::format(" = {:.4g} Hz times {}.pulse_duration = {:.4g} s is {:.3g}, must be at least 10 for a chirp",
                    pulse_bandwidth, object, pulse_duration, pulse_duration * pulse_bandwidth),
        {member_name(object, "pulse_duration"), member_name(object, "pulse")});
  }
  if (azimuth_pattern == BeamPattern::kInstrument) {
    throw Error(object, "azimuth_pattern",
                " = instrument must be top_hat or a window: a sonar's azimuth_resolution_deg is its own");
  }
  check_gain_table(object, *this);
  if (field && !speckle) {
    throw Error(object, "field", fmt::format(" needs {}.speckle: without it echoes have no phase", object),
                {member_name(object, "speckle")});
  }
  if (full_scale_db && full_scale_share) {
    const bool of_sonar = object != "receiver";
    throw Error(object, "full_scale_share",
                fmt::format(" = {:.6g} cannot go with {}.full_scale_db = {:.6g} dB; {}none for one of them",
                            *full_scale_share, object, *full_scale_db,
                            of_sonar ? "a sonar's receiver starts from the scenario's: write " : "write "),
                {member_name(object, "full_scale_db")});
  }
  if (counts && !full_scale_db && !full_scale_share) {
    throw Error(object, "counts",
                fmt::format(" needs {0}.full_scale_db, the recorded level of the greatest count, or "
                            "{0}.full_scale_share, the share of bins that have it",
                            object));
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
