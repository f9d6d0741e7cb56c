// obj.h -- a shape as a Wavefront OBJ file with its materials beside it.

#pragma once

#include <filesystem>
#include <string>

#include "kit/normal_map.h"
#include "kit/shape.h"

/// A normal map that lies over a shape as seen from above.
struct Cover {
  std::string normal_map;  ///< File, beside the OBJ.
  MapArea area;
};

/// Writes FOLDER/NAME.obj and FOLDER/NAME.mtl in metres, z up, rounded to whole millimetres: equal shapes give equal
/// bytes. Triangles without area after rounding are dropped. Each file appears complete or not at all.
/// @throws std::runtime_error when a file cannot be written or a vertex is not finite.
void write_obj(const std::filesystem::path& folder, const std::string& name, const Shape& shape,
               const Cover* cover = nullptr);
