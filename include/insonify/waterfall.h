// waterfall.h -- draws the pings of a single beam side by side, as of a side-scan sonar.

#pragma once

#include <vector>

#include "insonify/picture.h"

namespace insonify {

/// The pings of a sonar with one beam that does not turn, such as a channel of a side-scan sonar: pings from left to
/// right, range upwards.
class Waterfall {
 public:
  /// @throws Error unless the sonar has a single beam.
  explicit Waterfall(const SonarConfig& sonar);
  /// @throws Error for a ping of another shape than the sonar's.
  void add(const Ping& ping);
  /// @throws Error without a ping.
  [[nodiscard]] Picture draw(const Display& display = {}) const;

 private:
  SonarConfig sonar_;
  double last_time_ = 0;
  std::vector<std::uint64_t> numbers_;
  std::vector<std::vector<float>> profiles_;
};

}  // namespace insonify
