// sdf_shape.h -- the geometry of a visual or a collision in an SDF file.

#pragma once

#include <optional>
#include <sdf/Geometry.hh>
#include <string>

#include "insonify/world_parts.h"

namespace insonify {

/// Absent for a shape that insonify does not have.
/// @param collision  Planes are infinite whatever their size, as in physics engines.
[[nodiscard]] std::optional<Shape> sdf_shape(const sdf::Geometry& geometry, bool collision);

/// Name of the element of a shape that insonify does not have; "" where there is none.
[[nodiscard]] std::string sdf_shape_name(const sdf::Geometry& geometry);

/// The file that a shape's URI is relative to, as libsdformat has it; "" for shapes without a URI.
[[nodiscard]] std::string sdf_shape_file(const sdf::Geometry& geometry);

}  // namespace insonify
