// look_along_fan_test.cpp -- distance and intensity images of simple scenes with known geometry.

#include "engines/test_scenes.h"
#include "insonify/scene_view.h"
#include "support/message_of.h"

namespace insonify::look_along_fan_test {
namespace {

using namespace testing_scenes;

// A wall across x at 5 m, seen over 60 x 30 degrees, in water of 0.1 dB/m.
TEST(LookAlongFanTest, SeesAWall) {
  const Scene scene = SceneMaker().add_wall(5, 0.5).scene();
  const auto engine = test_engine("cpu", 2);
  engine->set_scene(scene);
  SonarConfig sonar;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.elevation_aperture = 30 * kDegree;
  sonar.max_range = 5.5;
  Water water;
  water.absorption_db_per_m = 0.1;
  const Channels channels = look_along_fan(engine->engine(), sonar, water, {}, 60);
  ASSERT_EQ(channels.columns, 60);
  ASSERT_EQ(channels.rows, 30);
  EXPECT_NEAR(channels.port_edge, 30 * kDegree, 1e-9);
  EXPECT_NEAR(channels.lower_edge, -15 * kDegree, 1e-9);
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 60; ++column) {
      const double cosine = std::cos((29.5 - column) * kDegree) * std::cos((14.5 - row) * kDegree);
      const float distance = channels.distance[row * 60 + column], intensity = channels.intensity[row * 60 + column];
      if (5 / cosine > 5.5) {
        EXPECT_TRUE(std::isnan(distance));
        EXPECT_TRUE(std::isnan(intensity));
      } else {
        EXPECT_NEAR(distance, 5 / cosine, 1e-4);
        // The paper's amplitude factor e^(-2 gamma r): 0.1 dB/m over slightly more than 10 m.
        EXPECT_NEAR(intensity, 0.5 * cosine * std::pow(10, -0.1 * 2 * 5 / cosine / 20), 1e-5);
      }
    }
  }
}

// Port is left and up is up; a scanning head covers all directions.
TEST(LookAlongFanTest, SeesAllThatAHeadSweeps) {
  const Scene scene = SceneMaker().add_sphere({0, 4, 1}, 0.5).scene();
  const auto engine = test_engine("cpu", 2);
  engine->set_scene(scene);
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 2 * kDegree;
  sonar.elevation_aperture = 40 * kDegree;
  const Channels channels = look_along_fan(engine->engine(), sonar, {}, {}, 720);
  EXPECT_NEAR(channels.port_edge - channels.starboard_edge, 360 * kDegree, 1e-6);
  double x = 0, y = 0, count = 0;
  for (int row = 0; row < channels.rows; ++row) {
    for (int column = 0; column < channels.columns; ++column) {
      if (!std::isnan(channels.distance[row * channels.columns + column])) {
        x += column + 0.5;
        y += row + 0.5;
        ++count;
      }
    }
  }
  ASSERT_GT(count, 0);
  const double azimuth = channels.port_edge - x / count / 2 * kDegree;
  EXPECT_NEAR(azimuth, 90 * kDegree, 0.3 * kDegree);
  EXPECT_NEAR(channels.upper_edge - y / count / 2 * kDegree, std::atan2(1, 4), 0.3 * kDegree);
}

TEST(LookAlongFanTest, RefusesNoColumns) {
  const Scene scene = SceneMaker().add_wall(5).scene();
  const auto engine = test_engine("cpu", 1);
  engine->set_scene(scene);
  EXPECT_EQ(message_of([&] { static_cast<void>(look_along_fan(engine->engine(), SonarConfig{}, {}, {}, 0)); }),
            "channels.columns = 0 must be from 1 to 8192");
}

}  // namespace
}  // namespace insonify::look_along_fan_test
