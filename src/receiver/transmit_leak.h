// transmit_leak.h -- transmit leak: the outgoing pulse in the receiver, its ring-down, and the dead range after it.

#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "insonify/ping.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Intensity of the leak over time since the start of transmission, re the source's at 1 m: `level` during the pulse,
/// then an exponential decay while the transducer rings.
///
/// A resonator of frequency f and quality factor Q loses 20 pi f log10(e) / Q = 27.29 f / Q decibels a second (Kinsler,
/// Frey, Coppens and Sanders, Fundamentals of Acoustics (2000), section 1.10). A linear filter preserves an
/// exponential decay, so this is also the decay of the matched filter's output.
struct LeakEnvelope {
  double level;     ///< Linear.
  double duration;  ///< Duration of the pulse [s].
  double decay;     ///< [dB/s], > 0.

  [[nodiscard]] double at(double time) const;
  /// Mean from the time `from` to `to` [s].
  [[nodiscard]] double mean(double from, double to) const;
};

/// Clears the dead bins of the received beams, and adds the leak to them.
///
/// The leak is the same in every ping: it is synchronous with the transmission, and transmitter, transducer and housing
/// do not change. Only the echoes and noise that interfere with it fluctuate. From beam to beam its level varies by a
/// normal deviate of SonarConfig::leak_spread_db, and its phase is uniformly random; both are drawn once, from the
/// seed. The one beam of a scanning head turns within its housing, part of whose echo is in the leak: its deviate is
/// one of the head's direction, the same in each turn, and directions half a beam apart are independent.
class TransmitLeak {
 public:
  /// @param sound_speed  Sound speed with which the sonar converts time to range [m/s].
  /// @param noise        Mean intensity of the receiver's noise, re the source's at 1 m.
  TransmitLeak(const SonarConfig& sonar, const ReceiverConfig& receiver, double sound_speed, double noise,
               std::uint64_t seed);

  /// Whether a sonar has a transmit leak or a dead range.
  [[nodiscard]] static bool is_in(const SonarConfig& sonar) { return sonar.leak_db || sonar.dead_range > 0; }

  /// Number of bins, from the first, in which no echo and no noise is received.
  [[nodiscard]] int dead_bins() const { return dead_bins_; }

  /// Number of bins, from the first, that are dead or in which the leak is above the noise; with leak_spread_db, three
  /// standard deviations above its mean. 0 if these are all bins.
  [[nodiscard]] int covered_bins() const { return covered_bins_; }

  /// Sets the leak of a scanning head's direction [rad].
  void turn_head(double angle);

  /// Clears the dead bins and adds the leak. Does not allocate.
  /// @param beams  [beam][bin]
  void receive_energy(std::span<float> beams) const;
  void receive_field(std::span<std::complex<float>> beams) const;
  /// Clears the dead bins only.
  void clear_dead(std::span<float> beams) const;

  /// Clears labels and direct echoes of a ping in the dead bins.
  void clear_truth(Ping& ping) const;

 private:
  int bins_, dead_bins_ = 0, covered_bins_ = 0;
  double spread_db_;
  int head_directions_ = 0;  // Independent directions of a scanning head; 0 of a fan.
  std::uint64_t seed_;
  std::vector<float> intensity_;            // [bin], up to the last bin with a leak.
  std::vector<std::complex<float>> beams_;  // Amplitude factor of each beam.
};

}  // namespace insonify
