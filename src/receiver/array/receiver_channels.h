// receiver_channels.h -- differences between the receiver's channels: gains of groups of beams, missing beams,
// crosstalk.

#pragma once

#include <complex>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Gains of the beams and crosstalk between them (docs/concepts/channels.md).
class ReceiverChannels {
 public:
  explicit ReceiverChannels(const SonarConfig& sonar);

  /// Whether a sonar has different channel gains, missing beams or crosstalk.
  [[nodiscard]] static bool differ_in(const SonarConfig& sonar) {
    return !sonar.group_gains_db.empty() || !sonar.missing_beams.empty() || sonar.crosstalk_db;
  }

  /// [beam] Intensity gain, 0 for missing beams; empty if all are 1.
  [[nodiscard]] std::span<const float> gains() const { return gains_; }

  /// Adds to each beam the crosstalk from all beams: c times the sum of the beams' fields at the same range, with
  /// c = 10^(crosstalk_db / 20). The energy E of a beam becomes (1 + 2 c) E + c^2 times the sum of all beams' energies:
  /// the expected value for independent fields. Does not allocate.
  /// @param beams  [beam][bin].
  void couple_energy(std::span<float> beams, Workers& workers) const;
  void couple_field(std::span<std::complex<float>> beams, Workers& workers) const;

  /// Clears the labels of missing beams in a ping, and multiplies its direct echoes by the beams' gains.
  void receive_truth(Ping& ping) const;

 private:
  template <typename Value>
  void couple(std::span<Value> beams, float own, float share, Workers& workers) const;

  int beams_, bins_;
  std::vector<float> gains_;
  float crosstalk_ = 0;  // c.
};

}  // namespace insonify
