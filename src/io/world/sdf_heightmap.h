// sdf_heightmap.h -- scales a height grid to the size that an SDF file gives, as Gazebo does.

#pragma once

#include <optional>

#include "insonify/mesh.h"

namespace insonify {

/// Scales the grid to a box and divides each of its steps into `sampling`.
///
/// `size.z` is the height of the brightest pixel of a picture, whose black is height 0; of a survey grid it is the
/// difference between highest and lowest, and heights keep their zero.
/// @param size      Full lengths [m], > 0. Empty: the grid keeps its own size.
/// @param sampling  Steps per pixel, >= 1; heights in between are interpolated bilinearly.
void fit_heightmap(HeightGrid& grid, const std::optional<Vec3>& size, bool picture, int sampling);

}  // namespace insonify
