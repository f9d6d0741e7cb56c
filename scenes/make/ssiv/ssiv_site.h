// ssiv_site.h -- the shallow bay that the SSIV's mock-up was set down in, and what lies around it.

#pragma once

#include "kit/modelling.h"

/// Where it stands, as in scenes/ssiv.sdf.
inline const Vec3 kSsivPosition{6.4, 0.1, 0.05};
inline constexpr double kSsivRollDeg = 0.5;
inline constexpr double kSsivPitchDeg = -0.7;
inline constexpr double kSsivYawDeg = -68;
[[nodiscard]] Pose world_from_ssiv();

/// Height of the bed: short ripples of the swell, scoured at the mudmats.
[[nodiscard]] double ssiv_ground(double x, double y);

/// The bed as a grid, finest where the shipped sonar looks.
[[nodiscard]] Shape make_ssiv_bed();

/// Stones, the concrete sinker of the marker buoy and its rope, in the world.
[[nodiscard]] Shape make_ssiv_surroundings();
