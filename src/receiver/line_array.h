// line_array.h -- the array behind a pattern that a receiver names.

#pragma once

#include "insonify/array_pattern.h"
#include "insonify/receiver_config.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// One way; not for kTopHat. Elements have no place in closed forms: an array is one unbroken line, but for
/// kDolphChebyshev, which is made for elements and has one every half wavelength, or a little closer.
/// @param beam_width  Full width at half power [rad], for the number of elements.
/// @throws Error where that takes more than an array has.
[[nodiscard]] ArraySettings line_array(BeamPattern pattern, double side_lobe_db, double beam_width);

/// The array that hears across bearings, with its elements' faults; both ways on scanning heads. Not for kTopHat.
/// @throws Error where there is no such array.
[[nodiscard]] ArraySettings azimuth_array(const ReceiverConfig& receiver, const SonarConfig& sonar);

/// Width of the beams of an azimuth pattern: the sonar's azimuth_resolution, or a beam's share of the fan [rad].
[[nodiscard]] double beam_width(const SonarConfig& sonar);

}  // namespace insonify
