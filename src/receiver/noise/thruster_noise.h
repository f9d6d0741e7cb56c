// thruster_noise.h -- noise of the vehicle's thrusters in the beams of a sonar.

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
#include "receiver/array/line_array.h"
#include "receiver/noise/noise_field.h"
#include "sonar/fan_pattern.h"

namespace insonify {

/// Noise of sources near a sonar: one row of Gaussian noise per source, which each beam receives with the array's gain
/// towards the source. Its mean intensity in a beam, re the sonar's source at 1 m, is
///
///     10 log10 I = spectrum level + 10 log10 B - 20 log10 r - alpha r + 10 log10(|g|^2 |p|^2) - SL,
///
/// with the bandwidth B as in noise_intensity(). Along range the noise has the correlation of the matched filter, as
/// NoiseField; between beams it is coherent. Passing blades modulate its intensity, at the bin's time of reception
/// minus the travel time. The matched filter averages this over the pulse, which reduces the depth by sinc(blade_rate
/// T).
class ThrusterNoise {
 public:
  struct Settings {
    std::span<const Thruster> thrusters;
    const SonarConfig& sonar;  ///< With the beams' true bearings.
    const ReceiverConfig& receiver;
    const Water& water;
    const Pulse& pulse;
    double duration = 0;                  ///< Duration of the pulse, 0 without one [s].
    double shown_speed = 0;               ///< Sound speed that the sonar assumes [m/s].
    const ArrayPattern* array = nullptr;  ///< Receiving array, one way; null: top-hat beams.
    double length = 0;                    ///< Length of the array [wavelengths].
    double wavelength = 0;                ///< [m]
    std::uint64_t seed = 1;
  };
  explicit ThrusterNoise(const Settings& settings);

  /// Draws the noise of a ping and adds it to `noise`, in units of the standard deviation of each beam's own.
  /// @param places      [thruster] Position in the sonar frame [m]; none if the straight path is blocked.
  /// @param time        Time of transmission [s].
  /// @param deviations  [beam]
  void add_to(NoiseField& noise, std::span<const std::optional<Vec3>> places, std::uint64_t ping, double time,
              std::span<const float> deviations, Workers& workers);

  /// Mean intensity in a beam and bin in the last ping.
  [[nodiscard]] float intensity(int beam, int bin) const;

 private:
  struct Source {
    Thruster thruster;
    double range = 0;       // [m]
    double mean = 0;        // Intensity for a gain of 1.
    double depth = 0;       // Depth of the modulation after the matched filter.
    double edge_phase = 0;  // Phase at the edges of the unsteered array, see ArrayPattern::defocused() [rad].

    std::optional<Vec3> place = {};                 // Position for which `gains` were computed.
    std::vector<std::complex<float>> gains = {};    // [beam]
    std::vector<float> values = {}, envelope = {};  // [2 x bin] and [bin].
  };
  void aim(Source& source, const Vec3& place) const;
  void draw(Source& source, int index, std::uint64_t ping, double time, std::vector<float>& white) const;
  [[nodiscard]] double bearing_of(const Vec3& direction) const;

  int beams_, bins_;
  BeamShape shape_;
  BearingGrid slices_;         // Of the beams.
  std::vector<double> sines_;  // [beam] Sines of the middles.
  std::vector<float> taps_;
  std::optional<ArrayPattern> array_;
  double length_;
  FanPattern element_;
  AcrossElevations elevations_;
  double first_time_, time_per_bin_;  // Reception of bin 0, after transmission, and bin length [s].
  double true_speed_;
  std::uint64_t seed_;
  std::vector<Source> sources_;
  std::vector<std::vector<float>> white_;  // [worker].
};

}  // namespace insonify
