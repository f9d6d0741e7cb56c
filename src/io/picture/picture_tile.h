// picture_tile.h -- converts normal maps, height maps and grey pictures to tiles of a relief.

#pragma once

#include "insonify/relief.h"
#include "io/picture/png_reader.h"

namespace insonify {

/// Slopes from a picture of normals in tangent space: red to the right, green up, blue out of the surface; 128 (32768
/// with 16 bits) is 0.
/// @throws Error for a grey picture, or one whose normals mostly lie in the surface.
[[nodiscard]] Tile<Eigen::Vector2f> read_normals(const PngReader& png);

/// Slopes, per tile, from a grey picture of heights.
/// @param height  Height of white above black [m].
[[nodiscard]] Tile<Eigen::Vector2f> read_heights(const PngReader& png, double height);

/// Grey levels, 0..1.
/// @param purpose  Subject of the error message: "a reflectivity map needs".
[[nodiscard]] Tile<float> read_levels(const PngReader& png, std::string_view purpose);

}  // namespace insonify
