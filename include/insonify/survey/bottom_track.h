// bottom_track.h -- finds the first return of the bottom in the pings of a side-scan sonar: its altitude along a line.

#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "insonify/ping.h"
#include "insonify/sonar_config.h"

namespace insonify {

struct BottomTrackOptions {
  double least_range = 0;       ///< Nearest range at which a bottom is looked for [m], >= 0.
  double greatest_range = 1e5;  ///< Farthest [m], > least_range.

  /// Angle below the horizontal at which the first return comes [rad], in (0, pi/2]: pi/2 where the beams reach
  /// straight down, the steepest angle that they cover otherwise.
  double first_return_angle = std::numbers::pi / 2;
};

/// The bottom under each ping of a line.
struct BottomTrack {
  std::vector<double> range;       ///< First return of the bottom, mean of the sides [m].
  std::vector<double> side_range;  ///< The same of each side, at [ping * beam_count + beam] [m].

  /// Height of the sonar above the bottom [m]: range x sin(first_return_angle) x cos(pitch). With a pitch the plane of
  /// the beams is inclined, and so is the direction in which the bottom is nearest.
  std::vector<double> altitude;

  /// How clearly a dark water column ends there, 0 to 1, see docs/concepts/side-scan-products.md. Below kNoBottom the
  /// range is a guess.
  std::vector<double> quality;

  static constexpr double kNoBottom = 0.3;
};

/// Tracks the bottom along a line of pings, of one beam to a side or of both sides. Levels are compared within each
/// ping alone, so that gains, time-varied gain and companding do not matter. Memory does not grow with the line but for
/// the track.
class BottomTracker {
 public:
  /// @throws Error for a sonar that is not is_side_looking(), and for options out of limits.
  explicit BottomTracker(const SonarConfig& sonar, const BottomTrackOptions& options = {});
  ~BottomTracker();
  BottomTracker(BottomTracker&&) noexcept;
  BottomTracker& operator=(BottomTracker&&) noexcept;

  /// @throws Error for a ping of another shape than the sonar's, and for one whose pose is not finite.
  void add(const Ping& ping);

  /// The track of all pings added.
  /// @throws Error without a ping.
  [[nodiscard]] BottomTrack finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The track of a line of pings.
[[nodiscard]] BottomTrack track_bottom(std::span<const Ping> pings, const SonarConfig& sonar,
                                       const BottomTrackOptions& options = {});

/// The altitude by ground truth: height of the sonar above the nearest echo from more than 30 degrees below the
/// horizontal of the world, the lesser of the sides' [m]. Something in the water under the sonar is taken for the bed.
/// @throws Error for a ping without elevations (ground_truth: labels), or without such an echo.
[[nodiscard]] double true_altitude(const Ping& ping, const SonarConfig& sonar);

/// The same; none where true_altitude() throws for want of elevations or of an echo.
[[nodiscard]] std::optional<double> altitude_by_truth(const Ping& ping, const SonarConfig& sonar);

/// Whether a sonar looks to its sides: one beam that does not turn, or a beam to port and one to starboard.
[[nodiscard]] bool is_side_looking(const SonarConfig& sonar);

}  // namespace insonify
