// bench_scene.cpp -- makes the scenes and sonars of the benchmarks.

#include "benchmark/bench_scene.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace insonify {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kBedHeight = -3;
constexpr int kObjects = 24;

using Surface = std::function<Vec3f(float u, float v)>;

// Adds a grid of 2 x columns x rows triangles over the unit square.
void add_grid(Mesh& mesh, int columns, int rows, const Surface& surface) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      mesh.vertices.push_back(surface(static_cast<float>(i) / static_cast<float>(columns),
                                      static_cast<float>(j) / static_cast<float>(rows)));
    }
  }
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = first + static_cast<std::uint32_t>(j) * stride + static_cast<std::uint32_t>(i);
      mesh.triangles.push_back({a, a + 1, a + stride + 1});
      mesh.triangles.push_back({a, a + stride + 1, a + stride});
    }
  }
}

void add_instance(Scene& scene, const char* name, Mesh mesh, const char* material) {
  static_cast<void>(clean_mesh(mesh));
  Instance instance;
  instance.name = name;
  instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
  instance.user_material = material;
  scene.instances.push_back(std::move(instance));
}

// Objects are the same on every machine.
class Dice {
 public:
  float roll() {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<float>(state_ >> 8) * (1.0F / 16777216.0F);
  }

 private:
  std::uint32_t state_ = 12345;
};

Mesh make_object(int kind, int triangles, const Vec3f& centre, float size, float turn) {
  Mesh mesh;
  const int around = std::max(3, static_cast<int>(std::sqrt(static_cast<float>(triangles))));
  const int along = std::max(2, triangles / (2 * around));
  const auto ring = [&](float u, float radius, float height) {
    return Vec3f(centre + Vec3f(std::cos(2 * kPi * u) * radius, std::sin(2 * kPi * u) * radius, height));
  };
  switch (kind) {
    case 0:  // Sphere.
      add_grid(mesh, around, along,
               [&](float u, float v) { return ring(u, size * std::sin(kPi * v), size * std::cos(kPi * v)); });
      break;
    case 1: {  // Box, turned.
      const int side = std::max(1, static_cast<int>(std::sqrt(static_cast<float>(triangles) / 12)));
      const Eigen::AngleAxisf rotation(turn, Vec3f::UnitZ());
      for (int face = 0; face < 6; ++face) {
        add_grid(mesh, side, side, [&](float u, float v) {
          Vec3f point;
          point[face / 2] = face % 2 == 0 ? -size : size;
          point[(face / 2 + 1) % 3] = (2 * u - 1) * size;
          point[(face / 2 + 2) % 3] = (2 * v - 1) * size;
          return Vec3f(centre + rotation * point);
        });
      }
      break;
    }
    case 2:  // Cylinder.
      add_grid(mesh, around, along, [&](float u, float v) { return ring(u, 0.5F * size, (2 * v - 1) * 1.5F * size); });
      break;
    default:  // Cone.
      add_grid(mesh, around, along,
               [&](float u, float v) { return ring(u, size * (1 - v) + 1e-3F, (2 * v - 1) * size); });
  }
  return mesh;
}

constexpr double kEdgeAngle = 0.15;  // About 40 segments per circle, as in OpenSceneGraph, which the authors use.
constexpr double kCube = 20;

void add(Scene& scene, const char* name, Mesh mesh, const Vec3& position) {
  Instance instance;
  instance.name = name;
  instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
  instance.world_from_mesh.position = position;
  instance.user_material = "steel";
  scene.instances.push_back(std::move(instance));
}

void add_shapes(Scene& scene, const std::array<Vec3, 4>& places) {
  add(scene, "cylinder", make_cylinder(0.8, 1, kEdgeAngle), places[0]);
  add(scene, "box", make_box({1.6, 1.6, 1.6}), places[1]);
  add(scene, "sphere", make_sphere(0.8, kEdgeAngle), places[2]);
  add(scene, "cone", make_cone(0.8, 1, kEdgeAngle), places[3]);
}

constexpr std::array<PaperSetup, 12> kSetups = {{
    {128, 500, 120, 20, 49.0, 86.1},
    {128, 1000, 120, 20, 95.4, 132.3},
    {256, 500, 120, 20, 59.3, 101.7},
    {256, 1000, 120, 20, 117.2, 155.8},
    {128, 500, 90, 15, 56.4, 97.4},
    {128, 1000, 90, 15, 118.6, 144.4},
    {256, 500, 90, 15, 66.7, 111.7},
    {256, 1000, 90, 15, 137.5, 169.3},
    {1, 500, 3, 35, 28.4, 62.8},
    {1, 1000, 3, 35, 34.8, 70.0},
    {1, 500, 2, 20, 30.7, 69.1},
    {1, 1000, 2, 20, 37.7, 77.2},
}};

}  // namespace

Scene make_bench_scene(int triangle_count) {
  Scene scene;
  const auto share = [&](double part) { return std::sqrt(part * triangle_count / 2); };

  Mesh bed;
  const int bed_side = std::max(4, static_cast<int>(share(0.4)));
  add_grid(bed, bed_side, bed_side, [](float u, float v) {
    const float x = -10 + 50 * u;
    const float y = -30 + 60 * v;
    return Vec3f(x, y, kBedHeight + 0.15F * std::sin(1.7F * x) * std::cos(1.3F * y) + 0.04F * std::sin(7 * x + 3 * y));
  });
  Mesh wall;
  const int wall_side = std::max(2, static_cast<int>(share(0.1)));
  add_grid(wall, wall_side, wall_side, [](float u, float v) {
    return Vec3f(18 + 0.02F * std::sin(40 * u), -30 + 60 * u, kBedHeight - 0.5F + 6 * v);
  });
  const int left = triangle_count - static_cast<int>(bed.triangles.size() + wall.triangles.size());
  add_instance(scene, "bed", std::move(bed), "mud");
  add_instance(scene, "wall", std::move(wall), "concrete");

  Dice dice;
  constexpr const char* kMaterials[] = {"steel", "steel", "aluminium", "concrete"};
  for (int object = 0; object < kObjects; ++object) {
    const float azimuth = (-55 + 110 * dice.roll()) * kPi / 180;
    const float range = 4 + 12 * dice.roll();
    const float height = kBedHeight + 0.4F + 1.6F * dice.roll();
    const float size = 0.25F + 0.6F * dice.roll();
    const Vec3f centre(range * std::cos(azimuth), range * std::sin(azimuth), height);
    add_instance(scene, "object", make_object(object % 4, left / kObjects, centre, size, 7 * azimuth),
                 kMaterials[object % 4]);
  }
  assign_materials(scene, {});
  return scene;
}

SonarConfig bench_sonar() {
  SonarConfig sonar;
  sonar.beam_count = 256;
  sonar.azimuth_aperture = radians_from_degrees(120);
  sonar.elevation_aperture = radians_from_degrees(20);
  sonar.bin_count = 500;
  sonar.max_range = 20;
  sonar.orientation = {0, radians_from_degrees(10), 0};
  return sonar;
}

Scene make_random_scene(std::uint64_t number) {
  std::mt19937_64 random(number);  // The standard fixes the engine's numbers, but not those of distributions.
  const auto share = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
  std::array<Vec3, 4> places;
  for (Vec3& place : places) {
    const double x = kCube * share(), y = kCube * (share() - 0.5), z = kCube * (share() - 0.5);
    place = {x, y, z};
  }
  Scene scene;
  add_shapes(scene, places);
  assign_materials(scene, {});
  return scene;
}

Scene make_filled_scene() {
  Scene scene;
  add_shapes(scene, {{{9.5, -4, -1.5}, {11, 4, -1.2}, {8, 0.5, -1.1}, {13, -1.5, -1.75}}});
  add(scene, "floor", make_plane(Vec3::UnitZ(), 60, 60), {0, 0, -2});
  add(scene, "wall", make_box({0.4F, 12, 3}), {17.5, 0, -0.5});
  assign_materials(scene, {});
  return scene;
}

Scene make_rough_bed(int triangle_count) {
  constexpr double kSide = 500;
  HeightGrid grid;
  grid.columns = grid.rows = static_cast<int>(std::lround(std::sqrt(0.5 * triangle_count))) + 1;
  grid.spacing_x = grid.spacing_y = kSide / (grid.columns - 1);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double x = grid.spacing_x * column, y = grid.spacing_y * row;
      grid.heights.push_back(static_cast<float>(0.25 * std::sin(0.37 * x + 0.11 * y) + 0.15 * std::sin(0.9 * y) +
                                                0.1 * std::sin(1.7 * x - 0.8 * y)));
    }
  }
  Scene scene;
  add_instance(scene, "bed", make_height_field(grid), "sand");
  assign_materials(scene, {});
  return scene;
}

std::span<const PaperSetup> paper_setups() {
  return kSetups;
}

SonarConfig sonar_of(const PaperSetup& setup, double pitch_deg) {
  SonarConfig sonar;
  sonar.beam_count = setup.beams;
  sonar.bin_count = setup.bins;
  sonar.azimuth_aperture = radians_from_degrees(setup.azimuth_deg);
  sonar.elevation_aperture = radians_from_degrees(setup.elevation_deg);
  sonar.max_range = kCube;
  sonar.orientation = {0, radians_from_degrees(pitch_deg), 0};
  if (setup.scanning()) {
    sonar.type = SonarType::kMechanicallyScanned;
    sonar.head.step = radians_from_degrees(1.8);
  }
  return sonar;
}

}  // namespace insonify
