// beam_axis.h -- converts azimuths to fractional beam indices, for evenly and unevenly spaced beams.

#pragma once

#include <algorithm>
#include <vector>

#include "insonify/sonar_config.h"

namespace insonify {

/// Continuous beam coordinate of a sonar: b at the centre of beam b, linear between centres and out to the outer edges,
/// which are at -0.5 and beam_count - 0.5. A gap between beams b and b + 1 is at b + 0.5.
class BeamAxis {
 public:
  explicit BeamAxis(const SonarConfig& sonar);

  [[nodiscard]] double port_edge() const { return knots_.front().azimuth; }      ///< [rad]
  [[nodiscard]] double starboard_edge() const { return knots_.back().azimuth; }  ///< [rad]

  /// Beam coordinate of an azimuth [rad], clamped to the outer edges.
  [[nodiscard]] double beam_at(double azimuth) const {
    const double step = (port_edge() - azimuth) * steps_per_radian_;
    int i = first_[static_cast<int>(std::clamp(step, 0.0, last_step_))];
    while (i + 2 < static_cast<int>(knots_.size()) && knots_[i + 1].azimuth > azimuth) {
      ++i;
    }
    return std::clamp(knots_[i].beam + (knots_[i].azimuth - azimuth) * knots_[i].beams_per_radian, -0.5, last_);
  }

 private:
  struct Knot {
    double azimuth, beam, beams_per_radian;  // beams_per_radian is valid up to the next knot.
  };
  std::vector<Knot> knots_;  // The port edge, the beam centres, the edges of gaps and the starboard edge.
  std::vector<int> first_;   // Index of the knot at or before each of many equal steps from the port edge.
  double steps_per_radian_ = 0, last_step_ = 0, last_ = 0;
};

}  // namespace insonify
