// shape_maker.h -- makes a mesh of each shape.

#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "insonify/geometry.h"
#include "insonify/log.h"
#include "insonify/mesh.h"
#include "insonify/world_parts.h"
#include "io/file/missing_parts.h"

namespace insonify {

/// Side of the square that represents SDF's infinite plane [m].
inline constexpr double kInfinitePlane = 10000;

/// A mesh and the position of its origin in the frame of the visual.
struct PlacedMesh {
  std::shared_ptr<const Mesh> mesh;
  Vec3 offset = Vec3::Zero();  ///< [m]
};

/// Makes each shape once: equal shapes share a mesh.
class ShapeMaker {
 public:
  /// @param log  Must outlive this object.
  explicit ShapeMaker(const Log& log) : log_(log) {}

  /// @param base  The file that URIs are relative to.
  /// @param what  "path:line:column: visual 'a::b::c'", for messages, which name the elements of SDF.
  /// @throws UnreadablePart for files that are missing or wrong, Error for sizes out of limits.
  [[nodiscard]] PlacedMesh make(const Shape& shape, const std::filesystem::path& base, const std::string& what);

 private:
  PlacedMesh shared(const std::string& key, const std::function<Mesh()>& make);
  PlacedMesh plane(const Shape& shape, const std::string& what);
  PlacedMesh mesh(const Shape& shape, const std::filesystem::path& base, const std::string& what);
  PlacedMesh heightmap(const Shape& shape, const std::filesystem::path& base, const std::string& what);

  const Log& log_;
  std::map<std::string, std::shared_ptr<const Mesh>> meshes_;
};

}  // namespace insonify
