// transmit_leak.h -- the transmitter's own sound in the receiver: the outgoing pulse, its ring-down, and the deaf time.

#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "insonify/ping.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Intensity of the leak at a time after the start of transmission, re the source's at 1 m: `level` while the pulse is
/// sent; then the transducer rings, and its energy decays exponentially.
///
/// A resonator of frequency f and quality factor Q loses 20 pi f log10(e) / Q = 27.29 f / Q decibels a second (Kinsler,
/// Frey, Coppens and Sanders, Fundamentals of Acoustics (2000), section 1.10). A filter passes an exponential as it is,
/// so that the decay is that of the matched filter's output too.
struct LeakEnvelope {
  double level;     ///< Linear.
  double duration;  ///< Duration of the pulse [s].
  double decay;     ///< [dB/s], > 0.

  [[nodiscard]] double at(double time) const;
  /// Mean from the time `from` to `to` [s].
  [[nodiscard]] double mean(double from, double to) const;
};

/// Adds the leak to beams of received echoes, from which it first takes what a deaf receiver does not hear.
///
/// The leak is the same in every ping: transmitter, transducer and housing do not change, and it is synchronous with
/// the transmission. What fluctuates in it are the echoes and the noise that it interferes with. Between beams its
/// level differs by a normal deviate of SonarConfig::leak_spread_db, and its phase is any: drawn once, by the seed.
class TransmitLeak {
 public:
  /// @param sound_speed  With which the sonar converts time to range [m/s].
  TransmitLeak(const SonarConfig& sonar, const ReceiverConfig& receiver, double sound_speed, std::uint64_t seed);

  /// Whether a sonar has a leak or a time in which it is deaf.
  [[nodiscard]] static bool is_in(const SonarConfig& sonar) { return sonar.leak_db || sonar.dead_range > 0; }

  /// Number of bins, from the first, in which no echo and no noise is received.
  [[nodiscard]] int dead_bins() const { return dead_bins_; }

  /// @param beams  [beam][bin]. Allocates nothing.
  void receive_energy(std::span<float> beams) const;
  void receive_field(std::span<std::complex<float>> beams) const;
  /// Clears the dead bins, and adds nothing.
  void clear_dead(std::span<float> beams) const;

  /// Takes labels and direct echoes from the dead bins of a ping: nothing was received from there.
  void clear_truth(Ping& ping) const;

 private:
  int bins_, dead_bins_ = 0;
  std::vector<float> intensity_;            // [bin], as far as there is any.
  std::vector<std::complex<float>> beams_;  // Amplitude factor of each beam.
};

}  // namespace insonify
