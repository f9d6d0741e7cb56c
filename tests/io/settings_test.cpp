// settings_test.cpp -- `--set`: settings override a scenario file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/scenario_file.h"
#include "support/message_of.h"

namespace insonify::settings_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class SettingsTest : public ScenarioTest {};

constexpr const char* kTwoSonars =
    "world: worlds/floor.obj  # A floor.\nsonars:\n  - name: fls\n    max_range: 20\n  - name: dst\n    preset: "
    "tritech-micron-dst\n";

TEST_F(SettingsTest, SettingsOverrideTheFile) {
  const Scenario scenario = load(kTwoSonars, {"pings=3", "water.depth=4", "sonars[0].max_range=30",
                                              "sonars.dst.max_range=12", "view={position: [1, 2, 3]}"});
  EXPECT_EQ(scenario.pings, 3);
  EXPECT_EQ(scenario.water.depth, 4);
  EXPECT_EQ(scenario.sonars.at(0).max_range, 30);
  EXPECT_EQ(scenario.sonars.at(1).max_range, 12);
  EXPECT_EQ(scenario.view->position, Vec3(1, 2, 3));
}

TEST_F(SettingsTest, ALaterSettingWins) {
  EXPECT_EQ(load(kTwoSonars, {"pings=3", "pings=4"}).pings, 4);
  EXPECT_THAT(
      [&] {
        (void)load(kTwoSonars, {"duration=1", "pings=3"});
      },
      testing::ThrowsMessage<Error>("--set pings=3: cannot be set together with --set duration=1; leave one out"));
}

// For programs whose options are settings.
TEST_F(SettingsTest, ASettingMayBeNamedAsAnOption) {
  EXPECT_EQ(load(kTwoSonars, {"--pings=3"}).pings, 3);
  EXPECT_THAT([&] { (void)load(kTwoSonars, {"--pings=0"}); },
              testing::ThrowsMessage<Error>(HasSubstr("--pings=0: pings = 0 must be")));
  EXPECT_THAT(
      [&] {
        (void)load(kTwoSonars, {"--pings=3", "duration=1"});
      },
      testing::ThrowsMessage<Error>("--set duration=1: cannot be set together with --pings=3; leave one out"));
}

// Whichever of its keys the file uses.
TEST_F(SettingsTest, ASettingTakesThePlaceOfItsAlternatives) {
  const std::string text =
      "world: worlds/floor.obj\nduration: 2\nsonars: [{ping_period: 0.5, orientation_deg: [0, 20, 0]}]\n";
  EXPECT_EQ(load(text, {"pings=3"}).pings, 3);
  EXPECT_FALSE(load(text, {"pings=3"}).duration.has_value());
  const Scenario turned = load(text, {"orientation_wxyz=[0, 1, 0, 0]"});
  EXPECT_NEAR(turned.sonars.at(0).orientation.x(), std::numbers::pi, kAngleTolerance);
  EXPECT_NEAR(turned.sonars.at(0).orientation.tail<2>().norm(), 0, kAngleTolerance);
  EXPECT_THAT(
      [&] {
        (void)load(text, {"orientation_wxyz=[1, 0, 0, 0]", "orientation_deg=[0, 0, 0]"});
      },
      testing::ThrowsMessage<Error>("--set orientation_deg=[0, 0, 0]: cannot be set together with --set "
                                    "orientation_wxyz=[1, 0, 0, 0]; leave one out"));
}

TEST_F(SettingsTest, ASonarsKeyAloneSetsEverySonar) {
  const Scenario scenario = load(kTwoSonars, {"max_range=8", "sampling.rows=33", "elevation_aperture_deg=9"});
  for (const SonarConfig& sonar : scenario.sonars) {
    EXPECT_EQ(sonar.max_range, 8);
    EXPECT_EQ(sonar.sampling.rows, 33);
    EXPECT_NEAR(sonar.elevation_aperture, std::numbers::pi / 20, kAngleTolerance);
  }
}

TEST_F(SettingsTest, KeepsTheTextWithItsSettings) {
  const Scenario scenario = load(kTwoSonars, {"sonars.fls.max_range=30", "materials.hull.lambert_db=-9", "seed=5"});
  EXPECT_THAT(scenario.text, HasSubstr("max_range: 30"));
  // The recorded text is a scenario itself, and the same one.
  const Scenario again = load(scenario.text);
  EXPECT_EQ(again.sonars.at(0).max_range, 30);
  EXPECT_EQ(again.sonars.at(1).model, "Tritech Micron DST");
  EXPECT_EQ(again.materials.overrides.at("hull").lambert_db, -9);
  EXPECT_EQ(again.seed, 5U);
  EXPECT_EQ(again.text, scenario.text);
}

TEST_F(SettingsTest, KeepsQuotedTextQuoted) {
  const Scenario scenario = load("world: worlds/floor.obj\nsonars: [{name: \"007\"}]\n", {"pings=2"});
  EXPECT_EQ(scenario.sonars.at(0).name, "007");
  EXPECT_THAT(scenario.text, HasSubstr("name: \"007\""));
}

TEST_F(SettingsTest, FileErrorsOfADefaultNameTheSonar) {
  // max_range has its default: the position is that of the key in conflict with it.
  EXPECT_THAT(message_of([&] { (void)load("world: worlds/floor.obj\nsonars:\n  - name: a\n    min_range: 60\n"); }),
              StartsWith("scenes/scenario.yaml:4:5: sonars[0].max_range = 50 m"));
}

}  // namespace
}  // namespace insonify::settings_test
