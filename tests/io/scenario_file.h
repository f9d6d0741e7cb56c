// scenario_file.h -- tests that load scenarios from text.

#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "insonify/files.h"
#include "support/working_folder.h"

namespace insonify {

/// Degrees are converted to radians by a division and a multiplication: a few units in the last place.
inline constexpr double kAngleTolerance = 1e-15;

class ScenarioTest : public testing::Test {
 protected:
  ScenarioTest() { folder.write("scenes/worlds/floor.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"); }

  Scenario load(const std::string& yaml, const std::vector<std::string>& settings = {}) const {
    folder.write("scenes/scenario.yaml", yaml);
    return load_scenario("scenes/scenario.yaml", settings);
  }

  WorkingFolder folder;
};

}  // namespace insonify
