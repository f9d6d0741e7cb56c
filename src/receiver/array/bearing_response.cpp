// bearing_response.cpp -- tabulates the array's beam pattern as gain matrices, once for all pings.

#include "receiver/array/bearing_response.h"

#include <algorithm>
#include <cassert>
#include <cmath>

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
                                 std::span<const double> beam_sines, double floor_db,
                                 std::span<const double> cell_edges)
    : pattern_(pattern), length_(length), beam_sines_(beam_sines.begin(), beam_sines.end()) {
  const auto cells = static_cast<int>(cell_sines.size());
  const auto beams = static_cast<int>(beam_sines.size());
  const double floor = std::pow(10, floor_db / 10);
  assert(cell_edges.empty() || cell_edges.size() == cell_sines.size() + 1);
  const auto is_wide = [&](int cell) {
    return !cell_edges.empty() && length * (cell_edges[cell] - cell_edges[cell + 1]) > kWideCell;
  };
  energy_ = in_phase_ = GainMatrix(beams, cells);
  if (!pattern.is_real()) {
    quadrature_ = GainMatrix(beams, cells);
  }
  for (int beam = 0; beam < beams; ++beam) {
    check_interruption();  // Thousands of beams take seconds.
    int first = cells, last = 0;
    for (int cell = 0; cell < cells; ++cell) {
      const std::complex<double> gain = is_wide(cell)
                                            ? std::sqrt(mean_intensity(beam, cell_edges[cell + 1], cell_edges[cell]))
                                            : this->gain(beam, cell_sines[cell]);
      energy_.set(beam, cell, static_cast<float>(std::norm(gain)));
      in_phase_.set(beam, cell, static_cast<float>(gain.real()));
      if (!pattern.is_real()) {
        quadrature_.set(beam, cell, static_cast<float>(gain.imag()));
      }
      if (std::norm(gain) >= floor) {
        first = std::min(first, cell);
        last = cell + 1;
      }
    }
    for (GainMatrix* matrix : {&energy_, &in_phase_, &quadrature_}) {
      if (matrix->beam_count() > 0) {
        matrix->limit(beam, first, last);
      }
    }
  }
}

// Mean of |g|^2 between two sines.
double BearingResponse::mean_intensity(int beam, double from, double to) const {
  constexpr double kStep = 1.0 / 16;  // [wavelength / D]
  const int steps = static_cast<int>(std::ceil(length_ * (to - from) / kStep));
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    sum += std::norm(gain(beam, from + (i + 0.5) / steps * (to - from)));
  }
  return sum / steps;
}

void BearingResponse::receive_energy(std::span<const float> cells, std::span<float> beams, int bin_count, BinRange bins,
                                     BinRange filled) const {
  assert(cells.size() == static_cast<std::size_t>(cell_count()) * bin_count);
  assert(beams.size() == static_cast<std::size_t>(beam_count()) * bin_count);
  const BinRange received = bins & filled;
  clear_outside(beams, bin_count, bins, received);
  energy_.multiply(cells.data(), beams.data(), bin_count, received.first, received.last);
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
  const int stride = 2 * bin_count, first = 2 * received.first, last = 2 * received.last;
  in_phase_.multiply(from, to, stride, first, last);
  if (quadrature_.beam_count() > 0) {
    quadrature_.add_turned(from, to, stride, first, last);
  }
}

}  // namespace insonify
