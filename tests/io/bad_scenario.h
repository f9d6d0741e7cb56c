// bad_scenario.h -- invalid scenarios and their one-line errors.

#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "insonify/files.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify {

struct BadScenario {
  const char* name;
  const char* yaml;
  const char* message;  // FOLDER stands for the working folder, PRESETS for the names of all presets.
  std::vector<std::string> settings = {};
};

inline void PrintTo(const BadScenario& bad, std::ostream* out) {
  *out << bad.name;
}

// A valid scenario, to which settings add an error.
constexpr const char* kGoodScenario =
    "world: floor.obj\nsonars:\n  - name: fls\n  - name: dst\n    preset: tritech-micron-dst\n";

class BadScenarioTest : public testing::TestWithParam<BadScenario> {
 protected:
  BadScenarioTest() { folder.write("floor.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"); }

  void expect_told_in_one_line() const {
    folder.write("scenario.yaml", GetParam().yaml);
    std::string message = GetParam().message;
    if (const std::size_t place = message.find("FOLDER"); place != std::string::npos) {
      message.replace(place, 6, folder.path().string());
    }
    if (const std::size_t place = message.find("PRESETS"); place != std::string::npos) {
      message.replace(place, 7, fmt::format("{}", fmt::join(preset_names(), ", ")));
    }
    EXPECT_EQ(message_of([&] { (void)load_scenario("scenario.yaml", GetParam().settings); }), message);
  }

  WorkingFolder folder;
};

}  // namespace insonify
