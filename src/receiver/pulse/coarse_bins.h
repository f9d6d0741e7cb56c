// coarse_bins.h -- what a range bin keeps of a pulse that is shorter than it: level and statistics after decimation.

#pragma once

#include <optional>
#include <span>

#include "base/gamma_quantiles.h"
#include "insonify/receiver_config.h"
#include "receiver/pulse/range_response.h"

namespace insonify {

/// Bins of length L and a pulse of equivalent length l = integral of |p|^2 (docs/concepts/array-and-pulse.md,
/// Decimation). The grid holds the energy of whole bins. Of an extended echo the pulse receives l / L of it at a time;
/// a bin longer than the pulse holds n = L / l such looks, independent of each other, and keeps the greatest, the mean
/// or one of them. A compact echo, shorter than the pulse, has all of its energy in one look; where one is kept, it is
/// that one.
///
/// The cells of a bin are not deposited singly. What stands above twice the energy of both neighbours is taken to be
/// compact; and the intensity of the one look that is computed is given the distribution of the greatest or the mean of
/// n.
class CoarseBins {
 public:
  /// @param response  The same pulse, sampled at bins.
  CoarseBins(const Pulse& pulse, double bin_length, const RangeResponse& response, Decimation decimation);

  /// Whether an intensity that fluctuates has another distribution than that of one look.
  [[nodiscard]] bool has_looks() const { return looks_ > 1 && decimation_ != Decimation::kSample; }

  /// Replaces the energy of each bin of a row by that of one look.
  void receive(std::span<float> energy) const;

  /// The same for `energy`; writes the part of it that is extended to `extended`.
  void receive(std::span<float> energy, std::span<float> extended) const;

  /// Share of its energy with which a discrete echo is received: 1 / n for mean, else 1.
  [[nodiscard]] float discrete() const { return discrete_; }

  /// Intensity that a bin keeps, from that of one look. Where one look is exponentially distributed about `mean`, it is
  /// distributed as the greatest or the mean of n looks, n falling to 1 with the share of what is not in all of them.
  /// @param extended  Share of `mean` that every look has, 0..1.
  [[nodiscard]] float kept(float intensity, float mean, float extended) const;

 private:
  Decimation decimation_;
  double looks_;
  float share_ = 1;  // l / L over the response's equivalent cells: what makes the sum over bins the pulse's integral.
  float discrete_ = 1;
  std::optional<GammaQuantiles> mean_of_looks_;
};

}  // namespace insonify
