// sdf_shape.cpp -- makes meshes from SDF geometries.

#include "io/world/sdf_shape.h"

#include <fmt/format.h>

#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Heightmap.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>
#include <sstream>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/file/xml_file.h"
#include "io/mesh/mesh_file.h"
#include "io/world/sdf_fuel.h"
#include "io/world/sdf_heightmap.h"
#include "io/world/sdf_uri.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kMostSampling = 16;

Vec3 vec3(const ignition::math::Vector3d& v) {
  return {v.X(), v.Y(), v.Z()};
}

// Throws unless a length, or each of three, is positive and finite.
double positive(double value, const std::string& what, const char* element) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw Error(fmt::format("{}: <{}> = {} m must be greater than 0 m", what, element, value));
  }
  return value;
}
Vec3 positive(const Vec3& value, const std::string& what, const char* element) {
  if (!(value.array() > 0).all() || !value.allFinite()) {
    throw Error(fmt::format("{}: <{}> = {} {} {} m must be greater than 0 m in each direction", what, element,
                            value.x(), value.y(), value.z()));
  }
  return value;
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

// Scales a mesh; negative factors mirror it, and an odd number of them reverses the winding.
void scale_mesh(Mesh& mesh, const Vec3& scale) {
  const Vec3f factor = scale.cast<float>();
  for (Vec3f& vertex : mesh.vertices) {
    vertex = vertex.cwiseProduct(factor);
  }
  for (Vec3f& normal : mesh.normals) {
    normal = normal.cwiseQuotient(factor).normalized();
  }
  if (scale.prod() < 0) {
    for (auto& triangle : mesh.triangles) {
      std::swap(triangle[1], triangle[2]);
    }
    for (auto& corners : mesh.texture_coordinates) {
      std::swap(corners[1], corners[2]);
    }
  }
}

// Calls a function that reads a file, and puts `what` before the message of its Error.
template <typename Read>
auto read_for(const std::string& what, Read&& read) {
  try {
    return read();
  } catch (const Error& error) {
    throw SdfUnreadable(what, fmt::format(": {}", error.what()));
  }
}

}  // namespace

std::shared_ptr<const Mesh> SdfShapes::shared(const std::string& key, const std::function<Mesh()>& make) {
  std::shared_ptr<const Mesh>& mesh = meshes_[key];
  if (mesh == nullptr) {
    mesh = std::make_shared<const Mesh>(make());
  }
  return mesh;
}

std::string SdfShapes::file(const std::string& uri, const std::string& base, const std::string& what) const {
  const std::optional<fs::path> found =
      find_sdf_uri(uri, source_.original(base), [](const fs::path& path) { return !fs::is_directory(path); });
  if (!found) {
    throw SdfUnreadable(fmt::format("{}: '{}'", what, printable(uri, is_fuel_uri(uri) ? kLongestName : kLongestQuote)),
                        " " + sdf_uri_not_found(uri), is_fuel_uri(uri) ? fuel_model_uri(uri) : "");
  }
  return found->string();
}

SdfShape SdfShapes::plane(const sdf::Plane& plane, const std::string& what, bool collision) {
  const Vec3 normal = vec3(plane.Normal());
  if (!normal.allFinite() || std::abs(normal.norm() - 1) > 1e-6) {
    throw Error(fmt::format("{}: <normal> = {} {} {} is not a direction", what, normal.x(), normal.y(), normal.z()));
  }
  const bool has_size = plane.Element()->GetElement("size")->GetExplicitlySetInFile();
  const bool infinite = collision || !has_size;
  const double x = infinite ? kInfinitePlane : positive(plane.Size().X(), what, "size");
  const double y = infinite ? kInfinitePlane : positive(plane.Size().Y(), what, "size");
  const std::string key = fmt::format("plane {} {} {} {} {}", normal.x(), normal.y(), normal.z(), x, y);
  return {shared(key, [&] { return make_plane(normal, x, y); })};
}

SdfShape SdfShapes::mesh(const sdf::Mesh& mesh, const std::string& what) {
  const std::string path = file(mesh.Uri(), mesh.FilePath(), what);
  const Vec3 scale = vec3(mesh.Scale());
  if (!scale.allFinite() || (scale.array() == 0).any()) {
    throw Error(
        fmt::format("{}: <scale> = {} {} {} must not be 0 in any direction", what, scale.x(), scale.y(), scale.z()));
  }
  const std::string key = fmt::format("mesh '{}' '{}' {}", path, mesh.Submesh(), mesh.CenterSubmesh());
  const std::shared_ptr<const Mesh> plain = shared(key, [&] {
    return read_for(what, [&] { return load_mesh_file(path, {mesh.Submesh(), mesh.CenterSubmesh()}, log_); });
  });
  if (scale == Vec3::Ones()) {
    return {plain};
  }
  return {shared(fmt::format("{} {} {} {}", key, scale.x(), scale.y(), scale.z()), [&] {
    Mesh scaled = *plain;
    scale_mesh(scaled, scale);
    return scaled;
  })};
}

SdfShape SdfShapes::heightmap(const sdf::Heightmap& heightmap, const std::string& what) {
  const std::string path = file(heightmap.Uri(), heightmap.FilePath(), what);
  const bool picture = ending_of(path) == ".png";  // Levels, not metres.
  // Default if <size> is missing: SDF's 1 x 1 x 1 m for a picture, the grid's own size for a survey.
  const bool has_size = picture || heightmap.Element()->HasElement("size");
  const std::optional<Vec3> size =
      has_size ? std::optional(positive(vec3(heightmap.Size()), what, "size")) : std::nullopt;
  const unsigned sampling = heightmap.Sampling();
  if (sampling < 1 || sampling > kMostSampling) {
    throw Error(fmt::format("{}: <sampling> = {} must be from 1 to {}", what, sampling, kMostSampling));
  }
  const Vec3 stretch = size.value_or(Vec3::Zero());
  const std::string key =
      fmt::format("heightmap {} {} {} {} '{}'", stretch.x(), stretch.y(), stretch.z(), sampling, path);
  const auto make = [&] {
    HeightGrid grid = load_height_grid(path, log_);
    fit_heightmap(grid, size, picture, static_cast<int>(sampling));
    return make_height_field(grid);
  };
  return {shared(key, [&] { return read_for(what, make); }), vec3(heightmap.Position())};
}

// Shapes that libsdformat 12 does not know. SDF 1.12 added the cone.
std::optional<SdfShape> SdfShapes::unknown_shape(const sdf::Geometry& geometry, const std::string& what) {
  const sdf::ElementPtr element = geometry.Element() ? geometry.Element()->GetFirstElement() : nullptr;
  if (element && element->GetName() == "cone") {
    const double radius = positive(number(element, "radius", 0.5), what, "radius");
    const double length = positive(number(element, "length", 1), what, "length");
    return SdfShape{shared(fmt::format("cone {} {}", radius, length), [&] { return make_cone(radius, length); })};
  }
  const bool is_empty = element == nullptr || element->GetName() == "empty";
  log_line(
      log_, Severity::kWarning,
      what + " is left out: " +
          (is_empty ? "it has no shape" : fmt::format("insonify has no shape <{}>", printable(element->GetName()))));
  return std::nullopt;
}

std::optional<SdfShape> SdfShapes::shape(const sdf::Geometry& geometry, const std::string& what, bool collision) {
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX: {
      const Vec3 size = positive(vec3(geometry.BoxShape()->Size()), what, "size");
      return SdfShape{
          shared(fmt::format("box {} {} {}", size.x(), size.y(), size.z()), [&] { return make_box(size); })};
    }
    case sdf::GeometryType::SPHERE: {
      const double radius = positive(geometry.SphereShape()->Radius(), what, "radius");
      return SdfShape{shared(fmt::format("sphere {}", radius), [&] { return make_sphere(radius); })};
    }
    case sdf::GeometryType::ELLIPSOID: {
      const Vec3 radii = positive(vec3(geometry.EllipsoidShape()->Radii()), what, "radii");
      const std::string key = fmt::format("ellipsoid {} {} {}", radii.x(), radii.y(), radii.z());
      return SdfShape{shared(key, [&] { return make_ellipsoid(radii); })};
    }
    case sdf::GeometryType::CYLINDER: {
      const double radius = positive(geometry.CylinderShape()->Radius(), what, "radius");
      const double length = positive(geometry.CylinderShape()->Length(), what, "length");
      return SdfShape{
          shared(fmt::format("cylinder {} {}", radius, length), [&] { return make_cylinder(radius, length); })};
    }
    case sdf::GeometryType::CAPSULE: {
      const double radius = positive(geometry.CapsuleShape()->Radius(), what, "radius");
      const double length = positive(geometry.CapsuleShape()->Length(), what, "length");
      return SdfShape{
          shared(fmt::format("capsule {} {}", radius, length), [&] { return make_capsule(radius, length); })};
    }
    case sdf::GeometryType::PLANE:
      return plane(*geometry.PlaneShape(), what, collision);
    case sdf::GeometryType::MESH:
      return mesh(*geometry.MeshShape(), what);
    case sdf::GeometryType::HEIGHTMAP:
      return heightmap(*geometry.HeightmapShape(), what);
    case sdf::GeometryType::EMPTY:
      break;
  }
  return unknown_shape(geometry, what);
}

}  // namespace insonify
