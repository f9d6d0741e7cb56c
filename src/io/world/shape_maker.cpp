// shape_maker.cpp -- makes meshes of primitives, and reads those of files and height grids.

#include "io/world/shape_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/mesh.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/grid/height_grid_file.h"
#include "io/mesh/mesh_file.h"
#include "io/world/sdf_fuel.h"
#include "io/world/sdf_uri.h"

namespace insonify {
namespace {

// Position of a node of the finer grid between two nodes of the coarser: index of the first, weight of the second.
struct Between {
  int first;
  float weight;
};
Between between(int fine, int sampling, int coarse_count) {
  const int first = std::min(fine / sampling, coarse_count - 2);
  return {first, static_cast<float>(fine - first * sampling) / static_cast<float>(sampling)};
}

// Interpolates; a node of weight 0 does not matter, even if it has no data (NaN).
float mix(float a, float b, float weight_of_b) {
  if (weight_of_b <= 0) {
    return a;
  }
  return weight_of_b >= 1 ? b : a + weight_of_b * (b - a);
}

// Height between the corners of a cell. If one has no data, the other three span a triangle, as in
// make_height_field(); beyond it there is none.
float height_within(std::array<std::array<float, 2>, 2> corners, float x, float y) {
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const float plane = corners[j][1 - i] + corners[1 - j][i] - corners[1 - j][1 - i];
      const float towards = (i == 0 ? 1 - x : x) + (j == 0 ? 1 - y : y);
      if (std::isnan(corners[j][i]) && !std::isnan(plane) && towards <= 1) {
        corners[j][i] = plane;
        return mix(mix(corners[0][0], corners[0][1], x), mix(corners[1][0], corners[1][1], x), y);
      }
    }
  }
  return mix(mix(corners[0][0], corners[0][1], x), mix(corners[1][0], corners[1][1], x), y);
}

HeightGrid resample(const HeightGrid& grid, int sampling) {
  HeightGrid fine = grid;
  fine.columns = (grid.columns - 1) * sampling + 1;
  fine.rows = (grid.rows - 1) * sampling + 1;
  fine.spacing_x = grid.spacing_x / sampling;
  fine.spacing_y = grid.spacing_y / sampling;
  fine.heights.clear();
  fine.heights.reserve(static_cast<std::size_t>(fine.columns) * fine.rows);
  for (int row = 0; row < fine.rows; ++row) {
    const Between y = between(row, sampling, grid.rows);
    const float* above = &grid.heights[static_cast<std::size_t>(y.first) * grid.columns];
    const float* below = above + grid.columns;
    for (int column = 0; column < fine.columns; ++column) {
      const auto [first, weight] = between(column, sampling, grid.columns);
      fine.heights.push_back(
          height_within({{{above[first], above[first + 1]}, {below[first], below[first + 1]}}}, weight, y.weight));
    }
  }
  return fine;
}

// Scales a grid to the size that an SDF file gives, as Gazebo does, and divides each of its steps into `sampling`.
//
// `size.z` is the height of the brightest pixel of a picture, whose black is height 0; of a survey grid it is the
// difference between highest and lowest, and heights keep their zero.
// @param size      Full lengths [m], > 0. Empty: the grid keeps its own size.
// @param sampling  Steps per pixel, >= 1; heights in between are interpolated bilinearly.
void fit_heightmap(HeightGrid& grid, const std::optional<Vec3>& size, bool picture, int sampling) {
  if (size) {
    grid.spacing_x = size->x() / (grid.columns - 1);
    grid.spacing_y = size->y() / (grid.rows - 1);
    float low = INFINITY, high = -INFINITY;
    for (const float height : grid.heights) {  // NaN compares false
      low = height < low ? height : low;
      high = height > high ? height : high;
    }
    const float span = picture ? high : high - low;
    const double scale = span > 0 ? size->z() / static_cast<double>(span) : 1;  // flat stays as it is
    for (float& height : grid.heights) {
      height = static_cast<float>(static_cast<double>(height) * scale);
    }
  }
  if (sampling > 1) {
    grid = resample(grid, sampling);
  }
}

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

// Throws if the triangles of an ellipsoid of such radii would fill the memory: their number grows with the ratio.
Vec3 not_too_flat(const Vec3& radii, const std::string& what) {
  if (radii.maxCoeff() > RoundShapes::kMostRatio * radii.minCoeff()) {
    throw Error(fmt::format("{}: <radii> = {} {} {} m: the largest must be at most {} times the smallest", what,
                            radii.x(), radii.y(), radii.z(), RoundShapes::kMostRatio));
  }
  return radii;
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

const ShapeMaker::Meshes& ShapeMaker::all_shared(const std::string& key,
                                                 const std::function<std::vector<Mesh>()>& make) {
  Meshes& meshes = meshes_[key];
  if (meshes.empty()) {
    for (Mesh& mesh : make()) {
      meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    }
  }
  return meshes;
}

PlacedMesh ShapeMaker::shared(const std::string& key, const std::function<Mesh()>& make) {
  return {all_shared(key, [&] { return std::vector<Mesh>{make()}; }).front()};
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

std::vector<PlacedMesh> ShapeMaker::mesh(const Shape& shape, const fs::path& base, const std::string& what,
                                         bool parts) {
  const std::string path = file_of(shape.uri, base, what);
  const Vec3& scale = shape.scale;
  if (!scale.allFinite() || (scale.array() == 0).any()) {
    throw Error(
        fmt::format("{}: <scale> = {} {} {} must not be 0 in any direction", what, scale.x(), scale.y(), scale.z()));
  }
  const auto read = [&] {
    return parts ? load_mesh_parts(path, log_)
                 : std::vector<Mesh>{load_mesh_file(path, {shape.submesh, shape.center_submesh}, log_)};
  };
  std::string key = fmt::format("{} '{}' '{}' {}", parts ? "parts" : "mesh", path, shape.submesh, shape.center_submesh);
  const Meshes* meshes = &all_shared(key, [&] { return read_for(what, read); });
  if (scale != Vec3::Ones()) {
    key += fmt::format(" {} {} {}", scale.x(), scale.y(), scale.z());
    meshes = &all_shared(key, [&, plain = meshes] {
      std::vector<Mesh> scaled;
      for (const auto& mesh : *plain) {
        scale_mesh(scaled.emplace_back(*mesh), scale);
      }
      return scaled;
    });
  }
  std::vector<PlacedMesh> placed;
  for (const auto& mesh : *meshes) {
    placed.push_back({.mesh = mesh, .part = parts ? mesh->name : ""});
  }
  return placed;
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
    return height_field_of(grid);
  };
  return {shared(key, [&] { return read_for(what, make); }).mesh, shape.position};
}

PlacedMesh ShapeMaker::round(const Shape& shape, const std::string& what) {
  const double angle = round_.edge_angle(shape);
  const double r = shape.kind == ShapeKind::kEllipsoid ? 0 : positive(shape.radius, what, "radius");
  const auto length = [&] { return positive(shape.length, what, "length"); };
  switch (shape.kind) {
    case ShapeKind::kSphere:
      return shared(fmt::format("sphere {}", r), [&] { return make_sphere(r, angle); });
    case ShapeKind::kEllipsoid: {
      const Vec3 radii = not_too_flat(positive(shape.size.value_or(Vec3::Zero()), what, "radii"), what);
      const std::string key = fmt::format("ellipsoid {} {} {}", radii.x(), radii.y(), radii.z());
      return shared(key, [&] { return make_ellipsoid(radii, angle); });
    }
    case ShapeKind::kCylinder:
      return shared(fmt::format("cylinder {} {}", r, length()), [&] { return make_cylinder(r, shape.length, angle); });
    case ShapeKind::kCapsule:
      return shared(fmt::format("capsule {} {}", r, length()), [&] { return make_capsule(r, shape.length, angle); });
    default:
      return shared(fmt::format("cone {} {}", r, length()), [&] { return make_cone(r, shape.length, angle); });
  }
}

void ShapeMaker::report_coarse(const std::string& name) {
  constexpr double kQuarterWavelength = 5e-4;  // Of 750 kHz [m].
  if (const double deviation = round_.deviation(); deviation > 0) {
    log_line(log_, deviation > kQuarterWavelength ? Severity::kWarning : Severity::kInfo,
             fmt::format("{}: {} sizes of spheres, cylinders and the like would take too much memory: their facets are "
                         "coarser, up to {:.2g} mm off their surfaces",
                         name, round_.size(), 1e3 * deviation));
  }
}

PlacedMesh ShapeMaker::make(const Shape& shape, const fs::path& base, const std::string& what) {
  switch (shape.kind) {
    case ShapeKind::kBox: {
      const Vec3 sides = positive(shape.size.value_or(Vec3::Zero()), what, "size");
      return shared(fmt::format("box {} {} {}", sides.x(), sides.y(), sides.z()), [&] { return make_box(sides); });
    }
    case ShapeKind::kPlane:
      return plane(shape, what);
    case ShapeKind::kMesh:
      return mesh(shape, base, what, false).front();
    case ShapeKind::kHeightmap:
      return heightmap(shape, base, what);
    default:
      return round(shape, what);
  }
}

std::vector<PlacedMesh> ShapeMaker::make_parts(const Shape& shape, const fs::path& base, const std::string& what) {
  return mesh(shape, base, what, true);
}

}  // namespace insonify
