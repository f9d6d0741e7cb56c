// normal_map.h -- normal maps, for detail that would need too many triangles.

#pragma once

#include <filesystem>

#include "kit/seabed.h"

/// A square of ground, seen from above, that a picture covers: x to the right, y up.
struct MapArea {
  double low_x, low_y, size;  ///< [m]
};

/// Writes a PNG of the normals of a ground in tangent space: 8 bits, red to the right, green up, blue out of the
/// ground. The file appears whole or not at all.
/// @param texels  On a side.
/// @throws std::runtime_error when it cannot be written.
void write_normal_map(const std::filesystem::path& path, const Ground& ground, const MapArea& area, int texels);
