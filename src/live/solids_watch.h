// solids_watch.h -- tells when a sonar comes to lie inside of an object.

#pragma once

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "insonify/ping_request.h"
#include "insonify/simulator.h"

namespace insonify {

/// Looks at most once a second for each sonar, as it goes through all triangles.
class SolidsWatch {
 public:
  /// @return  A line for each object that the sonar is inside of and was not when it looked last.
  [[nodiscard]] std::vector<std::string> entered(Simulator& simulator, int sonar, const PingRequest& request);

  /// Everything is new.
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
