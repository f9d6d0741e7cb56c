// shape_maker.h -- makes the meshes of shapes.

#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "insonify/geometry.h"
#include "insonify/log.h"
#include "insonify/mesh.h"
#include "insonify/world_parts.h"
#include "io/file/missing_parts.h"
#include "io/world/round_shapes.h"

namespace insonify {

/// Side of the square that represents SDF's infinite plane [m].
inline constexpr double kInfinitePlane = 10000;

/// A mesh and the position of its origin in the frame of the visual.
struct PlacedMesh {
  std::shared_ptr<const Mesh> mesh;
  Vec3 offset = Vec3::Zero();  ///< [m]
  std::string part = {};       ///< Name of the part of a mesh file that it is; "" for a whole shape.
};

/// Makes each shape once: equal shapes share a mesh.
class ShapeMaker {
 public:
  /// @param log  Must outlive this object.
  explicit ShapeMaker(const Log& log) : log_(log) {}

  /// Counts a shape that make() will be asked for: unequal round shapes are made coarser where there are very many.
  void expect(const Shape& shape) { round_.add(shape); }

  /// Logs by how much round shapes are coarser than usual, if they are.
  /// @param name  Name of the whole, for the log.
  void report_coarse(const std::string& name);

  /// @param base  The file that URIs are relative to.
  /// @param what  "path:line:column: visual 'a::b::c'", for messages, which name the elements of SDF.
  /// @throws UnreadablePart for files that are missing or wrong, Error for sizes out of limits.
  [[nodiscard]] PlacedMesh make(const Shape& shape, const std::filesystem::path& base, const std::string& what);

  /// The named parts of a mesh file as load_mesh_parts(), at least one.
  /// @param shape  A kMesh without a submesh.
  [[nodiscard]] std::vector<PlacedMesh> make_parts(const Shape& shape, const std::filesystem::path& base,
                                                   const std::string& what);

 private:
  using Meshes = std::vector<std::shared_ptr<const Mesh>>;

  PlacedMesh shared(const std::string& key, const std::function<Mesh()>& make);
  const Meshes& all_shared(const std::string& key, const std::function<std::vector<Mesh>()>& make);
  PlacedMesh plane(const Shape& shape, const std::string& what);
  std::vector<PlacedMesh> mesh(const Shape& shape, const std::filesystem::path& base, const std::string& what,
                               bool parts);
  PlacedMesh heightmap(const Shape& shape, const std::filesystem::path& base, const std::string& what);
  PlacedMesh round(const Shape& shape, const std::string& what);

  const Log& log_;
  RoundShapes round_;
  std::map<std::string, Meshes> meshes_;
};

}  // namespace insonify
