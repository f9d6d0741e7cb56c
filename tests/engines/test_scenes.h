// test_scenes.h -- simple scenes and sonars whose echoes can be computed by hand, shared by the tests of all engines.

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>

#include "insonify/mesh.h"
#include "insonify/scene.h"
#include "insonify/simulator.h"
#include "support/message_of.h"
#include "support/test_engine.h"

namespace insonify::testing_scenes {

inline constexpr double kDegree = 3.14159265358979323846 / 180;

/// Builds a scene; each instance has a material of its own with a given reflectivity.
class SceneMaker {
 public:
  SceneMaker& add(std::string name, Mesh mesh, const Pose& world_from_mesh = {}, double reflectivity = 0.8) {
    Material material;
    material.name = name;
    material.reflectivity = reflectivity;
    Instance instance;
    instance.name = std::move(name);
    instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
    instance.world_from_mesh = world_from_mesh;
    instance.materials.assign(instance.mesh->material_names.size(),
                              static_cast<std::uint16_t>(scene_.materials.size()));
    scene_.materials.push_back(material);
    scene_.instances.push_back(std::move(instance));
    return *this;
  }

  /// A wall across +x at a distance, wide and high enough to fill any fan used here.
  SceneMaker& add_wall(double distance, double reflectivity = 0.8, double half_size = 200) {
    return add("wall", make_plane(Vec3::UnitX(), 2 * half_size, 2 * half_size), {.position = {distance, 0, 0}},
               reflectivity);
  }

  /// A horizontal floor at a height.
  SceneMaker& add_floor(double height, double reflectivity = 0.8, double half_size = 200) {
    return add("floor", make_plane(Vec3::UnitZ(), 2 * half_size, 2 * half_size), {.position = {0, 0, height}},
               reflectivity);
  }

  SceneMaker& add_sphere(const Vec3& centre, double radius, double reflectivity = 0.8, double max_edge_angle = 0.2) {
    return add("sphere" + std::to_string(scene_.instances.size()), make_sphere(radius, max_edge_angle),
               {.position = centre}, reflectivity);
  }

  [[nodiscard]] const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
};

/// Echoes of one ping on one engine, without receiver.
inline EchoGrid echoes_of(TestEngine& engine, const FlatPlanSettings& settings, const Pose& world_from_sonar = {}) {
  EchoGrid grid(settings.sonar.beam_count, settings.sonar.bin_count, kPathOrders);
  engine.insonify(*make_flat_plan(settings), world_from_sonar, grid);
  return grid;
}

inline EchoGrid echoes_of(const std::string& engine_name, const Scene& scene, const FlatPlanSettings& settings,
                          const Pose& world_from_sonar = {}, int threads = 2) {
  const auto engine = test_engine(engine_name, threads);
  engine->set_scene(scene);
  return echoes_of(*engine, settings, world_from_sonar);
}

/// Engines that can run here. Engine `gpu` runs on Mesa's driver for the processor, unless INSONIFY_DEVICE names a
/// card, and under the validation layer where it is installed: a message of it fails the test.
inline const std::vector<std::string_view>& usable_engines() {
  static const std::vector<std::string_view> usable = [] {
    setenv("INSONIFY_DEVICE", "llvmpipe", 0);
    std::vector<std::string_view> names;
    Workers workers(1);
    for (const std::string_view name : engine_names()) {
      setenv("INSONIFY_VULKAN_VALIDATION", "1", 1);
      const auto fails = [&] {
        const std::string message = message_of([&] { static_cast<void>(make_engine(name, workers)); });
        return message == "no error" ? std::string() : message;
      };
      std::string why = fails();
      if (!why.empty()) {
        unsetenv("INSONIFY_VULKAN_VALIDATION");
        why = fails();
      }
      if (why.empty()) {
        names.push_back(name);
      } else {
        std::cout << "Engine " << name << " is not tested: " << why << '\n';
      }
    }
    return names;
  }();
  return usable;
}

/// Parameters of tests that run on every engine, in both models.
struct EngineAndModel {
  std::string name;
  std::string engine;
  EchoModel model;
};
inline std::vector<EngineAndModel> engines_and_models() {
  std::vector<EngineAndModel> all;
  for (const std::string_view name : usable_engines()) {
    const std::string engine(name);
    all.push_back({engine, engine, EchoModel::kPaper});
    all.push_back({engine + "Calibrated", engine, EchoModel::kCalibrated});
  }
  return all;
}

/// All engines but the oracle, which the others are compared with.
inline std::vector<std::string> engines_to_compare() {
  std::vector<std::string> names;
  for (const std::string_view name : usable_engines()) {
    if (name != "reference") {
      names.emplace_back(name);
    }
  }
  return names;
}

/// The same scene with surfaces that do not reflect: in the calibrated model they scatter by Lambert's law only.
inline Scene without_glints(Scene scene) {
  for (Material& material : scene.materials) {
    material.reflection = 0;
  }
  return scene;
}

/// A scenario of one sonar without noise, absorption or secondary echoes.
inline Scenario quiet_scenario(const SonarConfig& sonar) {
  Scenario scenario;
  scenario.model = EchoModel::kPaper;
  scenario.receiver.speckle = false;
  scenario.receiver.azimuth_pattern = BeamPattern::kTopHat;
  scenario.sonars = {sonar};
  scenario.water.absorption = false;
  scenario.receiver.noise = false;
  scenario.secondary = SecondaryEchoes::kNone;
  return scenario;
}

inline Scenario quiet_scenario(const SonarConfig& sonar, const EngineAndModel& on) {
  Scenario scenario = quiet_scenario(sonar);
  scenario.engine = on.engine;
  scenario.model = on.model;
  return scenario;
}

/// Centroid of the energy in one beam [bins]; NaN where there is no energy.
inline double centroid_bin(std::span<const float> energy) {
  double sum = 0, moment = 0;
  for (std::size_t bin = 0; bin < energy.size(); ++bin) {
    sum += energy[bin];
    moment += (static_cast<double>(bin) + 0.5) * energy[bin];
  }
  return moment / sum;
}

/// Sum of the energy of one path order.
inline double total(const EchoGrid& grid, int order) {
  double sum = 0;
  for (int beam = 0; beam < grid.beam_count(); ++beam) {
    for (const float value : grid.energy(order, beam)) {
      sum += value;
    }
  }
  return sum;
}

/// Sum |a - b| / sum a of the energy of one path order.
inline double difference(const EchoGrid& a, const EchoGrid& b, int order) {
  double apart = 0;
  for (int beam = 0; beam < a.beam_count(); ++beam) {
    for (int bin = 0; bin < a.bin_count(); ++bin) {
      apart += std::abs(double{a.energy(order, beam)[bin]} - double{b.energy(order, beam)[bin]});
    }
  }
  const double sum = total(a, order);
  return sum > 0 ? apart / sum : apart;
}

}  // namespace insonify::testing_scenes
