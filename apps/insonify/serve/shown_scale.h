// shown_scale.h -- default display levels of a sonar, fitted to its pings.

#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "insonify/live_loop.h"

namespace insonify {

/// Darkest and brightest level of a picture [dB], after shown_gain().
using ShownLevels = std::pair<double, double>;

/// Gain over range in the display of a sonar's pings [dB/decade].
[[nodiscard]] double shown_gain(const LiveWorld& world, int sonar);

/// Fits levels as `insonify draw` does: to the first ping of a forward-looking sonar, or to all pings of a scanning
/// head's first turn, since a single one may hold only noise.
class ShownScale {
 public:
  /// Adds a ping of the sonar.
  /// @return  Whether levels() changed.
  bool add(const LivePing& live);

  /// Absent before the first ping.
  [[nodiscard]] const std::optional<ShownLevels>& levels() const { return levels_; }

 private:
  std::optional<ShownLevels> levels_;
  std::vector<float> intensities_;  // Intensities of the pings so far, until the scale is complete.
  double full_scale_ = 0;
  std::size_t pings_ = 0;
  bool complete_ = false;
};

}  // namespace insonify
