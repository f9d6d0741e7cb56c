// ping_schedule.h -- the pings of a run in the order of their times, a batch at a time.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"

namespace insonify {

/// The pings of all sonars, ordered by time: a run that is stopped or killed leaves recordings that end at the same
/// time. A batch has as many pings as the last one suggests will take kBatchTime: few enough to stop soon.
class PingSchedule {
 public:
  static constexpr double kBatchTime = 0.2;  // [s]
  static constexpr std::size_t kMostTogether = 64;

  /// @param requests  Must outlive this.
  explicit PingSchedule(const ScenarioRequests& requests);

  /// The next batch; empty once all pings have been made. Valid until the next call.
  [[nodiscard]] std::span<PingOrder> next();

  /// To be called after each batch.
  /// @param seconds  Time that the batch took.
  void took(double seconds);

 private:
  [[nodiscard]] int next_sonar() const;

  const ScenarioRequests& requests_;
  std::vector<std::uint64_t> ordered_;  // [sonar] Pings so far.
  std::size_t together_ = 1;
  std::vector<PingRequest> of_batch_;
  std::vector<Ping> pings_;
  std::vector<PingOrder> orders_;
};

}  // namespace insonify
