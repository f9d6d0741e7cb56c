// stonefish_shapes.h -- makes meshes from the shapes of Stonefish's bodies.

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "insonify/log.h"
#include "insonify/mesh.h"
#include "io/stonefish/stonefish_element.h"

namespace insonify {

/// A mesh and its pose in the frame of the body.
struct StonefishShape {
  std::shared_ptr<const Mesh> mesh;
  Pose body_from_mesh = {};
  std::string part = {};  ///< Name of the part of a mesh file that it is; "" for a whole shape.
};

/// Makes each shape once: equal ones of the same material share a mesh.
class StonefishShapes {
 public:
  /// @param parts  Whether each named part of a mesh file is a shape.
  /// @param log    Must outlive this object.
  StonefishShapes(bool parts, const Log& log) : parts_(parts), log_(log) {}

  /// @param body       A body, a link or a part of a compound body.
  /// @param physical   Use the mesh of <physical> even if there is one of <visual>.
  /// @return           None for a type without a shape ("empty"), and for an unknown type, which is reported.
  /// @throws UnreadablePart for files that are missing or wrong, Error for sizes out of limits.
  [[nodiscard]] std::vector<StonefishShape> shapes(const StonefishElement& body, bool physical);

 private:
  using Meshes = std::vector<std::shared_ptr<const Mesh>>;

  const Meshes& all_shared(const std::string& key, const StonefishElement& body,
                           const std::function<std::vector<Mesh>()>& make);
  std::shared_ptr<const Mesh> shared(const std::string& key, const StonefishElement& body,
                                     const std::function<Mesh()>& make);
  std::vector<StonefishShape> model(const StonefishElement& body, bool physical);
  std::vector<StonefishShape> any_model(const StonefishElement& body, bool physical);
  std::optional<StonefishShape> solid(const StonefishElement& body);
  StonefishShape terrain(const StonefishElement& body);

  bool parts_;
  const Log& log_;
  std::map<std::string, Meshes> meshes_;
};

}  // namespace insonify
