// world_stepper.h -- when a world in lock-step makes which number of steps.

#pragma once

#include <chrono>
#include <optional>

namespace insonify {

/// Gazebo does not say how long a step is: the world makes single steps until two in a row have taken the same time.
class WorldStepper {
 public:
  using Clock = std::chrono::steady_clock;

  /// Steps that are to be made now.
  /// @param stamp    Time of the newest poses [s].
  /// @param awaited  Time of the next ping [s]; none while pings are made.
  /// @return  0: none, the steps before have not come, or pings are made.
  [[nodiscard]] unsigned steps(double stamp, std::optional<double> awaited, Clock::time_point now);

 private:
  void measure(double stamp);

  std::optional<double> length_, last_length_;  // Of a step [s]; last_length_ while it is measured.
  std::optional<double> from_;                  // Stamp at which the last steps began [s].
  double until_ = 0;                            // ... and at which they end, if the length is known.
  Clock::time_point asked_at_;
};

}  // namespace insonify
