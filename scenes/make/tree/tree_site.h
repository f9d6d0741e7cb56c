// tree_site.h -- the sand that the Christmas tree's well was drilled in, and the lines that lead away over it.

#pragma once

#include "kit/modelling.h"

/// Where the tree stands, as in scenes/christmas_tree.sdf; the world's z = 0 is the mean level of the bed.
inline const Vec3 kTreePosition{6.2, 0, 0};
inline constexpr double kTreeYawDeg = 158;
[[nodiscard]] Pose world_from_tree();

/// Height of the bed: undulation, burrowers' mounds and pits, the heap of drill cuttings about the well [m].
[[nodiscard]] double tree_bed_height(double x, double y);

/// The bed as a grid, finest where the shipped sonar looks.
[[nodiscard]] Shape make_tree_bed();

/// Flow line, annulus line and the umbilical's flying lead, from the tree's hubs over the bed; in the world's frame.
[[nodiscard]] Shape make_tree_lines();
