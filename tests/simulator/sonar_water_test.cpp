// sonar_water_test.cpp -- each sonar has one water, at its own depth, used by plan, assumed sound speed, receiver and
// recording.

#include <gmock/gmock.h>

#include "engines/test_scenes.h"
#include "insonify/error.h"
#include "insonify/files.h"
#include "io/h5_read.h"
#include "support/test_files.h"

namespace insonify::sonar_water_test {
namespace {

using namespace testing_scenes;
using testing::ThrowsMessage;

// A single beam at a wall, far below the surface.
SonarConfig pencil() {
  SonarConfig sonar;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 2 * kDegree;
  sonar.elevation_aperture = 2 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 25;
  sonar.bin_count = 1000;
  sonar.sampling = {.columns_per_beam = 4, .rows = 16};
  return sonar;
}

class SonarWaterTest : public testing::TestWithParam<EngineAndModel> {};

INSTANTIATE_TEST_SUITE_P(Engines, SonarWaterTest, testing::ValuesIn(engines_and_models()),
                         [](const auto& test) { return test.param.name; });

// At 2000 m sound travels 2 % faster than at the surface: a sonar that assumed the surface's speed would measure 19.56
// m.
TEST_P(SonarWaterTest, WallIsHeardWhereItIsFarBelowTheSurface) {
  Scenario scenario = quiet_scenario(pencil(), GetParam());
  scenario.surface = SeaSurface{.level = 2000};
  Simulator simulator(scenario, SceneMaker().add_wall(20).scene(), 1);
  const Ping ping = simulator.make_ping(0, 0);
  const double bin_length = simulator.sonar(0).bin_length();
  EXPECT_NEAR(centroid_bin(ping.intensity) * bin_length, 20, bin_length);
}

// The gain compensates the absorption that the echo has suffered: a wall that scatters by Lambert's law then has the
// same level with and without absorption.
TEST(SonarWaterTest, ReceiverMakesUpForTheAbsorptionThatThereIs) {
  Scenario scenario = quiet_scenario(pencil());
  scenario.model = EchoModel::kCalibrated;
  scenario.surface = SeaSurface{.level = 4000};
  scenario.receiver.time_varied_gain = 40;
  const auto loudest = [&](bool absorption) {
    scenario.water.absorption = absorption;
    const Ping ping = Simulator(scenario, without_glints(SceneMaker().add_wall(20).scene()), 1).make_ping(0, 0);
    return 10 * std::log10(*std::ranges::max_element(ping.intensity));
  };
  // 0.20 dB/m at the surface and 0.17 at 4000 m: the wrong one would give an error of 1.3 dB after 40 m.
  EXPECT_NEAR(loudest(true), loudest(false), 0.02);
}

TEST(SonarWaterTest, RecordingTellsTheWaterAtTheSonarsDepth) {
  Scenario scenario = quiet_scenario(pencil());
  scenario.surface = SeaSurface{.level = 2000};
  scenario.trajectory.waypoints = {{.position = {0, 0, 500}}};
  scenario.sonars[0].position = {0, 0, -10};
  scenario.water.absorption = true;
  const Scene scene = SceneMaker().add_wall(20).scene();
  const Simulator simulator(scenario, scene, 1);
  const std::filesystem::path path = process_folder() / "sonar_water_test.h5";
  Recording(path, simulator.scenario(), simulator.scene(), simulator.sonar(0), {.replace = true}).close();
  const H5Reader file(path);
  Water deep;
  deep.depth = 1510;
  EXPECT_EQ(file.values<double>("settings/water/depth").at(0), 1510);
  EXPECT_EQ(file.attribute<double>("/", "sound_speed"), deep.true_sound_speed());
  EXPECT_EQ(file.attribute<double>("/", "absorption_db_per_m"), deep.absorption_db_per_m_at(720e3));
  EXPECT_EQ(*simulator.sonar(0).assumed_sound_speed, deep.true_sound_speed());
}

TEST(SonarWaterTest, ShortestPingPeriodIsThatOfTheWaterAtTheSonarsDepth) {
  Scenario scenario = quiet_scenario(pencil());
  scenario.surface = SeaSurface{.level = 6000};
  scenario.sonars[0].ping_period = 0.0325;  // 50 m at 1538.5 m/s; sound is faster at 6000 m, slower at the surface.
  EXPECT_NO_THROW(scenario.validate());
  scenario.surface->level = 0.1;
  EXPECT_THAT([&] { scenario.validate(); },
              ThrowsMessage<Error>("sonars[0].ping_period = 0.0325 s must be at least 0.0336 s, the time sound takes "
                                   "to max_range = 25 m and back"));
}

TEST(SonarWaterTest, RefusesDepthsWhereNoFormulaHolds) {
  Scenario scenario = quiet_scenario(pencil());
  scenario.surface = SeaSurface{.level = 7001};
  EXPECT_THAT([&] { scenario.validate(); },
              ThrowsMessage<Error>("surface.level = 7001 m puts sonars[0] 7001 m deep; must be at most 7000 m"));
}

}  // namespace
}  // namespace insonify::sonar_water_test
