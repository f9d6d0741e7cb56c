// point_test.cpp -- ideal points: position, level and occlusion; thermal noise and volume reverberation (T8,
// T9, T17, T23, T24 of docs/concepts/physics-tests.md).

#include "validation/calibrated_scene.h"

namespace insonify::validation::point_test {
namespace {

class PointTest : public testing::TestWithParam<Method> {};

Vec3 at(double range, double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kDegree, elevation = elevation_deg * kDegree;
  return range *
         Vec3(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
}

SonarConfig fan() {
  SonarConfig sonar;
  sonar.min_range = 0;
  sonar.max_range = 25;
  return sonar;
}

// Beam and bin of the strongest cell.
std::pair<int, int> peak(const Ping& ping) {
  const auto strongest = std::ranges::max_element(ping.intensity) - ping.intensity.begin();
  return {static_cast<int>(strongest % ping.beam_count), static_cast<int>(strongest / ping.beam_count)};
}

// Spreading has a pole at the sonar: what lies within a centimetre of it is left out.
TEST(PointTest, PointsAtTheSonarAreLeftOut) {
  Scenario scenario = calibrated(SonarConfig{}, kRays);
  scenario.sonars[0].min_range = 0;
  for (const double range : {0.0, 1e-30, 1e-6, 0.0099}) {
    scenario.points = {{.position = {range, 0, 0}, .target_strength_db = 0}};
    scenario.interferers = {{.position = {range, 0, 0}, .source_level_db = 200, .duration = 1e-3}};
    EXPECT_EQ(total_db(ping_of(scenario, {})), -std::numeric_limits<double>::infinity()) << range;
  }
  scenario.secondary = SecondaryEchoes::kSelective;
  scenario.surface.emplace();
  scenario.surface->level = 3;
  for (const double range : {0.0, 1e-30, 0.0099}) {
    scenario.points[0].position.x() = range;
    const Ping ping = ping_of(scenario, {});
    EXPECT_TRUE(std::ranges::all_of(ping.intensity, [](float value) { return std::isfinite(value); })) << range;
  }
  scenario.secondary = SecondaryEchoes::kNone;
  scenario.surface.reset();
  scenario.points[0].position.x() = 0.0101;
  EXPECT_NEAR(total_db(ping_of(scenario, {})), -40 * std::log10(0.0101), 0.01);
}

// T8.
TEST_P(PointTest, ShowsWhereItIsAtItsLevel) {
  for (const double azimuth : {-50.0, -30.0, 0.1, 25.3, 50.0}) {
    Scenario scenario = calibrated(fan(), GetParam());
    scenario.points = {{.position = at(15.02, azimuth, 3), .target_strength_db = -20}};
    const Ping ping = ping_of(scenario, {});
    const auto [beam, bin] = peak(ping);
    EXPECT_NEAR(fan().beam_azimuth(beam) / kDegree, azimuth, 0.5 * 120 / 256 + 1e-9);
    EXPECT_NEAR(fan().bin_range(bin), 15.02, 0.5 * fan().bin_length() + 1e-9);
    EXPECT_NEAR(total_db(ping), -20 - 40 * std::log10(15.02), 1e-4);
  }
}

// T17, without speckle.
TEST_P(PointTest, TwoAtEqualRangeAndAzimuthAreTwiceOne) {
  Scenario scenario = calibrated(fan(), GetParam());
  scenario.points = {{.position = at(10.01, 20, 8)}};
  const Ping one = ping_of(scenario, {});
  scenario.points.push_back({.position = at(10.01, 20, -8)});
  const Ping two = ping_of(scenario, {});
  EXPECT_EQ(peak(one), peak(two));
  EXPECT_NEAR(total_db(two) - total_db(one), 10 * std::log10(2), 0.02);
}

TEST_P(PointTest, NothingIsReceivedFromBehindAWallOrOutsideTheAperture) {
  Scenario scenario = calibrated(fan(), GetParam());
  scenario.points = {{.position = at(12, 0, 0)}};
  const Scene scene = plate_at(10, 1, diffuse(-200));
  EXPECT_LT(total_db(ping_of(scenario, scene)), -200);
  scenario.points = {{.position = at(9, 0, 0)}};
  EXPECT_GT(total_db(ping_of(scenario, scene)), -40);
  scenario.points = {{.position = at(9, 0, 11)}, {.position = at(9, 61, 0)}, {.position = at(26, 0, 0)}};
  EXPECT_LT(total_db(ping_of(scenario, scene)), -200);
}

TEST_P(PointTest, GainCompensatesItsRange) {
  for (const double range : {3.01, 21.01}) {
    Scenario scenario = calibrated(fan(), GetParam());
    scenario.water.absorption = true;
    scenario.receiver.time_varied_gain = 40;
    scenario.points = {{.position = at(range, 5, 0), .target_strength_db = -12}};
    EXPECT_NEAR(total_db(ping_of(scenario, {})), -12, 0.15) << range;  // Gain is that of the bin's middle.
  }
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, PointTest, testing::Values(kReference, kRays), kName);

// T23. Empty water: without noise nothing; with noise, thermal noise with exponentially distributed intensity and the
// mean level NL + 10 log10 B - DI - SL.
TEST(ThermalNoiseTest, HasItsLevelAndItsStatistics) {
  SonarConfig sonar = fan();
  sonar.frequency = 720e3;
  sonar.beam_count = 120;  // Beams of 1 x 20 degrees.
  sonar.source_level_db = 200;
  sonar.bandwidth = 25e3;
  Scenario scenario = calibrated(sonar, kRays);
  EXPECT_EQ(total_db(ping_of(scenario, {})), -std::numeric_limits<double>::infinity());

  scenario.receiver.noise = true;
  const Ping ping = ping_of(scenario, {});
  double sum = 0, squares = 0;
  for (const double value : ping.intensity) {
    sum += value;
    squares += value * value;
  }
  const double n = static_cast<double>(ping.intensity.size()), mean = sum / n;
  EXPECT_NEAR(10 * std::log10(mean), -147.04027, 10 * std::log10(1 + 4 / std::sqrt(n)));
  EXPECT_NEAR(std::sqrt(squares / n / (mean * mean) - 1), 1, 0.02);

  Scenario speckled = scenario;  // There is nothing that could have speckle.
  speckled.receiver.speckle = true;
  EXPECT_EQ(ping_of(speckled, {}).intensity, ping.intensity);

  scenario.receiver.ambient_noise_db = 55;
  const double thermal = std::pow(10.0, -147.04027 / 10), more = std::pow(10.0, (55 + 43.97940 - 33.14573 - 200) / 10);
  double loud = 0;
  for (const double value : ping_of(scenario, {}).intensity) {
    loud += value;
  }
  EXPECT_NEAR(10 * std::log10(loud / n / (thermal + more)), 0, 10 * std::log10(1 + 4 / std::sqrt(n)) + 0.01);
  scenario.receiver.ambient_noise_db.reset();

  Simulator simulator(scenario, {}, 2);
  EXPECT_EQ(simulator.make_ping(0, 0).intensity, ping.intensity);
  EXPECT_NE(simulator.make_ping(0, 1).intensity, ping.intensity);
}

// T24. Volume reverberation I = s_v Psi (1/r1 - 1/r2) falls by 20 dB per decade; behind a wall there is none.
TEST(VolumeReverberationTest, FallsWithTheSquareOfRange) {
  SonarConfig sonar;
  sonar.beam_count = 20;  // Beams of 1 x 20 degrees.
  sonar.azimuth_aperture = 20 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 25;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.volume_backscatter_db = -70;
  const Ping ping = ping_of(scenario, {});
  EXPECT_NEAR(cell_db(ping, 100, 7), -119.20713784852252, 0.01);
  EXPECT_NEAR(cell_db(ping, 200, 7), -125.20618464154067, 0.01);
  EXPECT_NEAR(cell_db(ping, 400, 7), -131.2159677501773, 0.01);

  const Ping walled = ping_of(scenario, plate_at(10, 20, diffuse(-200)));
  EXPECT_NEAR(cell_db(walled, 100, 7), cell_db(ping, 100, 7), 0.01);
  EXPECT_LT(cell_db(walled, 300, 7), -160);
  const int bin = 199;  // In the bin of the wall, half of the water is in front of it.
  EXPECT_GT(cell_db(walled, bin + 1, 10), -160);
  EXPECT_LT(cell_db(walled, bin + 1, 10), cell_db(ping, bin + 1, 10) - 1);

  // Up to the wall all is as without it, and behind it nothing is left but the rounding of solid angles.
  for (int b = 0; b <= bin; ++b) {
    EXPECT_EQ(walled.intensity[walled.index(b, 7)], ping.intensity[ping.index(b, 7)]) << b;
  }
  for (int b = bin + 8; b < ping.bin_count; ++b) {
    EXPECT_LT(walled.intensity[walled.index(b, 7)], 1e-6F * ping.intensity[ping.index(b, 7)]) << b;
  }

  // Nor is there any behind a wall that is nearer than the first bin.
  scenario.sonars[0].min_range = 3;
  const Ping near = ping_of(scenario, plate_at(2, 20, diffuse(-200)));
  EXPECT_LT(*std::ranges::max_element(near.intensity), 1e-6F * ping.intensity[ping.index(60, 7)]);  // At 3 m.
  scenario.sonars[0].min_range = 0;

  // A point target does not shadow the water behind it.
  scenario.points = {{.position = {5.02, 0.05, 0}, .target_strength_db = -150}};
  const Ping pointed = ping_of(scenario, {});
  EXPECT_EQ(cell_db(pointed, 300, 9), cell_db(ping, 300, 9));

  // A wrong assumed sound speed shifts the ranges of bins; the echo of the water at the true range is unchanged.
  scenario.points.clear();
  scenario.water.sound_speed = 1500;
  scenario.sonars[0].assumed_sound_speed = 1600;
  scenario.sonars[0].steering = Steering::kLens;  // A line's beams would be narrower.
  const double true_range = 15.025 * 1500 / 1600;
  EXPECT_NEAR(cell_db(ping_of(scenario, {}), 300, 7),
              cell_db(ping, 300, 7) + 20 * std::log10(15.025 / true_range) + 10 * std::log10(1500.0 / 1600), 0.01);
}

}  // namespace
}  // namespace insonify::validation::point_test
