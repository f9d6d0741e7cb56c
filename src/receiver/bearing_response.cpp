// bearing_response.cpp -- the array's pattern as matrices, once for all pings.

#include "receiver/bearing_response.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace insonify {
namespace {

// Rows [first, last) of interleaved values become 0.
void clear_bins(float* beams, int beam_count, int stride, int first, int last) {
  for (int beam = 0; beam < beam_count; ++beam) {
    float* row = beams + static_cast<std::size_t>(beam) * stride;
    std::fill(row + first, row + last, 0.0F);
  }
}

}  // namespace

BearingResponse::BearingResponse(const ArrayPattern& pattern, double length, std::span<const double> cell_sines,
                                 std::span<const double> beam_sines, double floor_db)
    : pattern_(pattern), length_(length), beam_sines_(beam_sines.begin(), beam_sines.end()) {
  const auto cells = static_cast<int>(cell_sines.size());
  const auto beams = static_cast<int>(beam_sines.size());
  const double floor = std::pow(10, floor_db / 10);
  energy_ = in_phase_ = GainMatrix(beams, cells);
  if (!pattern.is_real()) {
    quadrature_ = GainMatrix(beams, cells);
  }
  for (int beam = 0; beam < beams; ++beam) {
    int first = cells, last = 0;
    for (int cell = 0; cell < cells; ++cell) {
      const std::complex<double> gain = this->gain(beam, cell_sines[cell]);
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

void BearingResponse::hear_energy(std::span<const float> cells, std::span<float> beams, int bin_count, BinRange bins,
                                  BinRange filled) const {
  assert(cells.size() == static_cast<std::size_t>(cell_count()) * bin_count);
  assert(beams.size() == static_cast<std::size_t>(beam_count()) * bin_count);
  clear_bins(beams.data(), beam_count(), bin_count, bins.first, bins.last);
  const BinRange added = bins & filled;
  energy_.add_product(cells.data(), beams.data(), bin_count, added.first, added.last, GainMatrix::Turn::kNone);
}

// A complex number is a pair of floats, which real gains multiply alike. The imaginary part of a gain multiplies the
// field turned by a quarter.
void BearingResponse::hear_field(std::span<const std::complex<float>> cells, std::span<std::complex<float>> beams,
                                 int bin_count, BinRange bins, BinRange filled) const {
  assert(cells.size() == static_cast<std::size_t>(cell_count()) * bin_count);
  assert(beams.size() == static_cast<std::size_t>(beam_count()) * bin_count);
  const auto* from = reinterpret_cast<const float*>(cells.data());
  auto* to = reinterpret_cast<float*>(beams.data());
  const BinRange added = bins & filled;
  const int stride = 2 * bin_count, first = 2 * added.first, last = 2 * added.last;
  clear_bins(to, beam_count(), stride, 2 * bins.first, 2 * bins.last);
  in_phase_.add_product(from, to, stride, first, last, GainMatrix::Turn::kNone);
  if (quadrature_.beam_count() > 0) {
    quadrature_.add_product(from, to, stride, first, last, GainMatrix::Turn::kQuarter);
  }
}

}  // namespace insonify
