// preset_limits.cpp -- fits a sonar to its instrument's limits, and finds settings beyond them.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/files.h"

namespace insonify {
namespace {

double linear_in(const std::vector<double>& places, const std::vector<double>& values, double place) {
  const auto above = std::ranges::upper_bound(places, place) - places.begin();
  if (above == 0 || above == std::ssize(places)) {
    return above == 0 ? values.front() : values.back();
  }
  const double part = (place - places[above - 1]) / (places[above] - places[above - 1]);
  return std::lerp(values[above - 1], values[above], part);
}

}  // namespace

void Preset::fit_to_range(SonarConfig& fitted, double sound_speed) const {
  const double window = fitted.max_range - fitted.min_range;
  // The tolerance keeps a window of a whole number of bins from getting one more by rounding.
  const double wanted =
      instrument.range_resolution ? std::ceil(window / *instrument.range_resolution - 1e-6) : instrument.bin_limit;
  fitted.bin_count = std::clamp(static_cast<int>(std::min(wanted, 65536.0)), 1, instrument.bin_limit);
  if (!instrument.pulse_ranges.empty()) {
    constexpr double kMicro = 1e-6;  // Instruments count their pulses' durations in microseconds.
    const double duration = linear_in(instrument.pulse_ranges, instrument.pulse_durations, fitted.max_range);
    fitted.pulse_duration = std::max(1.0, std::round(duration / kMicro)) * kMicro;
  }
  fitted.ping_period.reset();
  if (instrument.ping_rate_limit && 1 / *instrument.ping_rate_limit > fitted.shortest_ping_period(sound_speed)) {
    fitted.ping_period = 1 / *instrument.ping_rate_limit;
  }
}

std::vector<Preset::Excess> Preset::exceeded_by(const SonarConfig& given) const {
  constexpr double kSlack = 1e-6;      // Tolerance for angles converted from degrees.
  constexpr double kOtherBand = 0.25;  // Instruments that can be tuned reach about that far.
  std::vector<Excess> excesses;
  if (!(given.max_range > given.min_range)) {
    return excesses;  // SonarConfig::validate() throws.
  }
  const auto add = [&](bool exceeded, const char* field, const std::string& text) {
    if (exceeded) {
      excesses.push_back({field, text});
    }
  };
  const auto degrees = [](double angle) { return degrees_from_radians(angle); };
  add(std::abs(given.frequency / sonar.frequency - 1) > kOtherBand, "frequency",
      fmt::format(" = {:.6g} Hz, and a {} transmits at {:.6g} Hz", given.frequency, title, sonar.frequency));
  add(given.max_range > sonar.max_range * (1 + kSlack), "max_range",
      fmt::format(" = {:.6g} m, and a {} reaches {:.6g} m", given.max_range, title, sonar.max_range));
  add(given.min_range < sonar.min_range * (1 - kSlack), "min_range",
      fmt::format(" = {:.6g} m, and a {} begins at {:.6g} m", given.min_range, title, sonar.min_range));
  add(given.azimuth_aperture > sonar.azimuth_aperture * (1 + kSlack), "azimuth_aperture_deg",
      fmt::format(" = {:.6g}, and the fan of a {} has {:.6g} deg", degrees(given.azimuth_aperture), title,
                  degrees(sonar.azimuth_aperture)));
  add(given.elevation_aperture > sonar.elevation_aperture * (1 + kSlack), "elevation_aperture_deg",
      fmt::format(" = {:.6g}, and the beams of a {} have {:.6g} deg", degrees(given.elevation_aperture), title,
                  degrees(sonar.elevation_aperture)));
  add(given.beam_count > sonar.beam_count, "beam_count",
      fmt::format(" = {}, and a {} has {}", given.beam_count, title, sonar.beam_count));
  add(given.bin_count > instrument.bin_limit, "bin_count",
      fmt::format(" = {}, and a {} has at most {}", given.bin_count, title, instrument.bin_limit));
  const double finest = instrument.range_resolution.value_or(given.bin_length());
  add(given.bin_count > std::ceil((given.max_range - given.min_range) / finest - kSlack), "bin_count",
      fmt::format(" = {} makes bins of {:.4g} m, and those of a {} have at least {:.4g} m", given.bin_count,
                  given.bin_length(), title, finest));
  add(instrument.ping_rate_limit && given.ping_period && *given.ping_period * *instrument.ping_rate_limit < 1 - kSlack,
      "ping_period",
      fmt::format(" = {:.4g} s, and a {} makes at most {:.4g} pings a second", given.ping_period.value_or(0), title,
                  instrument.ping_rate_limit.value_or(0)));
  const bool head = given.scans() && !instrument.steps.empty();
  const double least_step = head ? *std::ranges::min_element(instrument.steps) : 0;
  add(head && std::abs(given.head.step) < least_step * (1 - kSlack), "step_deg",
      fmt::format(" = {:.4g}, and the head of a {} makes steps of at least {:.4g} deg", degrees(given.head.step), title,
                  degrees(least_step)));
  return excesses;
}

}  // namespace insonify
