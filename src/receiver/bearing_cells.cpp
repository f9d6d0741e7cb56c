// bearing_cells.cpp -- divides the beams of a sonar into bearing cells.

#include "receiver/bearing_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/error.h"
#include "receiver/line_array.h"

namespace insonify {
namespace {

constexpr int kPerBeam = 2;
constexpr int kPerScannedBeam = 8;
constexpr int kMostCells = 32768;
constexpr int kNeighbourBeams = 2;                     // Beam widths covered on either side of a scanning head's beam.
constexpr double kWidest = radians_from_degrees(178);  // Bearings are sines: all must be less than 90 deg off the axis.

// Cells per beam: `least`, or as many as make them no wider than half a beam in u, so that no echo lies between the
// cells that the pattern receives. Sampled so densely, the sum of |g|^2 over cells is its integral.
int cells_per_beam(const SonarConfig& fan, int least) {
  const std::vector<double> edges = fan.beam_edges();
  double slice = 0;
  for (int beam = 0; beam < fan.beam_count; ++beam) {
    slice = std::max(slice, std::abs(std::sin(edges[beam]) - std::sin(edges[beam + 1])));
  }
  constexpr double kSlack = 1e-6;  // A slice of a whole number of half beams gets no more cells by rounding.
  const double wanted = std::max<double>(least, std::ceil(slice / std::sin(0.5 * beam_width(fan)) - kSlack));
  if (wanted > least && wanted * fan.beam_count > kMostCells) {
    throw Error(fmt::format("{} beams as narrow as {:.4g} deg take {:.6g} cells of half a beam, must be at most {}",
                            fan.beam_count, degrees_from_radians(beam_width(fan)), wanted * fan.beam_count,
                            kMostCells));
  }
  return static_cast<int>(wanted);
}

}  // namespace

BearingCells::BearingCells(const SonarConfig& fan, const ReceiverConfig& receiver) : sonar(fan) {
  if (receiver.azimuth_pattern == BeamPattern::kTopHat) {
    return;
  }
  const bool scanned = fan.type == SonarType::kMechanicallyScanned;
  per_beam = cells_per_beam(fan, scanned ? kPerScannedBeam : kPerBeam);
  sonar.sampling.columns_per_beam = std::max(1, (fan.sampling.columns_per_beam + per_beam - 1) / per_beam);
  if (scanned) {
    const int neighbours = std::clamp(static_cast<int>(0.5 * (kWidest / fan.azimuth_aperture - 1)), 0, kNeighbourBeams);
    sonar.beam_count = per_beam * (1 + 2 * neighbours);
    sonar.azimuth_aperture = fan.azimuth_aperture * (1 + 2 * neighbours);
    first = per_beam * neighbours;
    return;
  }
  sonar.beam_count = per_beam * fan.beam_count;
  if (!fan.beam_azimuths.empty()) {
    // Beams at explicit azimuths: each beam's slice is cut into equal cells.
    const std::vector<double> edges = fan.beam_edges();
    sonar.beam_azimuths.clear();
    for (int beam = 0; beam < fan.beam_count; ++beam) {
      const double cell = (edges[beam] - edges[beam + 1]) / per_beam;
      for (int i = 0; i < per_beam; ++i) {
        sonar.beam_azimuths.push_back(edges[beam] - (i + 0.5) * cell);
      }
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
