// shown_scale.h -- levels that pictures of a sonar show by default, from its pings.

#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "insonify/live_loop.h"

namespace insonify {

/// Darkest and brightest level of a picture [dB], with kShownGainPerDecade where shown_gain() says so.
using ShownLevels = std::pair<double, double>;

/// Gain over range with which pings of a sonar are shown [dB/decade].
[[nodiscard]] double shown_gain(const LiveWorld& world, int sonar);

/// Fits levels as `insonify draw` does: to the first ping of a forward-looking sonar, and to all pings of a scanning
/// head's first turn, of which one alone may hold noise only.
class ShownScale {
 public:
  /// Takes in a ping of the sonar.
  /// @return  Whether levels() are others than before.
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
