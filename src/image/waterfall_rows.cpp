// waterfall_rows.cpp -- gain against angle, ranges on the bed and altitudes of a waterfall's pings.

#include "image/waterfall_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "insonify/survey/slant_range.h"
#include "survey/altitudes.h"
#include "survey/checks.h"

namespace insonify {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

// Heights above the bed and first returns of all pings.
struct Bottoms {
  std::vector<double> altitudes;     // [ping]
  std::vector<double> first_return;  // [ping * sides]
};

Bottoms given_bottoms(const std::deque<Ping>& pings, const SonarConfig& sonar, const std::vector<double>& given) {
  Bottoms bottoms{altitudes_for_all(given, pings.size(), sonar), {}};
  for (std::size_t ping = 0; ping < pings.size(); ++ping) {
    const double range = bottoms.altitudes[ping] / std::max(plane_cosine(pings[ping].world_from_sonar), 1e-6);
    bottoms.first_return.insert(bottoms.first_return.end(), static_cast<std::size_t>(sonar.beam_count), range);
  }
  return bottoms;
}

Bottoms tracked_bottoms(const std::deque<Ping>& pings, const SonarConfig& sonar, const BottomTrackOptions& options) {
  BottomTracker tracker(sonar, options);
  std::ranges::for_each(pings, [&](const Ping& ping) { tracker.add(ping); });
  BottomTrack track = tracker.finish();
  for (std::size_t i = 0; i < track.side_range.size(); ++i) {
    if (track.quality[i / static_cast<std::size_t>(sonar.beam_count)] < BottomTrack::kNoBottom) {
      track.side_range[i] = std::nan("");
    }
  }
  return {usable_altitudes(std::move(track.altitude), sonar), std::move(track.side_range)};
}

// Cells of a side, the nearest first: those of range, which begin at 0 m, or on the ground.
std::vector<float> cells_of(const Ping& ping, int beam, const SonarConfig& sonar, const std::vector<float>& ground,
                            int cells) {
  std::vector<float> side(static_cast<std::size_t>(cells), kNothing);
  const int first = static_cast<int>(std::lround(sonar.min_range / sonar.bin_length()));
  for (int cell = 0; cell < cells; ++cell) {
    if (!ground.empty()) {
      side[cell] = ground[static_cast<std::size_t>(cell) * ping.beam_count + beam];
    } else if (cell >= first && cell - first < ping.bin_count) {
      side[cell] = ping.intensity[ping.index(cell - first, beam)];
    }
  }
  return side;
}

}  // namespace

std::vector<double> distances_along(const std::deque<Ping>& pings) {
  std::vector<double> distances;
  for (std::size_t ping = 0; ping < pings.size(); ++ping) {
    const Vec3 step = pings[ping].world_from_sonar.position - pings[ping > 0 ? ping - 1 : 0].world_from_sonar.position;
    distances.push_back((ping > 0 ? distances.back() : 0) + std::hypot(step.x(), step.y()));
  }
  return distances;
}

WaterfallRows waterfall_rows(const std::deque<Ping>& pings, const SonarConfig& sonar, const WaterfallOptions& options) {
  const bool needs_bottom = options.corrected || options.normalised || options.altitude_line;
  Bottoms bottoms;
  if (needs_bottom) {
    bottoms = options.altitudes.empty() ? tracked_bottoms(pings, sonar, options.bottom)
                                        : given_bottoms(pings, sonar, options.altitudes);
  }
  AngleGain gain(sonar.beam_count);
  for (std::size_t ping = 0; ping < pings.size() && options.normalised; ++ping) {
    gain.add(pings[ping], sonar, bottoms.altitudes[ping]);
  }
  WaterfallRows result;
  result.cell = sonar.bin_length();
  result.first_return = std::move(bottoms.first_return);
  const GroundGrid grid = ground_grid_of(sonar);
  const bool to_port = sonar.beam_azimuth(0) > 0;
  result.port_cells = to_port ? grid.count : 0;
  result.starboard_cells = !to_port || sonar.beam_count == 2 ? grid.count : 0;
  for (std::size_t number = 0; number < pings.size(); ++number) {
    const Ping ping =
        options.normalised ? gain.applied(pings[number], sonar, bottoms.altitudes[number]) : pings[number];
    const std::vector<float> ground =
        options.corrected ? slant_to_ground(ping, sonar, bottoms.altitudes[number], grid) : std::vector<float>();
    std::vector<float> row;
    if (to_port) {
      row = cells_of(ping, 0, sonar, ground, grid.count);
      std::ranges::reverse(row);
    }
    if (result.starboard_cells > 0) {
      const std::vector<float> side = cells_of(ping, ping.beam_count - 1, sonar, ground, grid.count);
      row.insert(row.end(), side.begin(), side.end());
    }
    result.rows.push_back(std::move(row));
  }
  return result;
}

}  // namespace insonify
