// shape_maker.cpp -- makes meshes of primitives and reads those of files.

#include "io/world/shape_maker.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "insonify/files.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/mesh/mesh_file.h"
#include "io/world/sdf_fuel.h"
#include "io/world/sdf_heightmap.h"
#include "io/world/sdf_uri.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

constexpr int kMostSampling = 16;

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
    throw UnreadablePart(what, fmt::format(": {}", error.what()));
  }
}

std::string file_of(const std::string& uri, const fs::path& base, const std::string& what) {
  const std::optional<fs::path> found =
      find_sdf_uri(uri, base, [](const fs::path& path) { return !fs::is_directory(path); });
  if (!found) {
    throw UnreadablePart(fmt::format("{}: '{}'", what, printable(uri, is_fuel_uri(uri) ? kLongestName : kLongestQuote)),
                         " " + sdf_uri_not_found(uri, base), is_fuel_uri(uri) ? fuel_model_uri(uri) : "");
  }
  return found->string();
}

}  // namespace

PlacedMesh ShapeMaker::shared(const std::string& key, const std::function<Mesh()>& make) {
  std::shared_ptr<const Mesh>& mesh = meshes_[key];
  if (mesh == nullptr) {
    mesh = std::make_shared<const Mesh>(make());
  }
  return {mesh};
}

PlacedMesh ShapeMaker::plane(const Shape& shape, const std::string& what) {
  const Vec3& normal = shape.normal;
  if (!normal.allFinite() || std::abs(normal.norm() - 1) > 1e-6) {
    throw Error(fmt::format("{}: <normal> = {} {} {} is not a direction", what, normal.x(), normal.y(), normal.z()));
  }
  const double x = shape.size ? positive(shape.size->x(), what, "size") : kInfinitePlane;
  const double y = shape.size ? positive(shape.size->y(), what, "size") : kInfinitePlane;
  const std::string key = fmt::format("plane {} {} {} {} {}", normal.x(), normal.y(), normal.z(), x, y);
  return shared(key, [&] { return make_plane(normal, x, y); });
}

PlacedMesh ShapeMaker::mesh(const Shape& shape, const fs::path& base, const std::string& what) {
  const std::string path = file_of(shape.uri, base, what);
  const Vec3& scale = shape.scale;
  if (!scale.allFinite() || (scale.array() == 0).any()) {
    throw Error(
        fmt::format("{}: <scale> = {} {} {} must not be 0 in any direction", what, scale.x(), scale.y(), scale.z()));
  }
  const std::string key = fmt::format("mesh '{}' '{}' {}", path, shape.submesh, shape.center_submesh);
  const PlacedMesh plain = shared(key, [&] {
    return read_for(what, [&] { return load_mesh_file(path, {shape.submesh, shape.center_submesh}, log_); });
  });
  if (scale == Vec3::Ones()) {
    return plain;
  }
  return shared(fmt::format("{} {} {} {}", key, scale.x(), scale.y(), scale.z()), [&] {
    Mesh scaled = *plain.mesh;
    scale_mesh(scaled, scale);
    return scaled;
  });
}

// Without a size a picture has SDF's default, 1 x 1 x 1 m, a survey its own.
PlacedMesh ShapeMaker::heightmap(const Shape& shape, const fs::path& base, const std::string& what) {
  const std::string path = file_of(shape.uri, base, what);
  const bool picture = ending_of(path) == ".png";  // Levels, not metres.
  std::optional<Vec3> size = shape.size;
  if (size || picture) {
    size = positive(size.value_or(Vec3::Ones()), what, "size");
  }
  if (shape.sampling < 1 || shape.sampling > kMostSampling) {
    throw Error(fmt::format("{}: <sampling> = {} must be from 1 to {}", what, shape.sampling, kMostSampling));
  }
  const Vec3 stretch = size.value_or(Vec3::Zero());
  const std::string key =
      fmt::format("heightmap {} {} {} {} '{}'", stretch.x(), stretch.y(), stretch.z(), shape.sampling, path);
  const auto make = [&] {
    HeightGrid grid = load_height_grid(path, log_);
    fit_heightmap(grid, size, picture, shape.sampling);
    return make_height_field(grid);
  };
  return {shared(key, [&] { return read_for(what, make); }).mesh, shape.position};
}

PlacedMesh ShapeMaker::make(const Shape& shape, const fs::path& base, const std::string& what) {
  const auto radius = [&] { return positive(shape.radius, what, "radius"); };
  const auto length = [&] { return positive(shape.length, what, "length"); };
  const auto size = [&](const char* element) { return positive(shape.size.value_or(Vec3::Zero()), what, element); };
  switch (shape.kind) {
    case ShapeKind::kBox: {
      const Vec3 sides = size("size");
      return shared(fmt::format("box {} {} {}", sides.x(), sides.y(), sides.z()), [&] { return make_box(sides); });
    }
    case ShapeKind::kSphere: {
      const double r = radius();
      return shared(fmt::format("sphere {}", r), [&] { return make_sphere(r); });
    }
    case ShapeKind::kEllipsoid: {
      const Vec3 radii = size("radii");
      const std::string key = fmt::format("ellipsoid {} {} {}", radii.x(), radii.y(), radii.z());
      return shared(key, [&] { return make_ellipsoid(radii); });
    }
    case ShapeKind::kCylinder: {
      const double r = radius(), l = length();
      return shared(fmt::format("cylinder {} {}", r, l), [&] { return make_cylinder(r, l); });
    }
    case ShapeKind::kCapsule: {
      const double r = radius(), l = length();
      return shared(fmt::format("capsule {} {}", r, l), [&] { return make_capsule(r, l); });
    }
    case ShapeKind::kCone: {
      const double r = radius(), l = length();
      return shared(fmt::format("cone {} {}", r, l), [&] { return make_cone(r, l); });
    }
    case ShapeKind::kPlane:
      return plane(shape, what);
    case ShapeKind::kMesh:
      return mesh(shape, base, what);
    case ShapeKind::kHeightmap:
      break;
  }
  return heightmap(shape, base, what);
}

}  // namespace insonify
