// solids_watch.h -- detects when a sonar enters an object.

#pragma once

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "insonify/ping_request.h"
#include "insonify/simulator.h"

namespace insonify {

/// Checks each sonar at most once a second, since it visits all triangles.
class SolidsWatch {
 public:
  /// @return  A line for each object that the sonar has entered since the last check.
  [[nodiscard]] std::vector<std::string> entered(Simulator& simulator, int sonar, const PingRequest& request);

  /// Forgets all earlier checks.
  void forget() { seen_.clear(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Seen {
    std::set<int> inside;  // Instances.
    Clock::time_point when;
  };
  std::map<int, Seen> seen_;  // By sonar.
};

}  // namespace insonify
