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
  /// Number of pings of all sonars together.
  [[nodiscard]] virtual std::uint64_t ping_count() const = 0;
  /// Times of the first and of the last ping [s].
  [[nodiscard]] virtual double first_time() const = 0;
  [[nodiscard]] virtual double last_time() const = 0;
  /// Shows the last ping of each sonar that is not after that time, and goes on from there.
  /// @param time  [s]; before the first ping is at it, after the last one at that.
  /// @throws Error for a time that is not finite.
  virtual void seek(double time) = 0;
  /// Goes back to the ping before of that sonar, or where it has none, of any, and pauses.
  virtual void step_back(int sonar) = 0;
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
  /// @param sonar  The one that is watched: a recording goes on to its next ping, or where it has none, to that of any.
  virtual void step(int sonar) = 0;
  /// @throws Error unless the factor is from 0.01 to 100.
  virtual void set_speed(double factor) = 0;
  /// The simulation, which can be steered and changed; null for a recording.
  [[nodiscard]] virtual LiveLoop* simulation() { return nullptr; }
  /// The recording; null for a simulation.
  [[nodiscard]] virtual Playback* playback() { return nullptr; }
};

}  // namespace insonify
