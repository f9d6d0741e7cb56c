// pattern_scenes.h -- beds and patterns for tests of surveys.

#pragma once

#include <functional>
#include <memory>

#include "insonify/scenario.h"

namespace insonify::testing_surveys {

/// A bed of quads a metre wide over +-half [m], of a height at each corner.
inline Scene bed_scene(int half, const std::function<double(double x, double y)>& height) {
  HeightGrid grid{.columns = 2 * half + 1, .rows = 2 * half + 1, .spacing_x = 1, .spacing_y = 1, .heights = {}};
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      grid.heights.push_back(static_cast<float>(height(column - half, half - row)));
    }
  }
  Scene scene;
  scene.instances.push_back({.name = "bed", .mesh = std::make_shared<const Mesh>(make_height_field(grid))});
  assign_materials(scene, {});
  return scene;
}

inline Scene flat_scene(double height = -20, int half = 150) {
  return bed_scene(half, [=](double, double) { return height; });
}

/// Three lines of 100 m along x, 10 m apart, 5 m above the bed at 2 m/s.
inline SurveyPattern three_lines() {
  return {.lines = {.center = {0, 0}, .length = 100, .width = 30, .altitude = 5, .spacing = 10, .speed = 2}};
}

inline Scenario survey_scenario(const SurveyPattern& pattern) {
  Scenario scenario;
  SonarConfig sonar;
  sonar.ping_period = 0.5;
  scenario.sonars = {sonar};
  scenario.pattern = pattern;
  return scenario;
}

}  // namespace insonify::testing_surveys
