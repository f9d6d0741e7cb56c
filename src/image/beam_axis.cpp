// beam_axis.cpp -- tabulates beam azimuths for fast conversion from azimuth to beam.

#include "image/beam_axis.h"

namespace insonify {

BeamAxis::BeamAxis(const SonarConfig& sonar) : last_(sonar.beam_count - 0.5) {
  const std::vector<double> edges = sonar.beam_edges();
  knots_.push_back({edges.front(), -0.5, 0});
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    knots_.push_back({sonar.beam_azimuth(beam), beam * 1.0, 0});
  }
  knots_.push_back({edges.back(), last_, 0});
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    knots_[i].beams_per_radian = (knots_[i + 1].beam - knots_[i].beam) / (knots_[i].azimuth - knots_[i + 1].azimuth);
  }

  const int steps = 4 * sonar.beam_count;
  steps_per_radian_ = steps / (edges.front() - edges.back());
  last_step_ = steps - 1;
  int knot = 0;
  for (int step = 0; step < steps; ++step) {
    const double azimuth = edges.front() - step / steps_per_radian_;
    while (knot < sonar.beam_count && knots_[knot + 1].azimuth >= azimuth) {
      ++knot;
    }
    first_.push_back(knot);
  }
}

}  // namespace insonify
