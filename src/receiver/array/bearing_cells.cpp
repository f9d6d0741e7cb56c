// bearing_cells.cpp -- divides the beams of a sonar into bearing cells, and adds guard cells outside the fan.

#include "receiver/array/bearing_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/array_pattern.h"
#include "insonify/error.h"
#include "receiver/array/line_array.h"

namespace insonify {
namespace {

constexpr int kPerScannedBeam = 8;
constexpr int kMostCells = 32768;
constexpr int kNeighbourBeams = 2;                     // Least beam widths covered on either side of a head's beam.
constexpr double kWidest = radians_from_degrees(178);  // Bearings are sines: all must be less than 90 deg off the axis.

// The widest slice of azimuth of a beam, as a difference of sines.
double widest_slice(const SonarConfig& fan) {
  const std::vector<double> edges = fan.beam_edges();
  double slice = 0;
  for (int beam = 0; beam < fan.beam_count; ++beam) {
    slice = std::max(slice, std::abs(std::sin(edges[beam]) - std::sin(edges[beam + 1])));
  }
  return slice;
}

// Cells per beam: `least`, or as many as make them no wider than half a beam in u, so that no echo lies between the
// cells that the pattern receives. Sampled so densely, the sum of |g|^2 over cells is its integral.
int cells_per_beam(const SonarConfig& fan, double slice, int least) {
  constexpr double kSlack = 1e-6;  // A slice of a whole number of half beams gets no more cells by rounding.
  const double wanted = std::max<double>(least, std::ceil(slice / std::sin(0.5 * beam_width(fan)) - kSlack));
  if (wanted > least && wanted * fan.beam_count > kMostCells) {
    throw Error(fmt::format("{} beams as narrow as {:.4g} deg take {:.6g} cells of half a beam, must be at most {}",
                            fan.beam_count, degrees_from_radians(beam_width(fan)), wanted * fan.beam_count,
                            kMostCells));
  }
  return static_cast<int>(wanted);
}

// The array without faults, which raise side lobes everywhere: cells need not reach further because of them.
ArrayPattern perfect_array(const SonarConfig& sonar, const ReceiverConfig& receiver) {
  return ArrayPattern(without_faults(azimuth_array(receiver, sonar)));
}

// Least distance from the main lobe's middle beyond which, on one side, less than `share` of the pattern's energy lies
// [wavelength / D].
double tail_begins(const ArrayPattern& pattern, double share) {
  constexpr double kStep = 1.0 / 64;
  double tail = 0.5 - share, x = 0;  // Energy still to be passed, re that of the whole pattern.
  const double whole = pattern.equivalent_beam();
  for (; tail > 0; x += kStep) {
    tail -= kStep * pattern.intensity(x + 0.5 * kStep) / whole;
  }
  return x;
}

// Distance between the middle of a steered beam and the end of the guard cells, as a difference of sines.
double guard_reach(const SonarConfig& sonar, const ReceiverConfig& receiver) {
  const ArrayPattern pattern = perfect_array(sonar, receiver);
  return tail_begins(pattern, BearingCells::kGuardLoss) / pattern.length(1, beam_width(sonar));
}

// Azimuth beyond which a head's two-way pattern stays below the floor [rad].
double head_reach(const SonarConfig& head, const ReceiverConfig& receiver) {
  constexpr double kStep = 1.0 / 64, kRounding = 1.001;  // Dolph's lobes have exactly their level.
  const ArrayPattern pattern = perfect_array(head, receiver);
  const double length = pattern.length(1, beam_width(head));
  const double floor = kRounding * std::pow(10, BearingCells::kHeadFloorDb / 10);
  double x = length;  // 90 degrees off.
  while (x > kStep && pattern.intensity(x) < floor && pattern.intensity(x - 0.5 * kStep) < floor) {
    x -= kStep;
  }
  return std::min(std::asin(std::min(x / length, 1.0)), BearingCells::kGuardEnd);
}

// Number of guard cells on the side of an outermost beam.
// @param beam, edge  Azimuths of the beam's centre and of the outer edge, counted from the axis to that side [rad].
// @param width       Of a guard cell [rad].
int guard_cells(double beam, double edge, double width, double reach) {
  const double end = std::min(std::asin(std::min(std::sin(beam) + reach, 1.0)), BearingCells::kGuardEnd);
  const double beyond = (end - edge) / width;
  const double room = (BearingCells::kGuardEnd - edge) / width;
  return static_cast<int>(std::max(0.0, std::min(std::ceil(beyond), std::floor(room))));
}

}  // namespace

BearingCells::BearingCells(const SonarConfig& fan, const ReceiverConfig& receiver) : sonar(fan) {
  if (receiver.azimuth_pattern == BeamPattern::kTopHat) {
    return;
  }
  const bool scanning = fan.type == SonarType::kMechanicallyScanned;
  const double slice = widest_slice(fan);
  const bool dense = slice <= kWidestSingle * std::sin(beam_width(fan));
  per_beam = cells_per_beam(fan, slice, scanning ? kPerScannedBeam : dense ? 1 : 2);
  const int columns = fan.sampling.columns_per_beam.value_or(Sampling::kColumns);
  sonar.sampling.columns_per_beam = std::max(1, (columns + per_beam - 1) / per_beam);
  if (scanning) {
    set_head(fan, head_reach(fan, receiver));
  } else {
    set_fan(fan, guard_reach(fan, receiver));
  }
}

// Cuts the beam into cells, with as narrow neighbours, and adds wide cells up to the azimuth `end`.
void BearingCells::set_head(const SonarConfig& head, double end) {
  const double beam = head.azimuth_aperture, narrow = beam / per_beam;
  const double middle = head.beam_azimuths.empty() ? 0 : head.beam_azimuths.front();
  const int room = std::max(0, static_cast<int>((0.5 * kWidest - std::abs(middle)) / beam - 0.5));
  const int wanted = static_cast<int>(std::ceil(end / beam - 0.5));
  const int neighbours = std::min(room, std::clamp(wanted, kNeighbourBeams, kNarrowNeighbours));
  sonar.beam_count = per_beam * (1 + 2 * neighbours);
  sonar.azimuth_aperture = beam * (1 + 2 * neighbours);
  first = per_beam * neighbours;

  // SonarConfig::beam_edges() are midway between centres, so that the first wide cell's centre is half a narrow cell
  // beyond its inner edge.
  const double inner = 0.5 * sonar.azimuth_aperture, first_centre = inner + 0.5 * narrow;
  const int most = static_cast<int>(std::floor((kGuardEnd - std::abs(middle) - first_centre) / beam + 0.5));
  const int needed = end > inner ? static_cast<int>(std::ceil((end - first_centre) / beam + 0.5)) : 0;
  const int wide = std::max(0, std::min(most, needed));
  if (wide == 0 && head.beam_azimuths.empty()) {
    return;
  }
  const int narrow_count = sonar.beam_count;
  sonar.beam_azimuths.clear();
  for (int cell = wide - 1; cell >= 0; --cell) {
    sonar.beam_azimuths.push_back(middle + first_centre + cell * beam);
  }
  for (int cell = 0; cell < narrow_count; ++cell) {
    sonar.beam_azimuths.push_back(middle + inner - (cell + 0.5) * narrow);
  }
  for (int cell = 0; cell < wide; ++cell) {
    sonar.beam_azimuths.push_back(middle - first_centre - cell * beam);
  }
  sonar.beam_count = narrow_count + 2 * wide;
  first += wide;
  const std::vector<double> edges = sonar.beam_edges();
  sonar.azimuth_aperture = edges.front() - edges.back();
  for (const double edge : edges) {
    edge_sines.push_back(std::sin(edge));
  }
}

// Cuts each beam's slice into equal cells, and adds guard cells as wide as the outermost ones.
// @param reach  See guard_reach().
void BearingCells::set_fan(const SonarConfig& fan, double reach) {
  const std::vector<double> edges = fan.beam_edges();
  const int last = fan.beam_count - 1;
  const double port_width = (edges[0] - edges[1]) / per_beam;
  const double starboard_width = (edges[last] - edges[last + 1]) / per_beam;
  int to_port = guard_cells(fan.beam_azimuth(0), edges.front(), port_width, reach);
  int to_starboard = guard_cells(-fan.beam_azimuth(last), -edges.back(), starboard_width, reach);
  if (fan.beam_azimuths.empty()) {
    to_port = to_starboard = std::max(to_port, to_starboard);  // An even fan stays centred; they differ by rounding.
  }
  first = to_port;
  sonar.beam_count = to_port + per_beam * fan.beam_count + to_starboard;
  if (fan.beam_azimuths.empty()) {
    sonar.azimuth_aperture = fan.azimuth_aperture + (to_port + to_starboard) * port_width;
    return;
  }
  sonar.beam_azimuths.clear();
  for (int cell = to_port; cell > 0; --cell) {
    sonar.beam_azimuths.push_back(edges.front() + (cell - 0.5) * port_width);
  }
  for (int beam = 0; beam < fan.beam_count; ++beam) {
    const double width = (edges[beam] - edges[beam + 1]) / per_beam;
    for (int cell = 0; cell < per_beam; ++cell) {
      sonar.beam_azimuths.push_back(edges[beam] - (cell + 0.5) * width);
    }
  }
  for (int cell = 0; cell < to_starboard; ++cell) {
    sonar.beam_azimuths.push_back(edges.back() - (cell + 0.5) * starboard_width);
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
