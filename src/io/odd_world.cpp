// odd_world.cpp -- measures the world, and looks up and down from each sonar.

#include "io/odd_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "insonify/printable.h"

namespace insonify {
namespace {

// Names of meshes that are made, not read.
bool is_primitive(const Mesh& mesh) {
  static const std::set<std::string_view> kPrimitives = {"box",     "sphere", "ellipsoid", "cylinder",
                                                         "capsule", "cone",   "plane",     "torus"};
  return kPrimitives.contains(mesh.name);
}

// Where a vertical line through a point meets the surfaces: the nearest above and whether one is below.
struct Column {
  double above = INFINITY;  // Height over the point [m].
  bool faces_up = false;    // The front of the nearest one above.
  bool has_below = false;
  std::string name;  // Name of the instance above.
};

// By the formula of Moeller and Trumbore, in the mesh's frame, where `up` is the world's z.
void add_crossings(const Instance& instance, const Vec3& point, Column& column) {
  const Pose mesh_from_world = instance.world_from_mesh.inverse();
  const Vec3 start = mesh_from_world * point, up = mesh_from_world.orientation * Vec3::UnitZ();
  const Mesh& mesh = *instance.mesh;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.vertices[i].cast<double>();
    const Vec3 ab = mesh.vertices[j].cast<double>() - a, ac = mesh.vertices[k].cast<double>() - a;
    const Vec3 across = up.cross(ac), from_a = start - a;
    const double volume = ab.dot(across);  // Negative where the front faces up.
    const double u = from_a.dot(across) / volume;
    if (!(u >= 0 && u <= 1)) {
      continue;
    }
    const Vec3 other = from_a.cross(ab);
    const double v = up.dot(other) / volume, height = ac.dot(other) / volume;
    if (!(v >= 0 && u + v <= 1)) {
      continue;
    }
    column.has_below = column.has_below || height <= 0;
    if (height > 0 && height < column.above) {
      column.above = height;
      column.faces_up = volume < 0;
      column.name = instance.name;
    }
  }
}

Column column_through(const Scene& scene, const Vec3& point) {
  Column column;
  for (const Instance& instance : scene.instances) {
    add_crossings(instance, point, column);
  }
  return column;
}

}  // namespace

std::vector<std::string> odd_places(const Scenario& scenario, const Scene& scene) {
  std::vector<std::string> lines;
  constexpr double kPebble = 0.1;  // [m]
  const Box3 box = scene.bounds();
  const double size = (box.high - box.low).maxCoeff();
  if (size > 0 && size < kPebble &&
      std::ranges::none_of(scene.instances, [](const Instance& instance) { return is_primitive(*instance.mesh); })) {
    lines.push_back(
        fmt::format("{}: the whole world is {:.3g} m long; is its unit the metre?", scenario.world.string(), size));
  }
  if (scenario.pattern) {
    return lines;  // The bed is looked for when the vehicle flies.
  }
  const Pose world_from_vehicle = scenario.trajectory.at(0);
  for (const SonarConfig& sonar : scenario.sonars) {
    const Column column = column_through(scene, world_from_vehicle * sonar.position);
    if (column.faces_up && !column.has_below) {
      lines.push_back(fmt::format("sonar {} is {:.3g} m under {} and nothing is below it", printable(sonar.name),
                                  column.above, printable(column.name, kLongestName)));
    }
  }
  return lines;
}

}  // namespace insonify
