// own_receiver_test.cpp -- two instruments on one vehicle, each with its own pulse, gain and noise.

#include <gtest/gtest.h>

#include "insonify/simulator.h"

namespace insonify::own_receiver_test {
namespace {

Scene scene() {
  Scene scene;
  scene.instances.emplace_back().name = "sphere";
  scene.instances[0].mesh = std::make_shared<const Mesh>(make_sphere(0.5));
  scene.instances[0].world_from_mesh.position = {6, 0, 0};
  assign_materials(scene, {});
  return scene;
}

SonarConfig sonar(std::string name) {
  SonarConfig sonar;
  sonar.name = std::move(name);
  sonar.beam_count = 9;
  sonar.bin_count = 200;
  sonar.max_range = 10;
  sonar.sampling.rows = 40;
  return sonar;
}

ReceiverConfig chirping() {
  ReceiverConfig receiver;
  receiver.pulse = PulseKind::kLfm;
  receiver.pulse_duration = 1e-3;
  receiver.pulse_bandwidth = 50e3;
  receiver.time_varied_gain = 40;
  return receiver;
}

ReceiverConfig quiet() {
  ReceiverConfig receiver;
  receiver.noise = false;
  receiver.speckle = false;
  receiver.counts = true;
  receiver.full_scale_db = -40;
  return receiver;
}

Ping ping_of(Scenario scenario, int index) {
  Simulator simulator(std::move(scenario), scene(), 1);
  return simulator.make_ping(index, 0);
}

// The pings of either sonar alone, with its receiver as that of the scenario.
TEST(OwnReceiverTest, TwoSonarsHearWithTheirOwnReceivers) {
  for (const EchoModel model : {EchoModel::kCalibrated, EchoModel::kPaper}) {
    const bool calibrated = model == EchoModel::kCalibrated;
    ReceiverConfig still = quiet();
    still.counts = calibrated;
    Scenario both;
    both.model = model;
    both.sonars = {sonar("chirp"), sonar("still"), sonar("third")};
    both.sonars[0].receiver = chirping();
    both.sonars[1].receiver = still;
    Scenario alone = both;
    for (SonarConfig& one : alone.sonars) {
      one.receiver.reset();
    }
    alone.receiver = chirping();
    const Ping chirp = ping_of(alone, 0);
    alone.receiver = still;
    const Ping silent = ping_of(alone, 1);
    alone.receiver = both.receiver;
    const Ping third = ping_of(alone, 2);
    EXPECT_EQ(ping_of(both, 0).intensity, chirp.intensity);
    EXPECT_EQ(ping_of(both, 1).intensity, silent.intensity);
    EXPECT_EQ(ping_of(both, 1).counts, silent.counts);
    EXPECT_EQ(ping_of(both, 2).intensity, third.intensity);
    EXPECT_NE(chirp.intensity, silent.intensity);
    EXPECT_EQ(silent.counts.empty(), !calibrated);
    EXPECT_TRUE(chirp.counts.empty());
  }
}

}  // namespace
}  // namespace insonify::own_receiver_test
