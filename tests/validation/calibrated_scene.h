// calibrated_scene.h -- scenes and scenarios of the physics tests of the calibrated model, and levels of their pings.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "insonify/simulator.h"

namespace insonify::validation {

inline constexpr double kDegree = 3.14159265358979323846 / 180;

/// Engine and method by which echoes are computed; the results must agree.
struct Method {
  const char* name;
  const char* engine;
  PrimaryEchoes primary;
};
inline constexpr Method kRays{"cpuRays", "cpu", PrimaryEchoes::kRays};
inline constexpr Method kRaster{"cpuRaster", "cpu", PrimaryEchoes::kRaster};
inline constexpr Method kReference{"reference", "reference", PrimaryEchoes::kRays};

/// A surface that scatters by Lambert's law only.
inline Material diffuse(double lambert_db) {
  Material material;
  material.name = "diffuse";
  material.lambert_db = lambert_db;
  material.reflection = 0;
  return material;
}

/// A surface with a facet lobe only.
inline Material glinting(double reflection, double rms_slope) {
  Material material;
  material.name = "glinting";
  material.lambert_db = -200;
  material.reflection = reflection;
  material.rms_slope = rms_slope;
  return material;
}

inline Scene scene_of(Mesh mesh, const Material& material, const Pose& world_from_mesh) {
  Scene scene;
  scene.materials = {material};
  Instance instance;
  instance.name = material.name;
  instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
  instance.world_from_mesh = world_from_mesh;
  instance.materials.assign(instance.mesh->material_names.size(), 0);
  scene.instances = {std::move(instance)};
  return scene;
}

/// A square plate at x = distance that faces the sonar, turned by `tilt` about its vertical axis.
inline Scene plate_at(double distance, double side, const Material& material, double tilt = 0) {
  return scene_of(make_plane(-Vec3::UnitX(), side, side), material,
                  {.position = {distance, 0, 0}, .orientation = orientation_from_rpy(0, 0, tilt)});
}

inline Scene sphere_at(const Vec3& centre, double radius, const Material& material, double max_edge_angle = 0.04) {
  return scene_of(make_sphere(radius, max_edge_angle), material, {.position = centre});
}

inline Scene seabed_at(double height, const Material& material) {
  return scene_of(make_plane(Vec3::UnitZ(), 400, 400), material, {.position = {0, 0, height}});
}

/// Several scenes in one; each keeps its material.
inline Scene scene_of_all(std::vector<Scene> scenes) {
  Scene all;
  for (Scene& scene : scenes) {
    scene.instances[0].materials.assign(scene.instances[0].materials.size(),
                                        static_cast<std::uint16_t>(all.materials.size()));
    all.materials.push_back(scene.materials[0]);
    all.instances.push_back(std::move(scene.instances[0]));
  }
  return all;
}

inline Scene plane(const Vec3& normal, const Vec3& position, const Material& material) {
  return scene_of(make_plane(normal, 200, 200), material, {.position = position});
}

/// A wall at x = 10 on a floor at z = -8, for a sonar at z = -5.
inline Scene corner(double reflection, double lambert_db) {
  Material material = glinting(reflection, 0.1);
  material.lambert_db = lambert_db;
  return scene_of_all({plane(-Vec3::UnitX(), {10, 0, 92}, material), plane(Vec3::UnitZ(), {-90, 0, -8}, material)});
}

inline SonarConfig corner_sonar() {
  SonarConfig sonar;
  sonar.beam_count = 64;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.elevation_aperture = 90 * kDegree;
  sonar.min_range = 5;
  sonar.max_range = 20;
  sonar.bin_count = 600;
  sonar.sampling = {4, 800};
  return sonar;
}

/// A ping of the calibrated model: no absorption, noise or secondary echoes unless the caller's scenario says so.
inline Scenario calibrated(const SonarConfig& sonar, const Method& method) {
  Scenario scenario;
  scenario.model = EchoModel::kCalibrated;
  scenario.engine = method.engine;
  scenario.primary = method.primary;
  scenario.secondary = SecondaryEchoes::kNone;
  scenario.water.absorption = false;
  scenario.receiver.noise = false;
  scenario.receiver.speckle = false;
  scenario.receiver.azimuth_pattern = BeamPattern::kTopHat;
  scenario.sonars = {sonar};
  return scenario;
}

inline Ping ping_of(const Scenario& scenario, const Scene& scene) {
  return Simulator(scenario, scene, 2).make_ping(0, 0);
}

/// Sum of all intensities of a ping [dB re the source level].
inline double total_db(const Ping& ping) {
  double sum = 0;
  for (const float value : ping.intensity) {
    sum += value;
  }
  return 10 * std::log10(sum);
}

/// Intensity of one beam and bin [dB re the source level].
inline double cell_db(const Ping& ping, int bin, int beam) {
  return 10 * std::log10(double{ping.intensity[ping.index(bin, beam)]});
}

/// Sum over the beams of each bin.
inline std::vector<double> by_range(const Ping& ping) {
  std::vector<double> sums(ping.bin_count, 0.0);
  for (int bin = 0; bin < ping.bin_count; ++bin) {
    for (int beam = 0; beam < ping.beam_count; ++beam) {
      sums[bin] += ping.intensity[ping.index(bin, beam)];
    }
  }
  return sums;
}

}  // namespace insonify::validation
