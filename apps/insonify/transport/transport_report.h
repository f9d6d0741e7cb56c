// transport_report.h -- rate and latency of the pings sent to other programs.

#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "console/stop.h"

namespace insonify {

using WallClock = std::chrono::steady_clock;

/// A time span on the wall clock, cut to whole ticks of it.
/// @param seconds  [s]
[[nodiscard]] inline WallClock::duration wall_clock_duration(double seconds) {
  return std::chrono::duration_cast<WallClock::duration>(std::chrono::duration<double>(seconds));
}

/// Thread-safe.
class TransportReport {
 public:
  /// Notes a ping whose message has just been sent.
  /// @param transmitted  Time of transmission: that of the pose that it was made from.
  /// @param computing    Computing time [s].
  void note(WallClock::time_point transmitted, double computing);

  void note_refusal();
  void note_drop();

  /// "421 pings in 21.1 s (20.0 Hz); 12.1 ms from transmission to message (19.3 at most), 8.0 of them computing"
  [[nodiscard]] std::string text() const;

 private:
  mutable std::mutex mutex_;
  WallClock::time_point start_ = WallClock::now(), first_, last_;
  std::uint64_t pings_ = 0, refusals_ = 0, drops_ = 0;
  double latency_ = 0, longest_ = 0, computing_ = 0;  // Sums and maximum [s].
};

/// Waits for SIGINT, SIGTERM or `ended`, and prints the report at SIGUSR1. After note_when_asked().
void report_until_stopped(const TransportReport& report, const std::atomic<bool>& ended = stop_asked());

}  // namespace insonify
