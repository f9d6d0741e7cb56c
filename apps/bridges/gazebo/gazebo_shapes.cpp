// gazebo_shapes.cpp -- converts the shapes of gz.msgs.

#include "gazebo/gazebo_shapes.h"

#include <fmt/format.h>

#include <algorithm>

namespace insonify {
namespace {

using ignition::msgs::Geometry;

Vec3 vec3(const ignition::msgs::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

// Paths of files in model folders may begin with "file://".
Shape mesh(const ignition::msgs::MeshGeom& from) {
  return {.kind = ShapeKind::kMesh,
          .uri = from.filename(),
          .submesh = from.submesh(),
          .center_submesh = from.center_submesh(),
          .scale = from.has_scale() ? vec3(from.scale()) : Vec3(Vec3::Ones())};
}

// Gazebo sends every heightmap with a size, by default SDF's.
Shape heightmap(const ignition::msgs::HeightmapGeom& from) {
  Shape shape{.kind = ShapeKind::kHeightmap, .uri = from.filename(), .position = vec3(from.origin())};
  shape.sampling = static_cast<int>(std::clamp(from.sampling(), 1U, 1000U));
  if (from.has_size() && vec3(from.size()) != Vec3::Ones()) {
    shape.size = vec3(from.size());
  }
  return shape;
}

}  // namespace

std::variant<Shape, std::string> shape_of(const Geometry& from) {
  switch (from.type()) {
    case Geometry::BOX:
      return Shape{.kind = ShapeKind::kBox, .size = vec3(from.box().size())};
    case Geometry::SPHERE:
      return Shape{.kind = ShapeKind::kSphere, .radius = from.sphere().radius()};
    case Geometry::ELLIPSOID:
      return Shape{.kind = ShapeKind::kEllipsoid, .size = vec3(from.ellipsoid().radii())};
    case Geometry::CYLINDER:
      return Shape{
          .kind = ShapeKind::kCylinder, .radius = from.cylinder().radius(), .length = from.cylinder().length()};
    case Geometry::CAPSULE:
      return Shape{.kind = ShapeKind::kCapsule, .radius = from.capsule().radius(), .length = from.capsule().length()};
    case Geometry::CONE:
      return Shape{.kind = ShapeKind::kCone, .radius = from.cone().radius(), .length = from.cone().length()};
    case Geometry::PLANE:
      return Shape{.kind = ShapeKind::kPlane,
                   .size = Vec3(from.plane().size().x(), from.plane().size().y(), 1),
                   .normal = vec3(from.plane().normal()).normalized()};
    case Geometry::MESH:
      return mesh(from.mesh());
    case Geometry::HEIGHTMAP:
      if (from.heightmap().filename().empty()) {
        return "Gazebo does not publish the file of its heightmap";
      }
      return heightmap(from.heightmap());
    case Geometry::EMPTY:
      return "it has no shape";
    default:
      break;
  }
  const std::string& name = Geometry::Type_Name(from.type());
  return name.empty() ? fmt::format("insonify does not know the shape {}", static_cast<int>(from.type()))
                      : fmt::format("insonify has no shape {}", name);
}

Pose pose_of(const ignition::msgs::Pose& from) {
  Pose pose;
  pose.position = vec3(from.position());
  const auto& turn = from.orientation();
  const Eigen::Quaterniond orientation(turn.w(), turn.x(), turn.y(), turn.z());
  if (orientation.norm() > 0) {
    pose.orientation = orientation.normalized();
  }
  return pose;
}

}  // namespace insonify
