// phase_receiver.h -- measures the phase between the halves of a multibeam's receive array.

#pragma once

#include <complex>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "insonify/ping.h"
#include "receiver/array/split_array.h"
#include "receiver/discrete_echoes.h"
#include "receiver/noise/noise_field.h"
#include "receiver/output_tile.h"

namespace insonify {

/// What a CalibratedReceiver does besides to fill Ping::phase. With speckle the differences of the halves are formed
/// from the cells' fields, with noise of their own: noise in the sum and in the difference of two halves is
/// independent and equally strong. Without speckle the phase is that of the mean product of the halves, without noise.
class PhaseReceiver {
 public:
  /// @param noise  How the receiver's own noise is drawn; null for none.
  PhaseReceiver(std::shared_ptr<const SplitArray> split, int beams, int bins, bool speckle,
                const NoiseField::Settings* noise);

  [[nodiscard]] const std::shared_ptr<const SplitArray>& split() const { return split_; }

  /// Forms differences from the cells, for the bins of one task; one of the two is empty.
  void form(std::span<const std::complex<float>> fields, std::span<const float> energies, BinRange bins);

  /// Adds echoes that are not in cells. Energies of them are left out.
  void add(const DiscreteEchoes& discrete, std::span<const DiscreteEcho> echoes);

  /// Draws the noise of a ping.
  void draw_noise(std::uint64_t ping, Workers& workers);

  /// Writes the phase of one beam of a tile.
  /// @param real, imaginary  The beam's sum, with its noise.
  /// @param deviation        Of the noise's parts.
  void measure(const TilePlace& place, int beam, const float* real, const float* imaginary, float deviation,
               Ping& ping) const;

 private:
  std::shared_ptr<const SplitArray> split_;
  int bins_;
  std::vector<std::complex<float>> differences_;  // [beam][bin], with speckle.
  std::vector<float> real_, imaginary_;           // [beam][bin] Product of the halves, without speckle.
  std::optional<NoiseField> noise_;
};

}  // namespace insonify
