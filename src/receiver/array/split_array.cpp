// split_array.cpp -- tabulates the difference pattern of an array as gain matrices.

#include "receiver/array/split_array.h"

#include <algorithm>
#include <cmath>

namespace insonify {

SplitArray::SplitArray(const ArrayPattern& array, double length, std::span<const double> cell_sines,
                       std::span<const double> beam_sines, const FanPattern& element)
    : array_(array),
      length_(length),
      element_(element),
      beam_sines_(beam_sines.begin(), beam_sines.end()),
      difference_(static_cast<int>(beam_sines.size()), static_cast<int>(cell_sines.size())),
      real_(difference_),
      imaginary_(difference_) {
  const auto cells = static_cast<int>(cell_sines.size());
  for (int beam = 0; beam < difference_.beam_count(); ++beam) {
    int first = cells, last = 0;
    for (int cell = 0; cell < cells; ++cell) {
      const double u = cell_sines[static_cast<std::size_t>(cell)], d = gain(beam, u), g = sum_gain(beam, u);
      difference_.set(beam, cell, static_cast<float>(d));
      real_.set(beam, cell, static_cast<float>(g * g - d * d));
      imaginary_.set(beam, cell, static_cast<float>(2 * g * d));
      if (std::abs(length_ * (u - beam_sines_[static_cast<std::size_t>(beam)])) <= kReach) {
        first = std::min(first, cell);
        last = cell + 1;
      }
    }
    for (GainMatrix* matrix : {&difference_, &real_, &imaginary_}) {
      matrix->limit(beam, first, last);
    }
  }
}

double SplitArray::gain(int beam, double u) const {
  const double x = length_ * (u - beam_sines_[static_cast<std::size_t>(beam)]);
  return std::abs(x) <= kReach ? array_.difference(x) * std::sqrt(element_.intensity(u)) : 0;
}

double SplitArray::sum_gain(int beam, double u) const {
  const double x = length_ * (u - beam_sines_[static_cast<std::size_t>(beam)]);
  return array_.amplitude(x).real() * std::sqrt(element_.intensity(u));
}

void SplitArray::receive_field(std::span<const std::complex<float>> cells, std::span<std::complex<float>> differences,
                               int bin_count, BinRange bins) const {
  difference_.multiply(reinterpret_cast<const float*>(cells.data()), reinterpret_cast<float*>(differences.data()),
                       2 * bin_count, 2 * bins.first, 2 * bins.last);
}

void SplitArray::receive_energy(std::span<const float> cells, std::span<float> real, std::span<float> imaginary,
                                int bin_count, BinRange bins) const {
  real_.multiply(cells.data(), real.data(), bin_count, bins.first, bins.last);
  imaginary_.multiply(cells.data(), imaginary.data(), bin_count, bins.first, bins.last);
}

}  // namespace insonify
