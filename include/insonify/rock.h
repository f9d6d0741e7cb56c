// rock.h -- converts pings to base::samples::Sonar of the Rock framework, without including Rock's headers.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "insonify/error.h"
#include "insonify/messages.h"
#include "insonify/picture.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Options for Rock samples.
struct RockOptions {
  std::int64_t epoch_us = 0;  ///< Time at which Ping::time is 0 [us since 1970].

  /// Whether beams run from port to starboard with bearings from negative to positive, as in the simulator of Cerqueira
  /// et al.; in Rock's own convention bearings are positive to port.
  bool mirrored = false;

  /// Whether beam_width is that of the whole fan, as in the same simulator; else that of one beam.
  bool fan_width = false;
};

/// Range bins of base::samples::Sonar: from range 0, each a whole number of microseconds long, one way.
struct RockBins {
  std::int64_t duration_us = 0;  ///< One way, at least 1.
  double sound_speed = 0;        ///< Gives a bin of that duration the sonar's bin length [m/s].
  int leading = 0;               ///< Bins before the sonar's first, without echoes.

  /// Ranges of the sample minus those of the sonar [m]: at most half a bin, 0 if min_range is a whole number of bins.
  double range_error = 0;
};

/// Bins of 0.1 m at 1500 m/s last 66.7 us; with 67 us at 1500 m/s bin 400 would be at 40.2 m. So the sample has the
/// sound speed that gives correct ranges, 1492.5 m/s.
/// @param sonar  From Simulator::sonar().
[[nodiscard]] inline RockBins rock_bins(const SonarConfig& sonar) {
  RockBins bins;
  const double length = sonar.bin_length();
  const double microseconds = 1e6 * length / sonar.assumed_sound_speed.value_or(1500);
  bins.duration_us = std::max<std::int64_t>(1, std::llround(microseconds));
  bins.sound_speed = 1e6 * length / static_cast<double>(bins.duration_us);
  bins.leading = static_cast<int>(std::llround(sonar.min_range / length));
  bins.range_error = bins.leading * length - sonar.min_range;
  return bins;
}

/// One ping as base::samples::Sonar (rock-core/base-types), with bins from 0 to 1 between the levels of images.
///
/// Beams run counter-clockwise seen from above, from starboard to port, each with the bearing of its centre (positive
/// to port, 0 ahead, with the angle of a scanning head); bins are beam-major. `time` is that of transmission;
/// `timestamps` stays empty, since all beams receive at once. `Sonar` only needs members of these names, so that
/// insonify does not depend on base-types:
///
///     base::samples::Sonar sample = insonify::to_rock<base::samples::Sonar>(ping, sonar, messages.levels());
///
/// @param sonar   From Simulator::sonar().
/// @param levels  SonarMessages::levels(), or other ones.
/// @throws Error for a ping without the sonar's beams and bins.
template <typename Sonar>
[[nodiscard]] Sonar to_rock(const Ping& ping, const SonarConfig& sonar, const MessageLevels& levels,
                            const RockOptions& options = {}) {
  using Time = std::remove_cvref_t<decltype(Sonar::time)>;
  using Angle = std::remove_cvref_t<decltype(Sonar::beam_width)>;
  if (ping.beam_count != sonar.beam_count || ping.bin_count != sonar.bin_count ||
      ping.intensity.size() != static_cast<std::size_t>(sonar.beam_count) * static_cast<std::size_t>(sonar.bin_count)) {
    throw Error("to_rock: the ping has not the sonar's beams and bins");
  }
  const RockBins bins = rock_bins(sonar);
  Sonar sample;
  sample.time = Time::fromMicroseconds(options.epoch_us + std::llround(1e6 * ping.time));
  sample.timestamps.clear();
  sample.bin_duration = Time::fromMicroseconds(bins.duration_us);
  const BearingGrid beams = sonar.bearings();
  sample.beam_width = Angle::fromRad(options.fan_width ? beams.extent() : beams.covered() / sonar.beam_count);
  sample.beam_height = Angle::fromRad(sonar.elevation_aperture);
  sample.speed_of_sound = static_cast<float>(bins.sound_speed);
  sample.beam_count = static_cast<std::uint32_t>(sonar.beam_count);
  sample.bin_count = static_cast<std::uint32_t>(bins.leading + sonar.bin_count);
  sample.bearings.clear();
  sample.bins.assign(static_cast<std::size_t>(sample.beam_count) * sample.bin_count, 0.0F);

  // Factor on intensities in each bin, before mapping to 0..1.
  const auto value = [&](int bin, float intensity) {
    const double raised = intensity * std::pow(sonar.bin_range(bin), levels.gain_per_decade / 10);
    if (!levels.decibels) {
      return std::clamp(raised / levels.high_db, 0.0, 1.0);
    }
    const double level = raised > 0 ? 10 * std::log10(raised) : -HUGE_VAL;
    return std::clamp((level - levels.low_db) / (levels.high_db - levels.low_db), 0.0, 1.0);
  };
  for (int i = 0; i < sonar.beam_count; ++i) {
    const int beam = options.mirrored ? i : sonar.beam_count - 1 - i;
    const double bearing = sonar.beam_azimuth(beam) + ping.head_angle;
    sample.bearings.push_back(Angle::fromRad(options.mirrored ? -bearing : bearing));
    const std::size_t first = static_cast<std::size_t>(i) * sample.bin_count + static_cast<std::size_t>(bins.leading);
    for (int bin = 0; bin < sonar.bin_count; ++bin) {
      sample.bins[first + static_cast<std::size_t>(bin)] =
          static_cast<float>(value(bin, ping.intensity[ping.index(bin, beam)]));
    }
  }
  return sample;
}

}  // namespace insonify
