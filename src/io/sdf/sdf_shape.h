// sdf_shape.h -- makes a mesh of each geometry in an SDF file.

#pragma once

#include <optional>
#include <sdf/Geometry.hh>
#include <string>

#include "insonify/log.h"
#include "insonify/world_parts.h"
#include "io/sdf/sdf_source.h"
#include "io/world/shape_maker.h"

namespace insonify {

/// Makes each shape once: equal geometries share a mesh.
class SdfShapes {
 public:
  /// Both arguments must outlive this object.
  SdfShapes(const SdfSource& source, const Log& log) : source_(source), log_(log), maker_(log) {}

  /// @param what       "path:line:column: visual 'a::b::c'", for messages.
  /// @param collision  Planes are infinite whatever their size, as in physics engines.
  /// @return           Nothing for an unknown shape, which is reported to `log`.
  /// @throws UnreadablePart for files that are missing or wrong, Error for sizes out of limits.
  [[nodiscard]] std::optional<PlacedMesh> shape(const sdf::Geometry& geometry, const std::string& what, bool collision);

 private:
  [[nodiscard]] std::optional<Shape> unknown_shape(const sdf::Geometry& geometry, const std::string& what) const;

  const SdfSource& source_;
  const Log& log_;
  ShapeMaker maker_;
};

}  // namespace insonify
