// waterfall.h -- draws the pings of a side-scan sonar as rows of a picture.

#pragma once

#include <deque>
#include <vector>

#include "insonify/picture.h"
#include "insonify/survey/bottom_track.h"
#include "insonify/words.h"

namespace insonify {

/// What the axis along the track counts.
enum class AlongTrack { kPing, kTime, kDistance };
template <>
constexpr auto words_of<AlongTrack>() {
  return EnumWords<AlongTrack, 3>{
      {{"ping", AlongTrack::kPing}, {"time", AlongTrack::kTime}, {"distance", AlongTrack::kDistance}}};
}

struct WaterfallOptions {
  bool corrected = false;     ///< Ground ranges on a level bed instead of slant ranges.
  bool normalised = false;    ///< The mean level at each angle taken out, see AngleGain.
  bool to_scale = false;      ///< As many metres a pixel along the track as across it; the height follows.
  bool altitude_line = true;  ///< The first return of the bottom, on slant ranges.
  AlongTrack along = AlongTrack::kPing;
  std::vector<double> altitudes = {};  ///< Heights above the bed, one for all pings or one for each [m], > 0; empty:
                                       ///< the tracked ones. NaN: that of the ping before.
  BottomTrackOptions bottom = {};      ///< How the bottom is tracked.
};

/// The pings of a side-scan sonar, or of a single beam that does not turn, as instruments show them: a row for each,
/// the newest at the top, port to the left, the track in the middle, starboard to the right. Seen from above, with the
/// vehicle going up the page: left and right are as on a chart.
class Waterfall {
 public:
  /// @param most_pings  Only the last so many are kept; 0: all.
  /// @throws Error unless the sonar is_side_looking().
  explicit Waterfall(const SonarConfig& sonar, WaterfallOptions options = {}, std::size_t most_pings = 0);
  /// @throws Error for a ping of another shape than the sonar's, or whose pose is not finite.
  void add(const Ping& ping);
  /// insonify::fitting_full_scale() of what is shown.
  [[nodiscard]] double fitting_full_scale() const;
  /// @throws Error without a ping; for altitudes that are not as many as pings; to scale, for a sonar that has not
  ///         moved and for pictures of more than 8192 pixels height.
  [[nodiscard]] Picture draw(const Display& display = {}) const;

 private:
  SonarConfig sonar_;
  WaterfallOptions options_;
  std::size_t most_ = 0;
  std::deque<Ping> pings_;  // Without ground truth.
};

}  // namespace insonify
