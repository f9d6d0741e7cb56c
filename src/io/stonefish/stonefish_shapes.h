// stonefish_shapes.h -- makes meshes from the shapes of Stonefish's bodies.

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "insonify/log.h"
#include "insonify/mesh.h"
#include "io/stonefish/stonefish_element.h"

namespace insonify {

/// A mesh and its pose in the frame of the body.
struct StonefishShape {
  std::shared_ptr<const Mesh> mesh;
  Pose body_from_mesh = {};
};

/// Makes each shape once: equal ones of the same material share a mesh.
class StonefishShapes {
 public:
  /// @param log  Must outlive this object.
  explicit StonefishShapes(const Log& log) : log_(log) {}

  /// @param body       A body, a link or a part of a compound body.
  /// @param physical   Use the mesh of <physical> even if there is one of <visual>.
  /// @return           Nothing for a type without a shape ("empty"), and for an unknown type, which is reported.
  /// @throws UnreadablePart for files that are missing or wrong, Error for sizes out of limits.
  [[nodiscard]] std::optional<StonefishShape> shape(const StonefishElement& body, bool physical);

 private:
  std::shared_ptr<const Mesh> shared(const std::string& key, const StonefishElement& body,
                                     const std::function<Mesh()>& make);
  StonefishShape model(const StonefishElement& body, bool physical);
  StonefishShape any_model(const StonefishElement& body, bool physical);
  StonefishShape terrain(const StonefishElement& body);

  const Log& log_;
  std::map<std::string, std::shared_ptr<const Mesh>> meshes_;
};

}  // namespace insonify
