// mosaic.h -- lays lines of side-scan pings onto a grid of the bed.

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "insonify/survey/bottom_track.h"
#include "insonify/words.h"

namespace insonify {

/// Which line a cell shows that several have insonified.
enum class MosaicRule {
  kBest,    ///< The one whose angle to the bed is nearest to 30 degrees: mid-range before far range before nadir.
  kLatest,  ///< The last one.
  kMean     ///< The mean of all.
};
template <>
constexpr auto words_of<MosaicRule>() {
  return EnumWords<MosaicRule, 3>{
      {{"best", MosaicRule::kBest}, {"latest", MosaicRule::kLatest}, {"mean", MosaicRule::kMean}}};
}

struct MosaicOptions {
  double cell = 0;  ///< Side of a cell [m], >= 0; 0: two bins of the first line, more where the grid had over 16
                    ///< million cells.
  MosaicRule rule = MosaicRule::kBest;
  bool normalised = false;         ///< The mean level at each angle of each line taken out, see AngleGain.
  BottomTrackOptions bottom = {};  ///< How the bottom is tracked.
};

/// A line, read ping by ping, more than once. Where it pauses for more than five of its usual intervals, what follows
/// is laid as another line is, so that a survey recorded as one may be given as one.
struct MosaicLine {
  SonarConfig sonar;
  std::uint64_t ping_count = 0;
  std::function<Ping(std::uint64_t)> ping;  ///< Its labels are taken where it has any.
  std::vector<double> altitudes = {};       ///< As WaterfallOptions::altitudes.
};

/// The bed seen from above, north (y of the world) up.
struct Mosaic {
  double west = 0, north = 0;  ///< World coordinates of the upper left corner [m].
  double cell = 0;             ///< Side of a cell [m].
  int columns = 0, rows = 0;
  int line_count = 0;  ///< Lines laid: those given, and one more for each of their pauses.

  // [row * columns + column], rows from the north.
  std::vector<float> intensity;         ///< NaN: not insonified.
  std::vector<float> angle;             ///< Angle below the horizontal at which the cell was seen [rad]; NaN.
  std::vector<std::uint16_t> line;      ///< Line shown, below line_count, in order; kNoLabel: none.
  std::vector<std::uint16_t> instance;  ///< Ground truth: label of the strongest weight; kNoLabel: none. Empty without.

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

/// Makes a mosaic of lines. The footprint of a bin is a rectangle on the bed: across the track from slant_to_ground(),
/// along it the beam's width times the range, at least the way to the next ping; pings count in a cell by how near its
/// middle is to theirs. Poses give place, heading and pitch; roll does not move an echo, whose place follows from its
/// range.
/// @throws Error without a line or a ping; as BottomTracker and slant_to_ground(); for a line none of whose bins
/// reaches
///         the bed; for a grid of more than 100 million cells, and for cells larger than half of its shorter side.
[[nodiscard]] Mosaic make_mosaic(std::span<const MosaicLine> lines, const MosaicOptions& options = {});

}  // namespace insonify
