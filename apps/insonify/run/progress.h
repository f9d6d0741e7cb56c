// progress.h -- progress of a run, on a terminal or in a pipe.

#pragma once

#include <chrono>
#include <cstdint>

namespace insonify {

/// On a terminal, one line that is redrawn, with the rate and the remaining time if its width allows; in a pipe, a
/// plain line at most every two seconds.
class Progress {
 public:
  /// @param total  Number of pings of all sonars.
  Progress(std::uint64_t total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Counts one more completed ping.
  void advance();

 private:
  using Clock = std::chrono::steady_clock;

  void draw();

  std::uint64_t total_ = 0, done_ = 0;
  bool quiet_ = false;
  Clock::time_point start_, last_;
};

}  // namespace insonify
