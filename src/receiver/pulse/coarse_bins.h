// coarse_bins.h -- range bins longer than the pulse: level and statistics after decimation.

#pragma once

#include <optional>
#include <span>

#include "base/gamma_quantiles.h"
#include "insonify/receiver_config.h"
#include "receiver/pulse/range_response.h"

namespace insonify {

/// Bins of length L and a pulse of equivalent length l = integral of |p|^2 (docs/concepts/array-and-pulse.md,
/// Decimation). The grid holds the energy of whole bins. The pulse receives l / L of an extended echo at a time, so
/// that a bin longer than the pulse holds n = L / l independent looks. Decimation keeps the greatest of them, their
/// mean, or one of them. A compact echo, shorter than the pulse, has all of its energy in one look, which is then the
/// one that decimation keeps.
///
/// Looks are not simulated one by one. A bin's energy above twice that of both neighbours counts as compact, and so
/// does the share ln n / (n - 1) of what two bins have above twice that of the neighbours of both: of echoes that two
/// bins hold, which are 0 to 2 L deep, it leaves (1 + ln n) / n on average. One look is computed, whose intensity is
/// transformed to the distribution of the greatest or the mean of n.
class CoarseBins {
 public:
  /// @param response  The same pulse, sampled at bins.
  CoarseBins(const Pulse& pulse, double bin_length, const RangeResponse& response, Decimation decimation);

  /// Whether decimation changes the distribution of fluctuating intensities.
  [[nodiscard]] bool has_looks() const { return looks_ > 1 && decimation_ != Decimation::kSample; }

  /// Replaces the energy of each bin of a row by that of one look.
  void receive(std::span<float> energy) const;

  /// The same, and writes the extended part of the energy to `extended`.
  void receive(std::span<float> energy, std::span<float> extended) const;

  /// See one_look().
  [[nodiscard]] float share() const { return share_; }
  [[nodiscard]] float pairs() const { return pairs_; }

  /// Factor on the energy of a discrete echo: 1 / n for kMean, else 1.
  [[nodiscard]] float discrete() const { return discrete_; }

  /// Intensity of the decimated bin, from that of one look. If one look is exponentially distributed with mean `mean`,
  /// the result is distributed as the greatest or the mean of n looks; n is reduced to 1 as `extended` falls to 0.
  /// @param extended  Share of `mean` that is in every look, 0..1.
  [[nodiscard]] float kept(float intensity, float mean, float extended) const;

 private:
  Decimation decimation_;
  double looks_;
  float share_ =
      1;  // l / L divided by the response's equivalent cells, so that the sum over bins equals the pulse's integral.
  float pairs_ = 1;  // Share of the energy of two bins above their neighbours that counts as compact.
  float discrete_ = 1;
  std::optional<GammaQuantiles> mean_of_looks_;
};

}  // namespace insonify
