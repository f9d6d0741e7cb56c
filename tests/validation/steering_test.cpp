// steering_test.cpp -- bearings of a sonar that assumes a wrong sound speed: sin(shown) = sin(true) c_assumed / c_true.

#include "insonify/error.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::steering_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

SonarConfig fan(double assumed) {
  SonarConfig sonar;
  sonar.beam_count = 300;
  sonar.azimuth_aperture = 150 * kDegree;
  sonar.azimuth_resolution = 1 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 25;
  sonar.sampling = {2, 60};
  sonar.assumed_sound_speed = assumed;
  return sonar;
}

// Bearing at which a ping has most energy, between beams by a parabola in decibels [deg].
double loudest_deg(const Ping& ping, const SonarConfig& sonar) {
  std::vector<double> beams(ping.beam_count, 1e-30);
  for (std::size_t at = 0; at < ping.intensity.size(); ++at) {
    beams[at % ping.beam_count] += ping.intensity[at];
  }
  const auto top = static_cast<int>(std::ranges::max_element(beams) - beams.begin());
  const auto level = [&](int beam) { return std::log(beams[beam]); };
  const double shift = 0.5 * (level(top - 1) - level(top + 1)) / (level(top - 1) - 2 * level(top) + level(top + 1));
  return (sonar.beam_azimuth(top) - shift * sonar.azimuth_aperture / sonar.beam_count) / kDegree;
}

// True bearing, true and assumed speed, and the bearing that is shown.
struct Case {
  double bearing, true_speed, assumed, shown;
};
// asin(sin 50 x 1500 / 1426.5), asin(sin 50 x 1500 / 1550), asin(sin 33 x 1540 / 1460), asin(-sin 61 x 1450 / 1500).
constexpr Case kCases[] = {{50, 1426.5, 1500, 53.6600},
                           {50, 1550, 1500, 47.8451},
                           {33, 1460, 1540, 35.0634},
                           {-61, 1500, 1450, -57.7219},
                           {20, 1490, 1490, 20}};

TEST(SteeringTest, AssumedSpeedShiftsBearingsByTheRatioOfSines) {
  for (const Method& method : {kRays, kReference}) {
    for (const Case& c : kCases) {
      for (const bool speckle : {false, true}) {
        Scenario scenario = calibrated(fan(c.assumed), method);
        scenario.water.sound_speed = c.true_speed;
        scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
        scenario.receiver.speckle = speckle;
        scenario.receiver.pulse = PulseKind::kCw;
        scenario.receiver.pulse_duration = 100e-6;
        const double azimuth = c.bearing * kDegree;
        scenario.points = {{.position = 12 * Vec3(std::cos(azimuth), std::sin(azimuth), 0)}};
        const Ping ping = ping_of(scenario, {});
        EXPECT_NEAR(loudest_deg(ping, scenario.sonars[0]), c.shown, 0.05) << c.bearing << ", " << c.true_speed;
      }
    }
  }
}

// Every beam has the array's pattern in the sine of its true bearing.
TEST(SteeringTest, EveryBeamHasItsPatternAboutItsTrueBearing) {
  Scenario scenario = calibrated(fan(1500), kRays);
  scenario.water.sound_speed = 1426.5;
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  const double azimuth = -38.4 * kDegree, length = 0.8858929413781328 / (2 * std::sin(0.5 * kDegree));
  const double range = 12.3;
  scenario.points = {{.position = range * Vec3(std::cos(azimuth), std::sin(azimuth), 0)}};
  const Ping ping = ping_of(scenario, {});
  const int bin = static_cast<int>(range * 1500 / 1426.5 / 0.05);
  for (int beam = 0; beam < 300; ++beam) {
    const double u = std::sin(scenario.sonars[0].beam_azimuth(beam)) * 1426.5 / 1500;
    const double x = kPi * length * (std::sin(azimuth) - u), expected = 20 * std::log10(std::abs(std::sin(x) / x));
    if (expected > -35) {
      EXPECT_NEAR(cell_db(ping, bin, beam) + 40 * std::log10(range), expected, 0.01) << beam;
    }
  }
}

// Ground truth shows a plate where its echo is, also with top-hat beams; a lens shows it where it is.
TEST(SteeringTest, GroundTruthFollows) {
  for (const BeamPattern pattern : {BeamPattern::kTopHat, BeamPattern::kTaylor}) {
    for (const Steering steering : {Steering::kElectronic, Steering::kLens}) {
      for (const GroundTruth truth : {GroundTruth::kLabels, GroundTruth::kFull}) {
        Scenario scenario = calibrated(fan(1500), kRays);
        scenario.water.sound_speed = 1426.5;
        scenario.sonars[0].steering = steering;
        scenario.ground_truth = truth;
        scenario.receiver.azimuth_pattern = pattern;
        Scene plate = plate_at(10, 0.8, diffuse(-20));
        const double azimuth = 50 * kDegree;
        plate.instances[0].world_from_mesh = {.position = 10 * Vec3(std::cos(azimuth), std::sin(azimuth), 0),
                                              .orientation = orientation_from_rpy(0, 0, azimuth)};
        const Ping ping = ping_of(scenario, plate);
        double sum = 0, count = 0;
        for (std::size_t at = 0; at < ping.instance.size(); ++at) {
          if (ping.instance[at] != kNoLabel) {
            sum += scenario.sonars[0].beam_azimuth(static_cast<int>(at % 300)) / kDegree, ++count;
          }
        }
        // The plate covers 50 +- 2.29 deg; the mean of what is shown of its edges, 51.0654 and 56.2922, is 53.68.
        const double expected = steering == Steering::kLens ? 50 : 53.68;
        EXPECT_NEAR(sum / count, expected, 0.15) << static_cast<int>(pattern);
        EXPECT_NEAR(loudest_deg(ping, scenario.sonars[0]), expected, 2.7);
      }
    }
  }
}

// A head shows bearings by its turn.
TEST(SteeringTest, HeadsTurnWhateverTheSpeed) {
  for (const double assumed : {1400.0, 1500.0, 1600.0}) {
    SonarConfig head;
    head.type = SonarType::kMechanicallyScanned;
    head.beam_count = 1;
    head.azimuth_aperture = 3 * kDegree;
    head.min_range = 0;
    head.max_range = 25;
    head.head.step = 10 * kDegree;
    head.assumed_sound_speed = assumed;
    Scenario scenario = calibrated(head, kRays);
    scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
    scenario.points = {{.position = 12 * Vec3(std::cos(50 * kDegree), std::sin(50 * kDegree), 0)}};
    Simulator simulator(scenario, {}, 2);
    EXPECT_NEAR(total_db(simulator.make_ping(0, 5)), -40 * std::log10(12), 0.1) << assumed;
    EXPECT_LT(total_db(simulator.make_ping(0, 4)), -60) << assumed;
  }
}

TEST(SteeringTest, RefusesBeamsThatCannotBeSteered) {
  Scenario scenario = calibrated(fan(1400), kRays);
  scenario.water.sound_speed = 1500;
  try {
    scenario.validate();
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "sonars[0].assumed_sound_speed = 1400 m/s cannot steer beam 0 to 74.75 deg in water of 1500 m/s: there "
        "its sine would be 1.034");
  }
  scenario.sonars[0].steering = Steering::kLens;
  scenario.validate();
  scenario.sonars[0].steering = Steering::kElectronic;
  scenario.model = EchoModel::kPaper;
  scenario.validate();
}

}  // namespace
}  // namespace insonify::validation::steering_test
