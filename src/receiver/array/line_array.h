// line_array.h -- the line arrays that produce a receiver's beam patterns, and the pattern across elevations.

#pragma once

#include <optional>

#include "insonify/array_pattern.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"
#include "sonar/elevation_pattern.h"

namespace insonify {

/// One-way array of a beam pattern; not for kTopHat. The array is a continuous line, except for kDolphChebyshev, which
/// is defined for discrete elements: it gets one at least every half wavelength.
/// @param beam_width  Full width at half power [rad]; determines the number of elements.
/// @throws Error if more elements are needed than an array may have.
[[nodiscard]] ArraySettings line_array(BeamPattern pattern, double side_lobe_db, double beam_width);

/// One-way array of a pattern across elevations, with the errors of the sonar's parts, as VerticalArray takes it;
/// absent for kTopHat.
/// @param pattern, aperture  Of the receiver or of the transmitter.
/// @throws Error as line_array().
[[nodiscard]] std::optional<ArraySettings> elevation_array(BeamPattern pattern, double aperture,
                                                           const ReceiverConfig& receiver, const SonarConfig& sonar);

/// The array that receives across bearings, with the faults of its elements. Where it also transmits
/// (SonarConfig::is_two_way()) its pattern applies twice. Not for kTopHat.
/// @throws Error as line_array().
[[nodiscard]] ArraySettings azimuth_array(const ReceiverConfig& receiver, const SonarConfig& sonar);

/// The same array without element faults.
[[nodiscard]] ArraySettings without_faults(ArraySettings array);

/// The array of azimuth_array() for the reception of noise: one way, without element faults.
[[nodiscard]] ArraySettings receiving_array(const ReceiverConfig& receiver, const SonarConfig& sonar);

/// Mean width of the slices of azimuth of a sonar's beams [rad].
[[nodiscard]] double slice_width(const SonarConfig& sonar);

/// Width of the beams of an azimuth pattern at half power [rad]: the sonar's azimuth_resolution, or where it has none
/// slice_width().
[[nodiscard]] double beam_width(const SonarConfig& sonar);

/// |p|^2 of a sonar across elevations, one way: an array that is baffled to the back, or a top hat. ElevationPattern is
/// a table of the same pattern, cut off where levels are negligible.
class AcrossElevations {
 public:
  AcrossElevations(const SonarConfig& sonar, const ReceiverConfig& receiver);

  // Elevations beyond which nothing is received [rad].
  [[nodiscard]] double low() const;
  [[nodiscard]] double high() const;

  [[nodiscard]] double intensity(double elevation) const;

  /// Length of the array [wavelengths]; absent for a top hat.
  [[nodiscard]] std::optional<double> length() const { return array_ ? std::optional(array_->length()) : std::nullopt; }

 private:
  double middle_, half_;
  std::optional<VerticalArray> array_;
};

}  // namespace insonify
