// scan_slots.h -- look-up of the latest ping of a scanning sonar in each direction.

#pragma once

#include <vector>

namespace insonify {

/// The full circle divided into narrow slots, each with the latest ping in its direction.
class ScanSlots {
 public:
  /// What is shown in a direction: a mix of two pings that are neighbours in time and direction.
  struct Mix {
    int ping = -1;       ///< The ping whose step contains the direction; -1 for none.
    int neighbour = -1;  ///< The ping of the adjacent step on that side; the same ping if there is none.
    double share = 0;    ///< Weight of the neighbour, 0 (at the middle of the ping's step) to 0.5 (at its border).
  };

  /// @param head_angles  Head angles of all pings, in order [rad].
  /// @param step         Step of the head [rad]; its sign does not matter.
  /// @param width        Width that each ping covers, at most a step [rad].
  ScanSlots(const std::vector<double>& head_angles, double step, double width);

  [[nodiscard]] Mix at(double azimuth) const;

 private:
  std::vector<Mix> slots_;
};

}  // namespace insonify
