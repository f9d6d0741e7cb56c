// bench_paper_scene.cpp -- scenes and sonars as in the authors' own benchmark.

#include "benchmark/bench_paper_scene.h"

#include <array>
#include <random>

namespace insonify {
namespace {

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
