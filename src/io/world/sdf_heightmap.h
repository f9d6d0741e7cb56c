// sdf_heightmap.h -- stretches a grid of heights to the size that an SDF file asks for, as Gazebo does.

#pragma once

#include <optional>

#include "insonify/mesh.h"

namespace insonify {

/// Fits the grid into a box and puts `sampling` steps where there was one.
///
/// `size.z` is the height of the brightest pixel of a picture, whose black is height 0; of a survey grid it is the
/// difference between highest and lowest, and heights keep their zero.
/// @param size      Full lengths [m], > 0. Nothing leaves the grid as surveyed.
/// @param sampling  Steps per pixel, >= 1; heights in between are interpolated bilinearly.
void fit_heightmap(HeightGrid& grid, const std::optional<Vec3>& size, bool picture, int sampling);

}  // namespace insonify
