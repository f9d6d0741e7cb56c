// ping_source.h -- where the pings come from that a server shows: a simulation that goes on, or a recording.

#pragma once

#include <cstdint>
#include <string>

#include "insonify/live_loop.h"

namespace insonify {

/// What a recording has beside that which it shares with a simulation: an end, and a past to go back to.
class Playback {
 public:
  virtual ~Playback() = default;
  /// Name of what is played.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Of all sonars together.
  [[nodiscard]] virtual std::uint64_t ping_count() const = 0;
  /// Times of the first and of the last ping [s].
  [[nodiscard]] virtual double first_time() const = 0;
  [[nodiscard]] virtual double last_time() const = 0;
  /// Shows the last ping of each sonar that is not after that time, and goes on from there.
  /// @param time  [s]; before the first ping is at it, after the last one at that.
  /// @throws Error for a time that is not finite.
  virtual void seek(double time) = 0;
  /// Shows the pings before those that are shown, and pauses.
  virtual void step_back() = 0;
};

/// Makes or reads pings in threads of its own, and hands them to a listener. All functions may be called from any
/// thread.
class PingSource {
 public:
  virtual ~PingSource() = default;
  /// Begins; once. The listener must live until end().
  virtual void start(LiveListener& listener) = 0;
  /// Nothing is told to the listener after it.
  virtual void end() = 0;
  [[nodiscard]] virtual LiveState state() const = 0;
  virtual void pause(bool on) = 0;
  /// The next ping, while paused.
  virtual void step() = 0;
  /// @throws Error unless the factor is from 0.01 to 100.
  virtual void set_speed(double factor) = 0;
  /// The simulation, which can be steered and changed; null for a recording.
  [[nodiscard]] virtual LiveLoop* simulation() { return nullptr; }
  /// The recording; null for a simulation.
  [[nodiscard]] virtual Playback* playback() { return nullptr; }
};

}  // namespace insonify
