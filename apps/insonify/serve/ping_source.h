// ping_source.h -- the source of the pings that a server shows: a running simulation or a recording.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "insonify/live_loop.h"

namespace insonify {

/// Playback of a recording, which unlike a simulation has an end and can go back.
class Playback {
 public:
  virtual ~Playback() = default;
  /// Name of the recording.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Number of pings of all sonars together.
  [[nodiscard]] virtual std::uint64_t ping_count() const = 0;
  /// Times of the first and of the last ping [s].
  [[nodiscard]] virtual double first_time() const = 0;
  [[nodiscard]] virtual double last_time() const = 0;
  /// Seeks to a time: shows the last ping of each sonar not after it, and continues from there.
  /// @param time  [s]; clamped to the times of the first and last ping.
  /// @throws Error for a time that is not finite.
  virtual void seek(double time) = 0;
  /// Steps back to the previous ping of that sonar, or of any if it has none, and pauses.
  virtual void step_back(int sonar) = 0;
};

/// Makes or reads pings in threads of its own, and passes them to a listener. All functions may be called from any
/// thread.
class PingSource {
 public:
  virtual ~PingSource() = default;
  /// Starts; to be called once. The listener must live until end().
  virtual void start(LiveListener& listener) = 0;
  /// Stops. The listener is not called afterwards.
  virtual void end() = 0;
  [[nodiscard]] virtual LiveState state() const = 0;
  virtual void pause(bool on) = 0;
  /// The next ping, while paused.
  /// @param sonar  The watched one: a recording steps to its next ping, or to that of any if it has none.
  virtual void step(int sonar) = 0;
  /// @throws Error unless the factor is from 0.01 to 100.
  virtual void set_speed(double factor) = 0;
  /// The simulation, which can be steered and changed; null for a recording.
  [[nodiscard]] virtual LiveLoop* simulation() { return nullptr; }
  /// The recording; null for a simulation.
  [[nodiscard]] virtual Playback* playback() { return nullptr; }
  /// Markers that a recording has.
  [[nodiscard]] virtual std::vector<Marker> marked() const { return {}; }
};

}  // namespace insonify
