// bearing_response.cpp -- tabulates the array's beam pattern as gain matrices, once for all pings.

#include "receiver/array/bearing_response.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/interruption.h"

namespace insonify {
namespace {

// Sets the bins of `bins` that are not in `kept` to 0 in every row of `beams`, [beam][bin].
template <typename Value>
void clear_outside(std::span<Value> beams, int bin_count, BinRange bins, BinRange kept) {
  const int first = kept.empty() ? bins.last : kept.first, last = kept.empty() ? bins.last : kept.last;
  for (std::size_t start = 0; start < beams.size(); start += bin_count) {
    const auto row = beams.subspan(start, bin_count);
    std::fill(row.begin() + bins.first, row.begin() + first, Value{});
    std::fill(row.begin() + last, row.begin() + bins.last, Value{});
  }
}

}  // namespace

BearingResponse::BearingResponse(const ArrayPattern& pattern, double length, std::span<const double> cell_sines,
                                 std::span<const double> beam_sines, double floor_db, const Extras& extras)
    : pattern_(pattern),
      length_(length),
      element_(extras.element),
      beam_sines_(beam_sines.begin(), beam_sines.end()),
      gains_(std::max<std::size_t>(1, extras.zones.size())) {
  assert(extras.cell_edges.empty() || extras.cell_edges.size() == cell_sines.size() + 1);
  for (std::size_t i = 0; i < extras.zones.size(); ++i) {
    gains_[i].end = extras.zones[i].end;
    gains_[i].edge_phase = extras.zones[i].edge_phase;
  }
  for (Gains& zone : gains_) {
    fill(zone, cell_sines, std::pow(10, floor_db / 10), extras.cell_edges);
  }
}

std::complex<double> BearingResponse::gain_of(const ArrayPattern& pattern, int beam, double u) const {
  const std::complex<double> array = pattern.amplitude(length_ * (u - beam_sines_[beam]));
  return element_.is_flat() ? array : array * std::sqrt(element_.intensity(u));
}

std::complex<double> BearingResponse::gain(int beam, double u, int bin) const {
  const auto zone = std::ranges::find_if(gains_, [&](const Gains& gains) { return bin < gains.end; });
  return gain_of(pattern_in(zone == gains_.end() ? gains_.back() : *zone, beam), beam, u);
}

void BearingResponse::fill(Gains& zone, std::span<const double> cell_sines, double floor,
                           std::span<const double> cell_edges) const {
  const auto cells = static_cast<int>(cell_sines.size());
  const auto beams = static_cast<int>(beam_sines_.size());
  const auto is_wide = [&](int cell) {
    return !cell_edges.empty() && length_ * (cell_edges[cell] - cell_edges[cell + 1]) > kWideCell;
  };
  const bool is_real = pattern_.is_real() && zone.edge_phase == 0;
  zone.energy = zone.in_phase = GainMatrix(beams, cells);
  if (!is_real) {
    zone.quadrature = GainMatrix(beams, cells);
  }
  for (int beam = 0; beam < beams; ++beam) {
    check_interruption();  // Thousands of beams take seconds.
    if (zone.edge_phase != 0) {
      const double sine = beam_sines_[beam];  // The projected length of a steered array is shorter.
      zone.patterns.push_back(pattern_.defocused(zone.edge_phase * (1 - sine * sine)));
    }
    const ArrayPattern& pattern = pattern_in(zone, beam);
    int first = cells, last = 0;
    for (int cell = 0; cell < cells; ++cell) {
      const std::complex<double> gain =
          is_wide(cell) ? std::sqrt(mean_intensity(pattern, beam, cell_edges[cell + 1], cell_edges[cell]))
                        : gain_of(pattern, beam, cell_sines[cell]);
      zone.energy.set(beam, cell, static_cast<float>(std::norm(gain)));
      zone.in_phase.set(beam, cell, static_cast<float>(gain.real()));
      if (!is_real) {
        zone.quadrature.set(beam, cell, static_cast<float>(gain.imag()));
      }
      if (std::norm(gain) >= floor) {
        first = std::min(first, cell);
        last = cell + 1;
      }
    }
    for (GainMatrix* matrix : {&zone.energy, &zone.in_phase, &zone.quadrature}) {
      if (matrix->beam_count() > 0) {
        matrix->limit(beam, first, last);
      }
    }
  }
}

// Mean of |g|^2 between two sines.
double BearingResponse::mean_intensity(const ArrayPattern& pattern, int beam, double from, double to) const {
  constexpr double kStep = 1.0 / 16;  // [wavelength / D]
  const int steps = static_cast<int>(std::ceil(length_ * (to - from) / kStep));
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    sum += std::norm(gain_of(pattern, beam, from + (i + 0.5) / steps * (to - from)));
  }
  return sum / steps;
}

// Calls receive(gains, bins) for each zone with its part of the bins.
template <typename Receive>
void BearingResponse::for_each_zone(BinRange bins, const Receive& receive) const {
  int first = bins.first;
  for (const Gains& zone : gains_) {
    const int last = &zone == &gains_.back() ? bins.last : std::min(bins.last, zone.end);
    if (first < last) {
      receive(zone, BinRange{first, last});
      first = last;
    }
  }
}

void BearingResponse::receive_energy(std::span<const float> cells, std::span<float> beams, int bin_count, BinRange bins,
                                     BinRange filled) const {
  assert(cells.size() == static_cast<std::size_t>(cell_count()) * bin_count);
  assert(beams.size() == static_cast<std::size_t>(beam_count()) * bin_count);
  const BinRange received = bins & filled;
  clear_outside(beams, bin_count, bins, received);
  for_each_zone(received, [&](const Gains& zone, BinRange part) {
    zone.energy.multiply(cells.data(), beams.data(), bin_count, part.first, part.last);
  });
}

// A complex row is processed as 2 x bin_count floats, because a real gain multiplies both parts alike. The imaginary
// part of a gain multiplies i x field: add_turned() swaps the two floats of each value and negates one.
void BearingResponse::receive_field(std::span<const std::complex<float>> cells, std::span<std::complex<float>> beams,
                                    int bin_count, BinRange bins, BinRange filled) const {
  assert(cells.size() == static_cast<std::size_t>(cell_count()) * bin_count);
  assert(beams.size() == static_cast<std::size_t>(beam_count()) * bin_count);
  const auto* from = reinterpret_cast<const float*>(cells.data());
  auto* to = reinterpret_cast<float*>(beams.data());
  const BinRange received = bins & filled;
  clear_outside(beams, bin_count, bins, received);
  for_each_zone(received, [&](const Gains& zone, BinRange part) {
    const int stride = 2 * bin_count, first = 2 * part.first, last = 2 * part.last;
    zone.in_phase.multiply(from, to, stride, first, last);
    if (zone.quadrature.beam_count() > 0) {
      zone.quadrature.add_turned(from, to, stride, first, last);
    }
  });
}

std::vector<BearingResponse::Zone> focus_zones(const SonarConfig& sonar, double length, double wavelength,
                                               double range_scale) {
  std::vector<BearingResponse::Zone> zones;
  if (!sonar.focus_range) {
    return zones;
  }
  // Phases differ within a zone by at most kStep, or by kShare of themselves where they are large. Echoes from nearer
  // than the array is long do not have quadratic phases.
  constexpr double kStep = 0.12, kShare = 0.05;
  const double across = length * wavelength;
  const auto phase_of = [&](int bin) {
    const double range = std::max(range_scale * sonar.bin_range(bin), across);
    return 0.25 * std::numbers::pi * length * across * (1 / range - 1 / *sonar.focus_range);
  };
  for (int first = 0; first < sonar.bin_count;) {
    const double begins = phase_of(first), most = std::max(kStep, kShare * std::abs(begins));
    int end = first + 1;
    while (end < sonar.bin_count && std::abs(phase_of(end) - begins) <= most) {
      ++end;
    }
    const double phase = 0.5 * (begins + phase_of(end - 1));
    zones.push_back({end, std::abs(phase) < 0.5 * kStep ? 0 : phase});
    first = end;
  }
  return zones;
}

}  // namespace insonify
