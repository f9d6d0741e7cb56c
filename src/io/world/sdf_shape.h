// sdf_shape.h -- makes a mesh of each geometry in an SDF file.

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <sdf/Geometry.hh>
#include <string>

#include "insonify/error.h"
#include "insonify/geometry.h"
#include "insonify/log.h"
#include "insonify/mesh.h"
#include "io/world/sdf_source.h"

namespace insonify {

/// Side of the square that represents SDF's infinite plane [m].
inline constexpr double kInfinitePlane = 10000;

/// A mesh and the position of its origin in the frame of the visual.
struct SdfShape {
  std::shared_ptr<const Mesh> mesh;
  Vec3 offset = Vec3::Zero();  ///< [m]
};

/// A file of a shape that is missing or cannot be read.
class SdfUnreadable : public Error {
 public:
  /// @param the_part    "path:line:column: visual 'a::b': 'x.dae'"
  /// @param the_reason  What follows in the message.
  /// @param model_uri   Of the Fuel model to fetch; "" for a file that is none of Fuel's.
  SdfUnreadable(const std::string& the_part, const std::string& the_reason, const std::string& model_uri = "")
      : Error(the_part + the_reason), part(the_part), reason(the_reason), fuel_uri(model_uri) {}
  std::string part, reason, fuel_uri;
};

/// Makes each shape once: equal geometries share a mesh.
class SdfShapes {
 public:
  /// Both arguments must outlive this object.
  SdfShapes(const SdfSource& source, const Log& log) : source_(source), log_(log) {}

  /// @param what       "path:line:column: visual 'a::b::c'", for messages.
  /// @param collision  Planes are infinite whatever their size, as in physics engines.
  /// @return           Nothing for an unknown shape, which is reported to `log`.
  /// @throws SdfUnreadable for files that are missing or wrong, Error for sizes out of limits.
  [[nodiscard]] std::optional<SdfShape> shape(const sdf::Geometry& geometry, const std::string& what, bool collision);

 private:
  std::shared_ptr<const Mesh> shared(const std::string& key, const std::function<Mesh()>& make);
  std::optional<SdfShape> unknown_shape(const sdf::Geometry& geometry, const std::string& what);
  SdfShape plane(const sdf::Plane& plane, const std::string& what, bool collision);
  SdfShape mesh(const sdf::Mesh& mesh, const std::string& what);
  SdfShape heightmap(const sdf::Heightmap& heightmap, const std::string& what);
  std::string file(const std::string& uri, const std::string& base, const std::string& what) const;

  const SdfSource& source_;
  const Log& log_;
  std::map<std::string, std::shared_ptr<const Mesh>> meshes_;
};

}  // namespace insonify
