// surface_noise.h -- directional noise of the sea's surface in each beam of a sonar.

#pragma once

#include <span>
#include <vector>

#include "insonify/geometry.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Directional noise of wind and rain. Sources spread evenly over the surface, each a vertical dipole, give at a depth
/// h below it the noise per solid angle
///
///     N(t) = N / pi  sin(t) exp(-a h / sin(t)),   t > 0 above the horizon,
///
/// and none from below, where N is the level at the surface and a the absorption of intensity [1/m] (H. Cox, J. Acoust.
/// Soc. Am. 54(5), 1289 (1973); Urick, Principles of Underwater Sound (1983), section 7.3). Without absorption its
/// integral is N.
class SurfaceNoise {
 public:
  /// @param depth                 Depth of the sonar below the surface [m].
  /// @param absorption_db_per_m   One way.
  /// @param bearing_width         receive_bearing_width().
  SurfaceNoise(const SonarConfig& sonar, const ReceiverConfig& receiver, double depth, double absorption_db_per_m,
               double bearing_width);

  /// Integral of N(t) |g p|^2 over all directions, with N = 1, for each beam of a sonar.
  /// Does not allocate.
  /// @param shares  [beam], written.
  void receive(const Eigen::Quaterniond& world_from_sonar, std::span<double> shares) const;

 private:
  struct Elevation {
    double cosine, sine;
    double weight;  // |p|^2 cos(elevation) d(elevation).
  };
  std::vector<Elevation> elevations_;
  std::vector<double> cosines_, sines_;  // [beam] Cosine and sine of the azimuth.
  double lost_;                          // a h.
  double bearing_width_;
};

}  // namespace insonify
