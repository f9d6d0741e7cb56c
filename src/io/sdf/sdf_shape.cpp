// sdf_shape.cpp -- reads the shapes of SDF geometries.

#include "io/sdf/sdf_shape.h"

#include <algorithm>
#include <limits>
#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Heightmap.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>
#include <sstream>

#include "io/file/xml_file.h"

namespace insonify {
namespace {

Vec3 vec3(const ignition::math::Vector3d& v) {
  return {v.X(), v.Y(), v.Z()};
}

// Reads a number from an element that libsdformat has no type for; check_sdf_element() has seen that it is one.
double number(const sdf::ElementPtr& parent, const char* element, double otherwise) {
  if (!parent->HasElement(element)) {
    return otherwise;
  }
  std::istringstream stream(without_outer_space(parent->GetElement(element)->GetValue()->GetAsString()));
  stream.imbue(std::locale::classic());
  double read = otherwise;
  stream >> read;
  return read;
}

Shape plane(const sdf::Plane& plane, bool collision) {
  Shape shape{.kind = ShapeKind::kPlane, .normal = vec3(plane.Normal())};
  if (!collision && plane.Element()->GetElement("size")->GetExplicitlySetInFile()) {
    shape.size = Vec3(plane.Size().X(), plane.Size().Y(), 1);
  }
  return shape;
}

// libsdformat does not say whether a size is its default.
Shape heightmap(const sdf::Heightmap& heightmap) {
  constexpr unsigned kMost = std::numeric_limits<int>::max();
  Shape shape{.kind = ShapeKind::kHeightmap, .uri = heightmap.Uri(), .position = vec3(heightmap.Position())};
  shape.sampling = static_cast<int>(std::min(heightmap.Sampling(), kMost));
  if (heightmap.Element()->HasElement("size")) {
    shape.size = vec3(heightmap.Size());
  }
  return shape;
}

// Shapes that libsdformat supports; absent for others.
std::optional<Shape> known_shape(const sdf::Geometry& geometry, bool collision) {
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX:
      return Shape{.kind = ShapeKind::kBox, .size = vec3(geometry.BoxShape()->Size())};
    case sdf::GeometryType::SPHERE:
      return Shape{.kind = ShapeKind::kSphere, .radius = geometry.SphereShape()->Radius()};
    case sdf::GeometryType::ELLIPSOID:
      return Shape{.kind = ShapeKind::kEllipsoid, .size = vec3(geometry.EllipsoidShape()->Radii())};
    case sdf::GeometryType::CYLINDER:
      return Shape{.kind = ShapeKind::kCylinder,
                   .radius = geometry.CylinderShape()->Radius(),
                   .length = geometry.CylinderShape()->Length()};
    case sdf::GeometryType::CAPSULE:
      return Shape{.kind = ShapeKind::kCapsule,
                   .radius = geometry.CapsuleShape()->Radius(),
                   .length = geometry.CapsuleShape()->Length()};
    case sdf::GeometryType::PLANE:
      return plane(*geometry.PlaneShape(), collision);
    case sdf::GeometryType::MESH: {
      const sdf::Mesh& mesh = *geometry.MeshShape();
      return Shape{.kind = ShapeKind::kMesh,
                   .uri = mesh.Uri(),
                   .submesh = mesh.Submesh(),
                   .center_submesh = mesh.CenterSubmesh(),
                   .scale = vec3(mesh.Scale())};
    }
    case sdf::GeometryType::HEIGHTMAP:
      return heightmap(*geometry.HeightmapShape());
    case sdf::GeometryType::EMPTY:
      break;
  }
  return std::nullopt;
}

// Shapes that libsdformat 12 does not know. SDF 1.12 added the cone.
std::optional<Shape> unknown_shape(const sdf::ElementPtr& element) {
  if (!element || element->GetName() != "cone") {
    return std::nullopt;
  }
  return Shape{
      .kind = ShapeKind::kCone, .radius = number(element, "radius", 0.5), .length = number(element, "length", 1)};
}

sdf::ElementPtr element_of(const sdf::Geometry& geometry) {
  return geometry.Element() ? geometry.Element()->GetFirstElement() : nullptr;
}

}  // namespace

std::string sdf_shape_file(const sdf::Geometry& geometry) {
  switch (geometry.Type()) {
    case sdf::GeometryType::MESH:
      return geometry.MeshShape()->FilePath();
    case sdf::GeometryType::HEIGHTMAP:
      return geometry.HeightmapShape()->FilePath();
    default:
      return "";
  }
}

std::string sdf_shape_name(const sdf::Geometry& geometry) {
  const sdf::ElementPtr element = element_of(geometry);
  return element == nullptr || element->GetName() == "empty" ? "" : element->GetName();
}

std::optional<Shape> sdf_shape(const sdf::Geometry& geometry, bool collision) {
  const std::optional<Shape> known = known_shape(geometry, collision);
  return known ? known : unknown_shape(element_of(geometry));
}

}  // namespace insonify
