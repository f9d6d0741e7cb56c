// bearing_cells.cpp -- divides the beams of a sonar into bearing cells, and adds guard cells outside the fan.

#include "receiver/array/bearing_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "insonify/array_pattern.h"
#include "insonify/error.h"
#include "receiver/array/line_array.h"

namespace insonify {
namespace {

constexpr int kMostCells = 32768;
constexpr double kSplitCell = 0.26;                    // Greatest width of a cell of split arrays [beam widths].
constexpr double kGuardOfBeam = 0.25;                  // Least width of a guard cell in a gap [beam widths].
constexpr int kNeighbourBeams = 2;                     // Least beam widths covered on either side of a two-way beam.
constexpr double kWidest = radians_from_degrees(178);  // Bearings are sines: all must be less than 90 deg off the axis.

// The widest slice of azimuth of a beam, as a difference of sines.
double widest_slice(const BearingGrid& beams) {
  double slice = 0;
  for (int beam = 0; beam < beams.count(); ++beam) {
    slice = std::max(slice, std::abs(std::sin(beams.port[beam]) - std::sin(beams.starboard[beam])));
  }
  return slice;
}

// Cells per beam: `least`, or as many as make them no wider than half a beam in u, kSplitCell with `split` arrays, so
// that no echo lies between the cells that the pattern receives. Sampled so densely, the sum of |g|^2 over cells is its
// integral.
int cells_per_beam(const SonarConfig& fan, double slice, int least, bool split) {
  constexpr double kSlack = 1e-6;  // A slice of a whole number of half beams gets no more cells by rounding.
  const double widest = std::sin((split ? kSplitCell : 0.5) * beam_width(fan));
  const double wanted = std::max<double>(least, std::ceil(slice / widest - kSlack));
  if (wanted > least && wanted * fan.beam_count > kMostCells) {
    throw Error(
        fmt::format("{}: {} beams as narrow as {:.4g} deg (azimuth_resolution_deg) take {:.6g} cells of {} beam, "
                    "must be at most {}",
                    fan.name, fan.beam_count, degrees_from_radians(beam_width(fan)), wanted * fan.beam_count,
                    split ? "a quarter" : "half a", kMostCells));
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

// Azimuth beyond which a two-way pattern stays below the floor [rad].
double two_way_reach(const SonarConfig& sonar, const ReceiverConfig& receiver) {
  constexpr double kStep = 1.0 / 64, kRounding = 1.001;  // Dolph's lobes have exactly their level.
  const ArrayPattern pattern = perfect_array(sonar, receiver);
  const double length = pattern.length(1, beam_width(sonar));
  const double floor = kRounding * std::pow(10, BearingCells::kTwoWayFloorDb / 10);
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

BearingCells::BearingCells(const SonarConfig& fan, const ReceiverConfig& receiver, int per_two_way_beam)
    : grid(fan.bearings()) {
  columns = fan.sampling.columns_per_beam.value_or(Sampling::kColumns);
  if (receiver.azimuth_pattern == BeamPattern::kTopHat) {
    grid.shape = receiver.beam_shape;
    for (int beam = 0; beam < fan.beam_count; ++beam) {
      firsts.push_back(beam);
    }
    return;
  }
  const BearingGrid beams = std::move(grid);
  const bool two_way = fan.is_two_way();
  const double slice = widest_slice(beams);
  const bool dense = slice <= kWidestSingle * std::sin(beam_width(fan));
  per_beam = cells_per_beam(fan, slice, two_way ? per_two_way_beam : dense ? 1 : 2, fan.is_multibeam());
  columns = std::max(1, (columns + per_beam - 1) / per_beam);
  if (two_way) {
    set_two_way(fan, two_way_reach(fan, receiver));
  } else if (beams.has_gaps()) {
    set_gapped_fan(beams, guard_reach(fan, receiver), kGuardOfBeam * beam_width(fan));
  } else {
    set_fan(fan, guard_reach(fan, receiver));
  }
  grid.shape = receiver.beam_shape;
}

int BearingCells::beam_of(int cell) const {
  const auto after = std::ranges::upper_bound(firsts, cell);
  const bool own = after != firsts.begin() && cell < *(after - 1) + per_beam;
  return own ? static_cast<int>(after - firsts.begin()) - 1 : -1;
}

// Cuts the beam into cells, with as narrow neighbours, and adds wide cells up to the azimuth `end`.
void BearingCells::set_two_way(const SonarConfig& sonar, double end) {
  const double beam = sonar.azimuth_aperture, narrow = beam / per_beam;
  const double middle = sonar.beam_azimuths.empty() ? 0 : sonar.beam_azimuths.front();
  const int room = std::max(0, static_cast<int>((0.5 * kWidest - std::abs(middle)) / beam - 0.5));
  const int wanted = static_cast<int>(std::ceil(end / beam - 0.5));
  const int neighbours = std::min(room, std::clamp(wanted, kNeighbourBeams, kNarrowNeighbours));
  const int narrow_count = per_beam * (1 + 2 * neighbours);
  const double extent = beam * (1 + 2 * neighbours);

  // Edges are midway between centres, so that the first wide cell's centre is half a narrow cell beyond its inner edge.
  const double inner = 0.5 * extent, first_centre = inner + 0.5 * narrow;
  const int most = static_cast<int>(std::floor((kGuardEnd - std::abs(middle) - first_centre) / beam + 0.5));
  const int needed = end > inner ? static_cast<int>(std::ceil((end - first_centre) / beam + 0.5)) : 0;
  const int wide = std::max(0, std::min(most, needed));
  firsts = {per_beam * neighbours + wide};
  if (wide == 0 && sonar.beam_azimuths.empty()) {
    grid = BearingGrid::even(0, extent, narrow_count);
    return;
  }
  std::vector<double> centres;
  for (int cell = wide - 1; cell >= 0; --cell) {
    centres.push_back(middle + first_centre + cell * beam);
  }
  for (int cell = 0; cell < narrow_count; ++cell) {
    centres.push_back(middle + inner - (cell + 0.5) * narrow);
  }
  for (int cell = 0; cell < wide; ++cell) {
    centres.push_back(middle - first_centre - cell * beam);
  }
  grid = BearingGrid::touching(std::move(centres));
  for (const double edge : grid.edges()) {
    edge_sines.push_back(std::sin(edge));
  }
}

// Cuts each beam's slice into equal cells, and adds guard cells as wide as the outermost ones.
// @param reach  See guard_reach().
void BearingCells::set_fan(const SonarConfig& fan, double reach) {
  const BearingGrid beams = fan.bearings();
  const int last = beams.count() - 1;
  const double port_width = beams.width(0) / per_beam, starboard_width = beams.width(last) / per_beam;
  int to_port = guard_cells(beams.centres[0], beams.port[0], port_width, reach);
  int to_starboard = guard_cells(-beams.centres[last], -beams.starboard[last], starboard_width, reach);
  if (fan.has_even_beams()) {
    to_port = to_starboard = std::max(to_port, to_starboard);  // An even fan stays centred; they differ by rounding.
  }
  for (int beam = 0; beam < beams.count(); ++beam) {
    firsts.push_back(to_port + per_beam * beam);
  }
  if (fan.has_even_beams()) {
    grid = BearingGrid::even(0, fan.azimuth_aperture + (to_port + to_starboard) * port_width,
                             to_port + per_beam * beams.count() + to_starboard);
    return;
  }
  std::vector<double> centres;
  for (int cell = to_port; cell > 0; --cell) {
    centres.push_back(beams.port[0] + (cell - 0.5) * port_width);
  }
  for (int beam = 0; beam < beams.count(); ++beam) {
    const double width = beams.width(beam) / per_beam;
    for (int cell = 0; cell < per_beam; ++cell) {
      centres.push_back(beams.port[beam] - (cell + 0.5) * width);
    }
  }
  for (int cell = 0; cell < to_starboard; ++cell) {
    centres.push_back(beams.starboard[last] - (cell + 0.5) * starboard_width);
  }
  grid = centres.size() > 1 ? BearingGrid::touching(std::move(centres)) : beams;
}

// The same where there are gaps between beams: guard cells on either side of each gap as well, or in all of it if they
// would meet there.
// @param guard_width  Least width of a guard cell [rad].
void BearingCells::set_gapped_fan(const BearingGrid& beams, double reach, double guard_width) {
  const auto add_even = [this](double port, double starboard, int count) {
    const BearingGrid cells = BearingGrid::even(0.5 * (port + starboard), port - starboard, count);
    for (int i = 0; i < count; ++i) {  // Touching cells have the same edge, bit by bit.
      const double edge = i == 0 ? port : grid.starboard.back();
      grid.add(cells.centres[i], edge, i + 1 == count ? starboard : cells.starboard[i]);
    }
  };
  const auto guard_of = [&](int beam) { return std::max(guard_width, beams.width(beam) / per_beam); };
  const int last = beams.count() - 1;
  for (int beam = 0; beam <= last; ++beam) {
    const double guard = guard_of(beam), port = beams.port[beam], starboard = beams.starboard[beam];
    if (beam == 0) {
      const int cells = guard_cells(beams.centres[beam], port, guard, reach);
      add_even(port + cells * guard, port, cells);
    }
    firsts.push_back(grid.count());
    add_even(port, starboard, per_beam);
    if (beam == last) {
      const int cells = guard_cells(-beams.centres[beam], -starboard, guard, reach);
      add_even(starboard, starboard - cells * guard, cells);
    } else if (beams.gap_after(beam)) {
      const double next = beams.port[beam + 1], gap = starboard - next, next_guard = guard_of(beam + 1);
      const int cells = guard_cells(-beams.centres[beam], -starboard, guard, reach);
      const int next_cells = guard_cells(beams.centres[beam + 1], next, next_guard, reach);
      if (cells * guard + next_cells * next_guard >= gap) {
        add_even(starboard, next, static_cast<int>(std::ceil(gap / std::min(guard, next_guard))));
      } else {
        add_even(starboard, starboard - cells * guard, cells);
        add_even(next + next_cells * next_guard, next, next_cells);
      }
    }
  }
}

}  // namespace insonify
