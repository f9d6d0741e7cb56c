// bearing_cells.cpp -- divides the beams of a sonar into bearing cells.

#include "receiver/bearing_cells.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

constexpr int kPerBeam = 2;
constexpr int kPerScannedBeam = BearingCells::kMaxPerBeam;
constexpr int kNeighbourBeams = 2;                     // Beam widths covered on either side of a scanning head's beam.
constexpr double kWidest = radians_from_degrees(178);  // Bearings are sines: all must be less than 90 deg off the axis.

}  // namespace

BearingCells::BearingCells(const SonarConfig& fan, const ReceiverConfig& receiver) : sonar(fan) {
  if (receiver.azimuth_pattern == BeamPattern::kTopHat) {
    return;
  }
  per_beam = fan.type == SonarType::kMechanicallyScanned ? kPerScannedBeam : kPerBeam;
  sonar.sampling.columns_per_beam = std::max(1, (fan.sampling.columns_per_beam + per_beam - 1) / per_beam);
  if (fan.type == SonarType::kMechanicallyScanned) {
    const int neighbours = std::clamp(static_cast<int>(0.5 * (kWidest / fan.azimuth_aperture - 1)), 0, kNeighbourBeams);
    sonar.beam_count = per_beam * (1 + 2 * neighbours);
    sonar.azimuth_aperture = fan.azimuth_aperture * (1 + 2 * neighbours);
    first = per_beam * neighbours;
    return;
  }
  sonar.beam_count = per_beam * fan.beam_count;
  if (!fan.beam_azimuths.empty()) {
    // Beams at explicit azimuths: each beam's slice is cut in half.
    const std::vector<double> edges = fan.beam_edges();
    sonar.beam_azimuths.clear();
    for (int beam = 0; beam < fan.beam_count; ++beam) {
      const double quarter = 0.25 * (edges[beam] - edges[beam + 1]);
      sonar.beam_azimuths.push_back(edges[beam] - quarter);
      sonar.beam_azimuths.push_back(edges[beam + 1] + quarter);
    }
  }
}

std::vector<double> BearingCells::sines(const SonarConfig& fan) {
  std::vector<double> sines;
  sines.reserve(fan.beam_count);
  for (int beam = 0; beam < fan.beam_count; ++beam) {
    sines.push_back(std::sin(fan.beam_azimuth(beam)));
  }
  return sines;
}

}  // namespace insonify
