// scan_slots.h -- which ping of a scanning sonar is the latest in each direction.

#pragma once

#include <vector>

namespace insonify {

/// The full circle cut into fine slots, each with the ping that looked there last.
class ScanSlots {
 public:
  /// What is shown in a direction: a mix of two pings, neighbours in time and direction.
  struct Mix {
    int ping = -1;       ///< Whose step the direction lies in; -1 where no ping looked.
    int neighbour = -1;  ///< The one whose step is next on that side; the same one where there is none.
    double share = 0;    ///< Of the neighbour, 0 (in the middle of the ping's own step) to 0.5 (at its border).
  };

  /// @param head_angles  Of all pings, in order [rad].
  /// @param step         Of the head [rad]; its sign does not matter.
  /// @param width        What each ping covers, at most a step [rad].
  ScanSlots(const std::vector<double>& head_angles, double step, double width);

  [[nodiscard]] Mix at(double azimuth) const;

 private:
  std::vector<Mix> slots_;
};

}  // namespace insonify
