// split_array.h -- the difference between the halves of a multibeam's receive array, from which phase is measured.

#pragma once

#include <complex>
#include <span>

#include "echo/grid/echo_grid.h"
#include "insonify/array_pattern.h"
#include "receiver/array/gain_matrix.h"
#include "sonar/fan_pattern.h"

namespace insonify {

/// Forms the differences d f of the halves of an array for each beam, besides the sums g f that BearingResponse forms:
/// see ArrayPattern::difference(). With a beam's sum F and difference D, its halves receive (F - i D) / 2 (port) and
/// (F + i D) / 2 (starboard), and the phase between them is that of |F|^2 - |D|^2 + 2 i Re(F conj D).
///
/// The array is taken as in focus and without faults. Echoes more than kReach beams off the axis of a beam, such as
/// those that a level bottom sends into the side lobes of all beams, are in its sum only: their phase means nothing.
class SplitArray {
 public:
  static constexpr double kReach = 6;  ///< [wavelength / D]

  /// @param array       One way; its faults do not matter.
  /// @param length      D / wavelength.
  /// @param cell_sines  u of each cell's centre.
  /// @param beam_sines  u0 of each beam.
  /// @param element     One element's gain.
  SplitArray(const ArrayPattern& array, double length, std::span<const double> cell_sines,
             std::span<const double> beam_sines, const FanPattern& element);

  /// Gain d of an echo from u in a beam; 0 beyond kReach.
  [[nodiscard]] double gain(int beam, double u) const;

  /// Differences of complex fields, for the bins of one task; shapes as BearingResponse::receive_field().
  void receive_field(std::span<const std::complex<float>> cells, std::span<std::complex<float>> differences,
                     int bin_count, BinRange bins) const;

  /// Of energies E: the sums over cells of (g^2 - d^2) E and of 2 g d E, real and imaginary part of the product of the
  /// halves; shapes as BearingResponse::receive_energy().
  void receive_energy(std::span<const float> cells, std::span<float> real, std::span<float> imaginary, int bin_count,
                      BinRange bins) const;

 private:
  [[nodiscard]] double sum_gain(int beam, double u) const;

  ArrayPattern array_;
  double length_;
  FanPattern element_;
  std::vector<double> beam_sines_;
  GainMatrix difference_, real_, imaginary_;
};

}  // namespace insonify
