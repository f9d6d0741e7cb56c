// sea_scattering.h -- scattering and reflection of the windy sea surface at every angle of incidence.

#pragma once

#include <memory>

#include "insonify/scattering.h"

namespace insonify {

/// Backscatter and reflection loss of acoustics/surface_scattering.h. Between two directions: the facet lobe of the
/// given parameters, and the rest of the backscatter as the geometric mean of both directions.
/// @param wind_speed             [m/s], in (0, 30].
/// @param frequency              [Hz], > 0; below 10 kHz the report's values at 10 kHz.
/// @param reflection, rms_slope  Of the lobe that is added to AngularScattering::backscatter.
[[nodiscard]] std::shared_ptr<const AngularScattering> sea_scattering(double wind_speed, double frequency,
                                                                      double reflection, double rms_slope);

}  // namespace insonify
