// beam_axis.cpp -- tabulates beam azimuths for fast conversion from azimuth to beam.

#include "image/beam_axis.h"

namespace insonify {

BeamAxis::BeamAxis(const SonarConfig& sonar) : last_(sonar.beam_count - 0.5) {
  const BearingGrid beams = sonar.bearings();
  knots_.push_back({beams.port.front(), -0.5, 0});
  for (int beam = 0; beam < beams.count(); ++beam) {
    knots_.push_back({beams.centres[beam], beam * 1.0, 0});
    if (beams.gap_after(beam)) {
      knots_.push_back({beams.starboard[beam], beam + 0.5, 0});
      knots_.push_back({beams.port[beam + 1], beam + 0.5, 0});
    }
  }
  knots_.push_back({beams.starboard.back(), last_, 0});
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    knots_[i].beams_per_radian = (knots_[i + 1].beam - knots_[i].beam) / (knots_[i].azimuth - knots_[i + 1].azimuth);
  }

  const int steps = 4 * sonar.beam_count;
  steps_per_radian_ = steps / beams.extent();
  last_step_ = steps - 1;
  int knot = 0;
  for (int step = 0; step < steps; ++step) {
    const double azimuth = beams.port.front() - step / steps_per_radian_;
    while (knot + 2 < static_cast<int>(knots_.size()) && knots_[knot + 1].azimuth >= azimuth) {
      ++knot;
    }
    first_.push_back(knot);
  }
}

}  // namespace insonify
