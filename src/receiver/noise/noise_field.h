// noise_field.h -- noise of a ping after array and matched filter: correlated along range and between beams.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/philox.h"
#include "insonify/array_pattern.h"
#include "insonify/pulse.h"
#include "receiver/array/gain_matrix.h"

namespace insonify {

/// Complex Gaussian noise, beams x bins, of mean square 2 (1 in each part), independent from ping to ping.
///
/// Along range it has the correlation of the matched filter's output, Pulse::noise_correlation(). Between beams it has
/// that of isotropic noise in the array's beams: for a line of length D the transform of its squared weights at
/// (D / wavelength) (u1 - u2), sinc for a rectangular window (Van Trees, Optimum Array Processing (2002), section 8.2).
///
/// White noise is drawn in rows of bins, one per orthogonal beam of the array, whose sines are wavelength / D apart;
/// filtered along each row; and summed over rows with the array's pattern, which gives the correlation exactly (the
/// sampling theorem: the weights end where the array does). A fan has fewer such rows than beams that overlap.
class NoiseField {
 public:
  struct Settings {
    int beams = 0, bins = 0;
    const Pulse& pulse;
    double bin_length = 0;  ///< [m]
    /// Array without faults, one way; null: beams are independent.
    const ArrayPattern* array = nullptr;
    double length = 0;                   ///< D / wavelength.
    std::span<const double> beam_sines;  ///< u of each beam.
    std::uint64_t seed = 1;
  };
  explicit NoiseField(const Settings& settings);

  /// Draws the noise of a ping. Allocates once per worker.
  void draw(std::uint64_t ping, Workers& workers);

  /// Sets the noise of the first `bins` bins of all beams to 0, until it is drawn again.
  void silence(int bins);

  /// Values of a beam for modification: real parts of all bins, then imaginary parts.
  [[nodiscard]] float* values(int beam) {
    return &(gains_ ? beam_values_ : row_values_)[static_cast<std::size_t>(beam) * 2 * bins_];
  }

  /// What the noise is drawn from: rows of white noise, a filter, and gains; without gains rows are the beams.
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] const std::vector<float>& taps() const { return taps_; }
  [[nodiscard]] GainTable gains() const { return gains_ ? gains_->table() : GainTable(); }

  /// Real and imaginary parts of a beam's bins.
  [[nodiscard]] const float* in_phase(int beam) const { return beam_row(beam); }
  [[nodiscard]] const float* quadrature(int beam) const { return beam_row(beam) + bins_; }

 private:
  [[nodiscard]] const float* beam_row(int beam) const {
    return &(gains_ ? beam_values_ : row_values_)[static_cast<std::size_t>(beam) * 2 * bins_];
  }

  int beams_, bins_, rows_;
  std::uint64_t seed_;
  std::vector<float> taps_;                      // Filter along range: value[bin] = sum of taps[k] white[bin - k].
  std::optional<GainMatrix> gains_;              // Beams x rows; none where rows are the beams.
  std::vector<float> row_values_, beam_values_;  // [row][2 x bin] and [beam][2 x bin]: real parts, then imaginary ones.
  std::vector<std::vector<float>> white_;        // [worker].
};

/// Draws a row of complex noise with the mean square 2, filtered along range. Allocates only where `white` is too
/// small.
/// @param in_phase, quadrature  Purposes of the random numbers of the real and imaginary parts.
/// @param values                2 x bins, written: real parts, then imaginary ones.
void draw_filtered_row(std::span<const float> taps, RandomPurpose in_phase, RandomPurpose quadrature, int row,
                       std::uint64_t ping, std::uint64_t seed, std::vector<float>& white, std::span<float> values);

/// Taps of a filter that gives white noise the correlation of the pulse's noise at whole bins; their squares sum to 1.
[[nodiscard]] std::vector<float> noise_taps(const Pulse& pulse, double bin_length);

}  // namespace insonify
