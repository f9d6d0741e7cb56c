// message_display.cpp -- derives the mapping of all pings from options, receiver and model; selects cells above a
// level.

#include "io/message/message_display.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace insonify {
namespace {

// The range that fits most scenes, of levels re the source's at 1 m, raised by kShownGainPerDecade.
constexpr double kUsualLowDb = -100;
constexpr double kUsualHighDb = -40;

// The level reached by the strongest share of the cells, or by all cells with an echo if there are fewer.
float threshold_of(std::vector<float> raised, double share) {
  const auto wanted = static_cast<std::size_t>(std::ceil(share * static_cast<double>(raised.size())));
  std::erase_if(raised, [](float value) { return !(value > 0); });
  if (raised.empty()) {
    return 0;
  }
  const auto last = raised.begin() + static_cast<std::ptrdiff_t>(std::min(wanted, raised.size()) - 1);
  std::ranges::nth_element(raised, last, std::greater());
  return *last;
}

}  // namespace

MessageLevels message_levels(const MessageSource& source, const MessageOptions& options) {
  MessageLevels levels;
  levels.gain_per_decade = usual_display(source.model, source.receiver).raised_per_decade;
  levels.decibels = source.model == EchoModel::kCalibrated || options.low_db || options.high_db;
  if (!levels.decibels) {
    levels.high_db = 0;  // Intensity 1.
    return levels;
  }
  levels.low_db = kUsualLowDb;
  levels.high_db = kUsualHighDb;
  if (source.model == EchoModel::kPaper) {
    levels.low_db = -50;
    levels.high_db = 0;
  } else if (source.receiver.full_scale_db) {
    levels.high_db = *source.receiver.full_scale_db;
    levels.low_db = levels.high_db - source.sonar.mapping_range_db;
    levels.gain_per_decade = 0;  // The receiver's counts have none.
  }
  levels.low_db = options.low_db.value_or(levels.low_db);
  levels.high_db = options.high_db.value_or(levels.high_db);
  return levels;
}

Display message_display(const MessageSource& source, const MessageOptions& options) {
  const MessageLevels levels = message_levels(source, options);
  Display display = usual_display(source.model, source.receiver);
  display.colour_map = options.colour_map;
  display.height = options.fan_height;
  display.annotations = options.annotations;
  display.raised_per_decade = levels.gain_per_decade;
  display.full_scale = std::pow(10, levels.high_db / 10);
  if (levels.decibels) {
    display.scale = Scale::kDecibel;
    display.floor_db = levels.low_db - levels.high_db;
    display.of_one = source.model == EchoModel::kPaper;
  }
  return display;
}

double intensity_of_share(const MessageLevels& levels, double share, double range) {
  if (share <= 0) {
    return 0;
  }
  const double full_scale = std::pow(10, levels.high_db / 10);
  if (!levels.decibels) {
    return full_scale * share;
  }
  return full_scale * std::pow(10, (1 - share) * (levels.low_db - levels.high_db) / 10) *
         std::pow(range, -levels.gain_per_decade / 10);
}

std::vector<CloudPoint> strong_points(const Ping& ping, const std::vector<float>& raised, const SonarConfig& sonar,
                                      double share, bool true_elevations) {
  std::vector<CloudPoint> points;
  const float threshold = threshold_of(raised, share);
  const double middle = sonar.middle_elevation();
  for (int bin = 0; bin < ping.bin_count && threshold > 0; ++bin) {
    for (int beam = 0; beam < ping.beam_count; ++beam) {
      const std::size_t cell = ping.index(bin, beam);
      if (!(raised[cell] >= threshold)) {
        continue;
      }
      const bool known = true_elevations && !ping.elevation.empty() && std::isfinite(ping.elevation[cell]);
      const double elevation = known ? static_cast<double>(ping.elevation[cell]) : middle;
      const Vec3 place =
          point_from_spherical({sonar.bin_range(bin), sonar.beam_azimuth(beam) + ping.head_angle, elevation});
      points.push_back({static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z()),
                        10 * std::log10(ping.intensity[cell])});
    }
  }
  return points;
}

}  // namespace insonify
