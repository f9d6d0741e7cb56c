// recording_room_test.cpp -- a recording with every dataset that a ping can fill.

#include <gmock/gmock.h>

#include "insonify/files.h"
#include "io/h5_read.h"
#include "support/test_files.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::recording_room_test {
namespace {

// A scanning head has most datasets: head angle, full ground truth, counts and field beside those of all sonars.
TEST(RecordingRoomTest, AllDatasetsFit) {
  SonarConfig sonar;
  sonar.name = "head";
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 3 * kDegree;
  sonar.bin_count = 60;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.ground_truth = GroundTruth::kFull;
  scenario.receiver.speckle = scenario.receiver.field = scenario.receiver.counts = true;
  scenario.receiver.full_scale_db = -40;
  Simulator simulator(scenario, plate_at(10, 2, diffuse(-10)), 1);
  const auto path = process_folder() / "recording_room_test.h5";
  Recording recording(path, simulator.scenario(), simulator.scene(), simulator.sonar(0), {.replace = true});
  const Ping ping = simulator.make_ping(0, 0);
  recording.add(ping);
  recording.close();
  const H5Reader file(path);
  for (const char* name :
       {"intensity", "instance", "material", "elevation", "strongest_instance", "strongest_share", "elevation_spread",
        "path_order", "shadow", "direct_intensity", "counts", "field", "time", "world_from_sonar", "head_angle"}) {
    EXPECT_TRUE(file.has(name)) << name;
  }
  EXPECT_EQ(file.row<float>("intensity", 0), ping.intensity);
  EXPECT_EQ(file.row<float>("direct_intensity", 0), ping.direct_intensity);
  EXPECT_EQ(file.values<double>("head_angle").size(), 1U);
}

}  // namespace
}  // namespace insonify::validation::recording_room_test
