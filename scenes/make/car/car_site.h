// car_site.h -- the sand that the wrecked car lies on, and what fell off it.

#pragma once

#include "kit/modelling.h"

/// Where the car came to rest, as in scenes/car.sdf: its left side towards the origin, its right rear corner sunk in.
/// The world's z = 0 is the mean level of the sand.
inline const Vec3 kCarPosition{6.6, 0.2, -0.17};
inline constexpr double kCarRollDeg = 6;
inline constexpr double kCarPitchDeg = -3;
inline constexpr double kCarYawDeg = 112;
[[nodiscard]] Pose world_from_car();

/// Height of the sand: wave ripples, scour round the car and round stones [m].
[[nodiscard]] double car_bed_height(double x, double y);

/// The sand as a grid, finest where the shipped sonar looks.
[[nodiscard]] Shape make_car_bed();

/// Cobbles and a few boulders.
[[nodiscard]] Shape make_car_stones();

/// Wheel, door, bumper, hub cap and exhaust; in the world's frame.
[[nodiscard]] Shape make_car_debris();
