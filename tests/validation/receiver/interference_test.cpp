// interference_test.cpp -- range, bearing and level of pulses received from another sonar.

#include "validation/calibrated_scene.h"

namespace insonify::validation {
namespace {

constexpr double kSoundSpeed = 1500;

Scenario beside_another() {
  SonarConfig sonar;
  sonar.beam_count = 120;
  sonar.min_range = 0;
  sonar.max_range = 37.5;
  sonar.bin_count = 750;
  sonar.source_level_db = 200;
  sonar.ping_period = 0.07;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.sound_speed = kSoundSpeed;
  scenario.interferers = {{.position = 30 * Vec3(std::cos(20.5 * kDegree), std::sin(20.5 * kDegree), 0),
                           .source_level_db = 190,
                           .period = 0.1,
                           .first_pulse = 0.01,
                           .duration = 1e-6}};
  return scenario;
}

// A pulse sent at 10 ms arrives after 20 ms, at 30 ms, as an echo from 22.5 m would. In the next ping the pulse sent at
// 110 ms arrives at 110 + 20 - 70 = 60 ms, after the last bin.
TEST(InterferenceTest, ArrivesAfterItsTravelTime) {
  Simulator simulator(beside_another(), {}, 1);
  const Ping ping = simulator.make_ping(0, 0);
  const auto at = std::ranges::max_element(ping.intensity) - ping.intensity.begin();
  EXPECT_NEAR(simulator.sonar(0).bin_range(static_cast<int>(at / ping.beam_count)), 22.5, 0.026);
  EXPECT_NEAR(simulator.sonar(0).beam_azimuth(static_cast<int>(at % ping.beam_count)) / kDegree, 20.5, 0.01);
  EXPECT_NEAR(total_db(ping), 190 - 200 - 20 * std::log10(30), 0.01);
  EXPECT_EQ(total_db(simulator.make_ping(0, 1)), -std::numeric_limits<double>::infinity());
  // 210 + 20 - 210 = 20 ms: 15 m.
  const std::vector<double> third = by_range(simulator.make_ping(0, 3));
  EXPECT_GT(third[299] + third[300], 0);
}

// An interfering pulse travels one way: absorption and the elevation pattern (on reception) apply once.
TEST(InterferenceTest, IsAttenuatedOneWay) {
  Scenario scenario = beside_another();
  const double plain = total_db(ping_of(scenario, {}));
  scenario.water.absorption = true;
  scenario.water.absorption_db_per_m = 0.2;
  EXPECT_NEAR(total_db(ping_of(scenario, {})), plain - 6, 0.01);
  scenario.water.absorption = false;
  scenario.receiver.elevation_pattern = BeamPattern::kRectangular;
  scenario.sonars[0].elevation_aperture = 20 * kDegree;
  scenario.interferers[0].position = 30 * Vec3(std::cos(10 * kDegree), 0, std::sin(10 * kDegree));
  EXPECT_NEAR(total_db(ping_of(scenario, {})), plain - 10 * std::log10(2), 0.02);  // Half power, one way.
}

TEST(InterferenceTest, LongPulsesFillTheirBins) {
  Scenario scenario = beside_another();
  scenario.interferers[0].duration = 2e-3;  // 1.5 m of range.
  const std::vector<double> received = by_range(ping_of(scenario, {}));
  EXPECT_NEAR(std::ranges::count_if(received, [](double value) { return value > 0; }), 31, 1);
}

TEST(InterferenceTest, IsBlockedByWallsAndIsNoEcho) {
  Scenario scenario = beside_another();
  EXPECT_LT(total_db(ping_of(scenario, plate_at(20, 30, diffuse(-200)))), -180);
  scenario.ground_truth = GroundTruth::kFull;
  const Ping ping = ping_of(scenario, {});
  EXPECT_GT(std::ranges::max(ping.intensity), 0);
  EXPECT_EQ(std::ranges::max(ping.direct_intensity), 0);
  EXPECT_EQ(std::ranges::max(ping.path_order), 0);
}

}  // namespace
}  // namespace insonify::validation
