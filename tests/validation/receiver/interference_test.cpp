// interference_test.cpp -- range, bearing and level of pulses received from another sonar.

#include "validation/calibrated_scene.h"

namespace insonify::validation::interference_test {
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

// The pulse is as long as it was sent, whatever this sonar's own matched filter: all bins of it have its level, in the
// beam that points at it, and those before and after it nothing.
TEST(InterferenceTest, HasItsLevelBesideAnyPulse) {
  Scenario scenario = beside_another();
  scenario.interferers[0].duration = 2e-3;
  scenario.receiver.azimuth_pattern = BeamPattern::kTaylor;
  for (const PulseKind kind : {PulseKind::kNone, PulseKind::kCw, PulseKind::kLfm}) {
    for (const bool speckle : {false, true}) {
      scenario.receiver.pulse = kind;  // A tone of six bins, a chirp of two and a half.
      scenario.receiver.pulse_duration = 400e-6;
      scenario.receiver.pulse_bandwidth = 25e3;
      scenario.receiver.speckle = speckle;
      const Ping ping = ping_of(scenario, {});
      for (const int bin : {451, 460, 478}) {
        EXPECT_NEAR(cell_db(ping, bin, 39), 190 - 200 - 20 * std::log10(30), 0.01) << bin;
      }
      EXPECT_EQ(by_range(ping)[448], 0);
      EXPECT_EQ(by_range(ping)[483], 0);
    }
  }
}

// A head receives it one way: sinc^2 of x = (D / wavelength) sin(azimuth), -3.01 dB at half its width.
TEST(InterferenceTest, ScanningHeadsReceiveItOneWay) {
  Scenario scenario = beside_another();
  SonarConfig& head = scenario.sonars[0];
  head.type = SonarType::kMechanicallyScanned;
  head.beam_count = 1;
  head.azimuth_aperture = 3 * kDegree;
  head.max_range = 26;  // One bin of the pulse.
  head.bin_count = 50;
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  const double lines = 0.8858929413781328 / (2 * std::sin(1.5 * kDegree)), pi = std::acos(-1.0);
  for (const double azimuth : {1.5, 4.1, 9.0, 25.0}) {
    scenario.interferers[0].position = 30 * Vec3(std::cos(azimuth * kDegree), std::sin(azimuth * kDegree), 0);
    const double x = pi * lines * std::sin(azimuth * kDegree);
    EXPECT_NEAR(total_db(ping_of(scenario, {})), -10 - 20 * std::log10(30) + 20 * std::log10(std::abs(std::sin(x) / x)),
                0.02)
        << azimuth;
  }
}

// The outermost beam hears beside the fan by its side lobes, 20 degrees beside it sinc^2 of (D / wavelength) (sin(80) -
// sin(59.5)) = 50.76 (0.98481 - 0.86163) = 6.2525. Without an array it hears nothing, nor from behind.
TEST(InterferenceTest, IsHeardBesideTheFan) {
  Scenario scenario = beside_another();
  scenario.sonars[0].azimuth_resolution = 1 * kDegree;
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  const double pi = std::acos(-1.0), lines = 0.8858929413781328 / (2 * std::sin(0.5 * kDegree));
  const double x = pi * lines * (std::sin(80 * kDegree) - std::sin(59.5 * kDegree));
  scenario.interferers[0].position = 30 * Vec3(std::cos(80 * kDegree), std::sin(80 * kDegree), 0);
  const double lobe = 20 * std::log10(std::abs(std::sin(x) / x));
  EXPECT_NEAR(cell_db(ping_of(scenario, {}), 450, 0), -10 - 20 * std::log10(30) + lobe, 0.02);
  scenario.motion_in_ping = true;  // The sonar stands still, so that it makes no difference.
  EXPECT_NEAR(cell_db(ping_of(scenario, {}), 450, 0), -10 - 20 * std::log10(30) + lobe, 0.02);
  scenario.motion_in_ping = false;
  scenario.interferers[0].position.x() *= -1;
  EXPECT_EQ(total_db(ping_of(scenario, {})), -std::numeric_limits<double>::infinity());
  scenario.interferers[0].position.x() *= -1;
  scenario.receiver.azimuth_pattern = BeamPattern::kTopHat;
  EXPECT_EQ(total_db(ping_of(scenario, {})), -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace insonify::validation::interference_test
