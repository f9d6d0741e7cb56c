// thruster_noise.h -- noise of the vehicle's thrusters as the beams of a sonar receive it.

#pragma once

#include <complex>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "insonify/array_pattern.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"
#include "insonify/thruster.h"
#include "insonify/water.h"
#include "receiver/array/across_elevations.h"
#include "receiver/noise/noise_field.h"
#include "sonar/fan_pattern.h"

namespace insonify {

/// Noise of sources at fixed places beside a sonar: rows of Gaussian noise, one for each, which all beams receive in
/// every bin with the gain of the array towards the source. The mean intensity of one in a beam, re the source's at
/// 1 m, is
///
///     10 log10 I = spectrum level + 10 log10 B - 20 log10 r - alpha r + 10 log10(|g|^2 |p|^2) - SL,
///
/// with the bandwidth B as in noise_intensity(). Along range the noise has the correlation of the matched filter, as
/// NoiseField; between beams it is coherent. Its intensity is modulated by the blades that pass, at the time at which a
/// bin is received less that of the way; a matched filter averages that over the pulse: by sinc(blade_rate T).
class ThrusterNoise {
 public:
  struct Settings {
    std::span<const Thruster> thrusters;
    const SonarConfig& sonar;  ///< Beams as they are steered.
    const ReceiverConfig& receiver;
    const Water& water;
    const Pulse& pulse;
    double duration = 0;                  ///< Of the pulse, 0 without one [s].
    double shown_speed = 0;               ///< Sound speed that the sonar assumes [m/s].
    const ArrayPattern* array = nullptr;  ///< That receives, one way; null: top-hat beams.
    double length = 0;                    ///< Of the array [wavelengths].
    double wavelength = 0;                ///< [m]
    std::uint64_t seed = 1;
  };
  explicit ThrusterNoise(const Settings& settings);

  /// Draws the noise of a ping and adds it to `noise`, in units of the standard deviation of each beam's own.
  /// @param places      [thruster] Places in the sonar's frame [m]; none where a surface is in the way.
  /// @param time        Time of transmission [s].
  /// @param deviations  [beam]
  void add_to(NoiseField& noise, std::span<const std::optional<Vec3>> places, std::uint64_t ping, double time,
              std::span<const float> deviations, Workers& workers);

  /// Mean intensity in a beam and bin in the last ping.
  [[nodiscard]] float intensity(int beam, int bin) const;

 private:
  struct Source {
    Thruster thruster;
    double range = 0;                         // [m]
    double mean = 0;                          // Intensity where the gain is 1.
    double depth = 0;                         // Of the modulation, after the filter.
    std::vector<ArrayPattern> patterns = {};  // [beam], out of focus; empty in focus.

    std::optional<Vec3> place = {};                 // For which the gains were computed.
    std::vector<std::complex<float>> gains = {};    // [beam]
    std::vector<float> values = {}, envelope = {};  // [2 x bin] and [bin].
  };
  void aim(Source& source, const Vec3& place) const;
  void draw(Source& source, int index, std::uint64_t ping, double time, std::vector<float>& white) const;
  [[nodiscard]] double bearing_of(const Vec3& direction) const;

  int beams_, bins_;
  BeamShape shape_;
  std::vector<double> edges_, sines_;  // Of the beams: azimuths of the edges [rad], sines of the middles.
  std::vector<float> taps_;
  std::optional<ArrayPattern> array_;
  double length_;
  FanPattern element_;
  AcrossElevations elevations_;
  double first_time_, time_per_bin_;  // Of reception, after transmission [s].
  double true_speed_;
  std::uint64_t seed_;
  std::vector<Source> sources_;
  std::vector<std::vector<float>> white_;  // [worker].
};

}  // namespace insonify
