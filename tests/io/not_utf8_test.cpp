// not_utf8_test.cpp -- bytes that are no text in a scenario are escaped before anything is stored.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/files.h"
#include "insonify/recorded_pings.h"
#include "insonify/simulator.h"
#include "support/working_folder.h"

namespace insonify::not_utf8_test {
namespace {

TEST(NotUtf8Test, NamesOfAScenarioAreEscaped) {
  const WorkingFolder folder;
  folder.write("t\xe9.obj", "v 5 -1 -1\nv 5 1 -1\nv 5 0 1\nusemtl caf\xe9\nf 1 2 3\n");
  folder.write("a.yaml",
               "# caf\xe9\nworld: t\xe9.obj\nmaterials: {caf\xe9: steel}\nsonars: [{name: fls, beam_count: 2, "
               "bin_count: 4}]\n");
  const Scenario scenario = load_scenario("a.yaml");
  EXPECT_TRUE(scenario.materials.overrides.contains("caf\\xe9"));
  EXPECT_EQ(scenario.text.find('\xe9'), std::string::npos);
  Simulator simulator(scenario, load_scene(scenario));
  EXPECT_EQ(simulator.scene().instances[0].name, "t\\xe9");

  Recording recording("a.h5", simulator.scenario(), simulator.scene(), simulator.sonar(0));
  recording.add(simulator.make_ping(0, 0));
  recording.close();
  std::ifstream file("a.h5", std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  EXPECT_NE(bytes.find("t\\xe9.obj"), std::string::npos) << "the world's path";
  EXPECT_EQ(bytes.find("t\xe9"), std::string::npos);
  EXPECT_EQ(bytes.find("caf\xe9"), std::string::npos);
}

}  // namespace
}  // namespace insonify::not_utf8_test
