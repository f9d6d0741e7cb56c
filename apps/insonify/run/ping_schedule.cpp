// ping_schedule.cpp -- merges the pings of all sonars by time.

#include "run/ping_schedule.h"

#include <algorithm>

namespace insonify {

PingSchedule::PingSchedule(const ScenarioRequests& requests)
    : requests_(requests),
      ordered_(static_cast<std::size_t>(requests.sonar_count())),
      of_batch_(kMostTogether),
      pings_(kMostTogether) {}

// The sonar whose next ping is the earliest, the first of those that ping at the same time; -1 once all are done.
int PingSchedule::next_sonar() const {
  constexpr double kSameTime = 1 + 1e-8;  // Ratio of times that are the same but for the rounding of the periods.
  int next = -1;
  double earliest = 0;
  for (int sonar = 0; sonar < requests_.sonar_count(); ++sonar) {
    const std::uint64_t number = ordered_[static_cast<std::size_t>(sonar)];
    const double time = requests_.time_of(sonar, number);
    if (number < requests_.ping_count(sonar) && (next < 0 || time * kSameTime < earliest)) {
      next = sonar;
      earliest = time;
    }
  }
  return next;
}

std::span<PingOrder> PingSchedule::next() {
  orders_.clear();
  for (int sonar = next_sonar(); sonar >= 0 && orders_.size() < together_; sonar = next_sonar()) {
    PingRequest& request = of_batch_[orders_.size()];
    requests_.fill(sonar, ordered_[static_cast<std::size_t>(sonar)]++, request);
    orders_.push_back({sonar, &request, &pings_[orders_.size()]});
  }
  return orders_;
}

void PingSchedule::took(double seconds) {
  const double of_one = seconds / static_cast<double>(std::max<std::size_t>(orders_.size(), 1));
  together_ = static_cast<std::size_t>(std::clamp(kBatchTime / std::max(of_one, 1e-6), 1.0, double{kMostTogether}));
}

}  // namespace insonify
