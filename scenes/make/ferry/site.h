// site.h -- the sea bed that the ferry lies on: its shape, and where things are on it.

#pragma once

#include "kit/modelling.h"

/// Where the wreck came to rest, as in scenes/ferry.sdf: listing to starboard, down by the stern, its starboard bow
/// towards the origin. The ferry's own frame is that of ferry.h; the world's z = 0 is the mean level of the bed.
inline const Vec3 kWreckPosition{39.0, 24.0, -0.9};
inline constexpr double kWreckRollDeg = 17;
inline constexpr double kWreckPitchDeg = -2.2;
inline constexpr double kWreckYawDeg = -106;
[[nodiscard]] Pose world_from_wreck();

/// The bed covers this far in each direction from its middle [m].
inline constexpr double kBedHalfWidth = 60;
inline constexpr double kBedMiddleX = 30;

[[nodiscard]] const std::vector<Boulder>& boulders();

/// Height of the sand without its ripples: undulation and scour [m].
[[nodiscard]] double bed_height(double x, double y);

/// Height of the ripples [m], which are lower next to the wreck and around stones. They are put on the bed as a normal
/// map.
[[nodiscard]] double bed_ripples(double x, double y);
inline constexpr MapArea kBedArea{kBedMiddleX - kBedHalfWidth, -kBedHalfWidth, 2 * kBedHalfWidth};
inline constexpr int kBedMapTexels = 1024;  ///< Eight a ripple.

/// The bed as a grid, finest where the shipped sonar looks: 0.25 by 0.3 m.
[[nodiscard]] Shape make_seabed();
