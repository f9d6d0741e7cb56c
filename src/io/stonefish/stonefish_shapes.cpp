// stonefish_shapes.cpp -- solids, planes, terrains and mesh files.

#include "io/stonefish/stonefish_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/log_line.h"
#include "insonify/files.h"
#include "insonify/material.h"
#include "insonify/printable.h"
#include "io/grid/height_grid_file.h"
#include "io/mesh/mesh_file.h"
#include "io/stonefish/stonefish_files.h"

namespace insonify {
namespace {

// A torus, which only Stonefish has: centred on the origin, its axis along y.
// @param major  Radius of the circle in the middle of the tube [m], > 0.
// @param minor  Radius of the tube [m], > 0.
Mesh make_torus(double major, double minor) {
  constexpr double kMaxEdgeAngle = 0.05;  // Between neighbouring normals [rad].
  const auto steps = static_cast<std::uint32_t>(std::ceil(2 * std::numbers::pi / kMaxEdgeAngle));
  Mesh mesh;
  mesh.name = "torus";
  for (std::uint32_t ring = 0; ring < steps; ++ring) {
    const double around = 2 * std::numbers::pi * ring / steps;
    const Vec3 outwards(std::cos(around), 0, std::sin(around));
    for (std::uint32_t i = 0; i < steps; ++i) {
      const double angle = 2 * std::numbers::pi * i / steps;
      const Vec3 normal = std::cos(angle) * outwards + std::sin(angle) * Vec3::UnitY();
      mesh.vertices.emplace_back((major * outwards + minor * normal).cast<float>());
      mesh.normals.emplace_back(normal.cast<float>());
    }
  }
  for (std::uint32_t ring = 0; ring < steps; ++ring) {
    for (std::uint32_t i = 0; i < steps; ++i) {
      const std::uint32_t here = ring * steps, next = (ring + 1) % steps * steps, j = (i + 1) % steps;
      mesh.triangles.push_back({here + i, here + j, next + i});
      mesh.triangles.push_back({here + j, next + j, next + i});
    }
  }
  return mesh;
}

constexpr double kPlaneSide = 10000;  // [m], that of the square which Stonefish draws.

// The name for finding a material: that of the material, or of the look if only that is in the library.
std::string material_name(const StonefishElement& body) {
  const std::string material = body.child("material").name(), look = body.child("look").name();
  const bool by_look = find_material(material) == nullptr && find_material(look) != nullptr;
  return by_look || material.empty() ? look : material;
}

// The file that a child of an element names.
std::string found_file(const StonefishElement& body, const StonefishElement& element, const char* child) {
  const std::string name = stonefish_text(element, child, "filename");
  const auto path = find_stonefish_file(name, element.path);
  if (!path) {
    throw UnreadablePart(fmt::format("{}: '{}'", body.what(), printable(name, kLongestName)),
                         stonefish_file_not_found(name, element.path));
  }
  return path->string();
}

// Calls a function that reads a file; turns its errors into those of a skipped part.
template <typename Read>
auto read_for(const StonefishElement& element, Read&& read) {
  try {
    return read();
  } catch (const Error& error) {
    throw UnreadablePart(element.what(), fmt::format(": {}", error.what()));
  }
}

// Stonefish's terrain: columns along x, rows along y, the darkest pixel at the body's origin, and `height` between
// black and white.
Mesh terrain_mesh(const std::string& path, double scale_x, double scale_y, double height, const Log& log) {
  HeightGrid grid = load_height_grid(path, log);
  grid.spacing_x = scale_x;
  grid.spacing_y = scale_y;
  float low = std::numeric_limits<float>::infinity();
  for (const float level : grid.heights) {  // NaN compares false.
    low = level < low ? level : low;
  }
  for (float& level : grid.heights) {
    level = static_cast<float>(static_cast<double>(level - low) * height);
  }
  return height_field_of(grid);
}

}  // namespace

const StonefishShapes::Meshes& StonefishShapes::all_shared(const std::string& key, const StonefishElement& body,
                                                           const std::function<std::vector<Mesh>()>& make) {
  const std::string material = material_name(body);
  Meshes& meshes = meshes_[key + " of " + material];
  if (meshes.empty()) {
    for (Mesh& made : make()) {
      made.material_slots.clear();  // Stonefish does not read the materials of mesh files.
      made.material_names = {material};
      made.reliefs.clear();
      meshes.push_back(std::make_shared<const Mesh>(std::move(made)));
    }
  }
  return meshes;
}

std::shared_ptr<const Mesh> StonefishShapes::shared(const std::string& key, const StonefishElement& body,
                                                    const std::function<Mesh()>& make) {
  return all_shared(key, body, [&] { return std::vector<Mesh>{make()}; }).front();
}

std::vector<StonefishShape> StonefishShapes::model(const StonefishElement& body, bool physical) {
  const StonefishElement visual = body.child("visual"), solid = body.child("physical");
  const StonefishElement given = visual && !(physical && solid) ? visual : solid;
  if (!given) {
    throw Error(body.what() + ": <physical> is missing");
  }
  const std::string path = found_file(body, given, "mesh");
  const double scale = stonefish_number_or(given, "mesh", "scale", 1);
  if (!(scale > 0)) {
    throw Error(fmt::format("{}: <mesh> scale = {} must be greater than 0", body.what(), scale));
  }
  const auto make = [&] {
    std::vector<Mesh> meshes = read_for(
        body, [&] { return parts_ ? load_mesh_parts(path, log_) : std::vector<Mesh>{load_mesh_file(path, {}, log_)}; });
    for (Mesh& mesh : meshes) {
      for (Vec3f& vertex : mesh.vertices) {
        vertex *= static_cast<float>(scale);
      }
    }
    return meshes;
  };
  std::vector<StonefishShape> shapes;
  for (const auto& mesh : all_shared(fmt::format("model {} {}", scale, path), body, make)) {
    shapes.push_back({mesh, stonefish_pose(given, "origin"), parts_ ? mesh->name : ""});
  }
  return shapes;
}

// Where the mesh of <visual> cannot be read, that of <physical>.
std::vector<StonefishShape> StonefishShapes::any_model(const StonefishElement& body, bool physical) {
  try {
    return model(body, physical);
  } catch (const UnreadablePart& unreadable) {
    if (physical || !body.child("visual") || !body.child("physical")) {
      throw;
    }
    std::vector<StonefishShape> shapes = model(body, true);
    log_line(log_, Severity::kWarning, fmt::format("{}: the mesh of <physical> is taken", unreadable.what()));
    return shapes;
  }
}

StonefishShape StonefishShapes::terrain(const StonefishElement& body) {
  const std::string path = found_file(body, body, "height_map");
  const double x = stonefish_length(body, "dimensions", "scalex");
  const double y = stonefish_length(body, "dimensions", "scaley");
  const double height = stonefish_length(body, "dimensions", "height");
  const auto make = [&] { return read_for(body, [&] { return terrain_mesh(path, x, y, height, log_); }); };
  // A height grid has z up.
  return {shared(fmt::format("terrain {} {} {} {}", x, y, height, path), body, make), up_from_down()};
}

// Nothing for a type without a shape.
std::optional<StonefishShape> StonefishShapes::solid(const StonefishElement& body) {
  const std::string type = stonefish_text(body, "", "type");
  if (type == "empty") {
    return std::nullopt;
  }
  if (type == "terrain") {
    return terrain(body);
  }
  if (type == "plane") {
    return StonefishShape{shared("plane", body, [] { return make_plane(-Vec3::UnitZ(), kPlaneSide, kPlaneSide); })};
  }
  const Pose origin = body.child("origin") ? stonefish_pose(body, "origin") : Pose{};
  const auto length = [&](const char* name) { return stonefish_length(body, "dimensions", name); };
  if (type == "box") {
    const Vec3 size = stonefish_vector(body, "dimensions", "xyz");
    if (!(size.array() > 0).all()) {
      throw Error(fmt::format("{}: <dimensions> xyz = {} {} {} m must be greater than 0 m in each direction",
                              body.what(), size.x(), size.y(), size.z()));
    }
    const std::string key = fmt::format("box {} {} {}", size.x(), size.y(), size.z());
    return StonefishShape{shared(key, body, [&] { return make_box(size); }), origin};
  }
  if (type == "sphere") {
    const double radius = length("radius");
    return StonefishShape{shared(fmt::format("sphere {}", radius), body, [&] { return make_sphere(radius); }), origin};
  }
  if (type == "cylinder") {
    const double radius = length("radius"), height = length("height");
    return StonefishShape{
        shared(fmt::format("cylinder {} {}", radius, height), body, [&] { return make_cylinder(radius, height); }),
        origin};
  }
  if (type == "torus") {
    const double major = length("major_radius"), minor = length("minor_radius");
    return StonefishShape{
        shared(fmt::format("torus {} {}", major, minor), body, [&] { return make_torus(major, minor); }), origin};
  }
  log_line(log_, Severity::kWarning,
           fmt::format("{} is skipped: insonify has no shape of type '{}'", body.what(), printable(type)));
  return std::nullopt;
}

std::vector<StonefishShape> StonefishShapes::shapes(const StonefishElement& body, bool physical) {
  if (stonefish_text(body, "", "type") == "model") {
    return any_model(body, physical);
  }
  const std::optional<StonefishShape> shape = solid(body);
  return shape ? std::vector{*shape} : std::vector<StonefishShape>();
}

}  // namespace insonify
