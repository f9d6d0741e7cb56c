// triangulate.h -- cuts a polygon into triangles, concave ones too.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "insonify/geometry.h"

namespace insonify {

/// Cuts a simple, nearly plane polygon into corners.size() - 2 triangles that wind as it does. One that crosses itself
/// or has NaN corners is cut somehow, into as many.
/// @param corners    In order, at least 3.
/// @param triangles  Indices into `corners`; replaced.
void triangulate(std::span<const Vec3f> corners, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace insonify
