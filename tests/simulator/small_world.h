// small_world.h -- a small scene and sonar for tests of changes between pings, on every engine, in both models and with
// traced and rasterised primaries.

#pragma once

#include <gtest/gtest.h>

#include "engines/test_scenes.h"
#include "insonify/scenario_requests.h"
#include "support/message_of.h"
#include "support/same_pings.h"

namespace insonify::testing_scenes {

struct PingCase {
  const char* name;
  const char* engine;
  EchoModel model;
  PrimaryEchoes primary;
};
inline constexpr PingCase kPingCases[] = {
    {"cpuRaysPaper", "cpu", EchoModel::kPaper, PrimaryEchoes::kRays},
    {"cpuRasterPaper", "cpu", EchoModel::kPaper, PrimaryEchoes::kRaster},
    {"referencePaper", "reference", EchoModel::kPaper, PrimaryEchoes::kRays},
    {"cpuRaysCalibrated", "cpu", EchoModel::kCalibrated, PrimaryEchoes::kRays},
    {"cpuRasterCalibrated", "cpu", EchoModel::kCalibrated, PrimaryEchoes::kRaster},
    {"referenceCalibrated", "reference", EchoModel::kCalibrated, PrimaryEchoes::kRays},
};
inline constexpr auto kPingCaseName = [](const auto& test) { return test.param.name; };

inline SonarConfig small_sonar() {
  SonarConfig sonar;
  sonar.name = "fls";
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 80 * kDegree;
  sonar.elevation_aperture = 30 * kDegree;
  sonar.elevation_center = -6 * kDegree;
  sonar.bin_count = 160;
  sonar.max_range = 16;
  sonar.sampling = {.columns_per_beam = 3, .rows = 40};
  return sonar;
}

/// With every feature of the model: secondary echoes, noise and, in the calibrated model, speckle and full ground
/// truth.
inline Scenario small_scenario(const PingCase& on) {
  Scenario scenario = quiet_scenario(small_sonar());
  scenario.engine = on.engine;
  scenario.model = on.model;
  scenario.primary = on.primary;
  scenario.secondary = SecondaryEchoes::kSelective;
  scenario.receiver.noise = true;
  if (on.model == EchoModel::kCalibrated) {
    scenario.receiver.speckle = true;
    scenario.ground_truth = GroundTruth::kFull;
  }
  return scenario;
}

/// A floor, a box with relief, a ship of two parts, and a ball.
inline Scene small_world() {
  Scene scene = SceneMaker()
                    .add_floor(-2.4, 0.5, 30)
                    .add("box", make_box({1, 2, 1.4}), {.position = {7, -2, -1.4}})
                    .add("ship::hull", make_box({2, 0.8, 0.6}), {{9, 2, -1}, orientation_from_rpy(0, 0, 0.5)}, 0.9)
                    .add("ship::mast", make_cylinder(0.1, 1.5, 0.4), {.position = {9, 2, -0.2}}, 0.9)
                    .add("ball", make_sphere(0.4, 0.3), {.position = {5, 0.5, -1.2}}, 0.7)
                    .scene();
  Relief relief;
  relief.slopes = {2, 2, {{0.2F, 0}, {0, 0.1F}, {-0.1F, 0}, {0, -0.2F}}};
  relief.by_position = true;
  scene.instances[1].reliefs.assign(1, std::make_shared<const Relief>(relief));
  return scene;
}

inline constexpr int kFloor = 0, kBox = 1, kHull = 2, kMast = 3, kBall = 4;

}  // namespace insonify::testing_scenes
