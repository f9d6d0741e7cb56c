// across_elevations.h -- one-way elevation pattern of a sonar, evaluated exactly in all directions in front of it.

#pragma once

#include <optional>

#include "insonify/array_pattern.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// |p|^2 of a sonar across elevations, one way: an array that is baffled to the back, or a top hat. ElevationPattern is
/// a table of the same pattern, cut off where levels are negligible.
class AcrossElevations {
 public:
  AcrossElevations(const SonarConfig& sonar, const ReceiverConfig& receiver);

  // Elevations beyond which nothing is received [rad].
  [[nodiscard]] double low() const;
  [[nodiscard]] double high() const;

  [[nodiscard]] double intensity(double elevation) const;

 private:
  double middle_, half_, length_ = 0;
  std::optional<ArrayPattern> array_;
};

}  // namespace insonify
