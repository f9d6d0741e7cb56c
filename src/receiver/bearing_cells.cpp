// bearing_cells.cpp -- beams cut into cells.

#include "receiver/bearing_cells.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

constexpr int kPerBeam = 2;
constexpr int kPerScannedBeam = BearingCells::kMostPerBeam;
constexpr int kBeside = 2;  // Beams on either side of a scanning head's.
constexpr double kWidest = radians_from_degrees(178);

}  // namespace

BearingCells::BearingCells(const SonarConfig& heard, const ReceiverConfig& receiver) : sonar(heard) {
  if (receiver.azimuth_pattern == BeamPattern::kTopHat) {
    return;
  }
  per_beam = heard.type == SonarType::kMechanicallyScanned ? kPerScannedBeam : kPerBeam;
  sonar.sampling.columns_per_beam = std::max(1, (heard.sampling.columns_per_beam + per_beam - 1) / per_beam);
  if (heard.type == SonarType::kMechanicallyScanned) {
    const int beside = std::clamp(static_cast<int>(0.5 * (kWidest / heard.azimuth_aperture - 1)), 0, kBeside);
    sonar.beam_count = per_beam * (1 + 2 * beside);
    sonar.azimuth_aperture = heard.azimuth_aperture * (1 + 2 * beside);
    first = per_beam * beside;
    return;
  }
  sonar.beam_count = per_beam * heard.beam_count;
  if (!heard.beam_azimuths.empty()) {
    // Each beam's slice in halves.
    const std::vector<double> edges = heard.beam_edges();
    sonar.beam_azimuths.clear();
    for (int beam = 0; beam < heard.beam_count; ++beam) {
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
