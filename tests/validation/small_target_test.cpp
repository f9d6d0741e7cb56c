// small_target_test.cpp -- targets whose surface turns far from sample to sample, at the default sampling: the level of
// every single ping, wherever the target lies among the samples, against integrals of the scattering law over the
// surface. All numbers were derived independently of this code.

#include <string_view>

#include "validation/small_targets.h"

namespace insonify::validation::small_target_test {
namespace {

// Part of a Gemini 720i with its default sample spacing: 0.117 degrees from column to column, 0.1 from row to row.
SonarConfig small_sonar(double max_range) {
  SonarConfig sonar;
  sonar.beam_count = 16;
  sonar.azimuth_aperture = 7.5 * kDegree;
  sonar.elevation_aperture = 6 * kDegree;
  sonar.min_range = 1;
  sonar.max_range = max_range;
  sonar.bin_count = 1000;
  sonar.sampling = {4, 60};
  return sonar;
}

// Offsets across the axis, in steps of 3 cm in one direction and of 1.1 cm in the other.
Vec3 offset_of(int place) {
  return {0, 0.03 * (place - 12), 0.011 * (place * 7 % kPlaces - 12)};
}

Levels levels_of(const Scenario& scenario, const Scene& scene, const std::function<double(const Ping&)>& intensity_of) {
  return validation::levels_of(scenario, scene, 1, offset_of, intensity_of);
}

Material shiny(double slope, double lambert_db = -200) {
  Material material = glinting(kReflection, slope);
  material.lambert_db = lambert_db;
  return material;
}

// Echo, by quadrature, of the side of a cylinder whose axis passes through the axis of the sonar at `distance` and is
// tilted by `tilt` towards it, and of the end that faces the sonar.
double cylinder_intensity(double radius, double length, double distance, double tilt, double slope, double lambert_db) {
  constexpr int kAround = 400, kAlong = 200;  // Ten times as many each change the level by less than 1e-4 dB.
  const Vec3 axis(-std::sin(tilt), 0, std::cos(tilt)), out(-std::cos(tilt), 0, -std::sin(tilt)), side(0, 1, 0);
  double sum = 0;
  for (int i = 0; i < kAround; ++i) {
    const double angle = kPi * ((i + 0.5) / kAround - 0.5);
    const Vec3 normal = out * std::cos(angle) + side * std::sin(angle);
    for (int j = 0; j < kAlong; ++j) {
      const Vec3 place = Vec3(distance, 0, 0) + radius * normal + axis * (length * ((j + 0.5) / kAlong - 0.5));
      const double range = place.norm();
      sum += backscatter(-normal.dot(place) / range, slope, std::pow(10, lambert_db / 10)) / std::pow(range, 4);
    }
  }
  const double end = kPi * radius * radius * backscatter(std::sin(tilt), slope, std::pow(10, lambert_db / 10));
  return sum * kPi / kAround * radius * length / kAlong + end / std::pow(distance, 4);
}

class SmallTargetTest : public testing::TestWithParam<Method> {};
class SmallTargetEffectTest : public testing::TestWithParam<Method> {};

// The quadrature itself: |R|^2 a^2 / 4 for facets of slope 0.02 seen from far away, and for a long cylinder
// |R|^2 a r / (4 (a + r)) times r, both with the square of the range that is left.
TEST(SmallTargetQuadratureTest, HasTheLimitsOfGeometricalOptics) {
  const double far = 1000, a = 0.3;
  EXPECT_NEAR(ball_intensity(a, far, 0.02, -200) * std::pow(far, 4) / (0.81 * a * a / 4), 1, 0.002);
  const double r = 10 - a;
  EXPECT_NEAR(cylinder_intensity(a, 4, 10, 0, 0.02, -200) * std::pow(r, 4) / (0.81 * a * r * r / (4 * (a + r))), 1,
              0.003);
}

struct Ball {
  double radius, distance, slope, lambert_db;
};

// The normal of the last three turns by 28 degrees from sample to sample.
TEST_P(SmallTargetTest, BallsHaveTheirTargetStrengthInEveryPing) {
  for (const Ball& ball :
       {Ball{0.15, 25, 0.05, -30}, Ball{0.4, 25, 0.02, -40}, Ball{0.4, 60, 0.05, -30}, Ball{0.15, 9, 0.1, -20},
        Ball{0.05, 12, 0.05, -30}, Ball{0.15, 34, 0.06, -25}, Ball{0.11, 25, 0.04, -32}}) {
    const Levels levels =
        levels_of(calibrated(small_sonar(ball.distance + 5), GetParam()),
                  sphere_at({ball.distance, 0, 0}, ball.radius, shiny(ball.slope, ball.lambert_db), 0.12), whole);
    const double expected = 10 * std::log10(ball_intensity(ball.radius, ball.distance, ball.slope, ball.lambert_db));
    EXPECT_NEAR(levels.mean_db, expected, kMeanTolerance) << ball.radius << " m at " << ball.distance;
    EXPECT_LE(levels.spread_db, kMostSpread) << ball.radius << " m at " << ball.distance;
  }
}

struct Pole {
  double radius, length, distance, tilt_deg, slope, lambert_db;
  bool lying = false;
};

// Upright and lying, square to the sound and tilted. The aperture is 2.6 m high at 25 m.
TEST_P(SmallTargetTest, PolesHaveTheirTargetStrengthInEveryPing) {
  for (const Pole& pole :
       {Pole{0.15, 1.2, 25, 0, 0.05, -30}, Pole{0.15, 1.2, 25, 4, 0.1, -30}, Pole{0.4, 1.8, 25, 0, 0.03, -35},
        Pole{0.05, 0.5, 9, 0, 0.05, -30}, Pole{0.15, 1.2, 25, 0, 0.05, -30, true}, Pole{0.12, 1, 25, 30, 0.1, -15}}) {
    Scene scene = scene_of(make_cylinder(pole.radius, pole.length, 0.12), shiny(pole.slope, pole.lambert_db),
                           {.position = {pole.distance, 0, 0},
                            .orientation = orientation_from_rpy(pole.lying ? kPi / 2 : 0, 0, 0) *
                                           orientation_from_rpy(0, -pole.tilt_deg * kDegree, 0)});
    const Levels levels = levels_of(calibrated(small_sonar(pole.distance + 5), GetParam()), scene, whole);
    const double expected = 10 * std::log10(cylinder_intensity(pole.radius, pole.length, pole.distance,
                                                               pole.tilt_deg * kDegree, pole.slope, pole.lambert_db));
    EXPECT_NEAR(levels.mean_db, expected, kMeanTolerance) << pole.radius << " m at " << pole.distance;
    EXPECT_LE(levels.spread_db, kMostSpread) << pole.radius << " m at " << pole.distance;
  }
}

// With absorption, bins shorter and longer than the ball is deep, and from the side.
TEST_P(SmallTargetTest, BallsAreSteadyWhateverTheBins) {
  for (const int bins : {37, 4000}) {
    SonarConfig sonar = small_sonar(31);
    sonar.bin_count = bins;
    Scenario scenario = calibrated(sonar, GetParam());
    scenario.water.absorption = true;  // 10 degC, 35 PSU, pH 8, 720 kHz: 0.223461 dB/m.
    scenario.sonars[0].frequency = 720e3;
    const Levels levels = levels_of(scenario, sphere_at({24.3, 0.6, 0.1}, 0.17, shiny(0.05), 0.12), whole);
    const double range = std::sqrt(24.3 * 24.3 + 0.6 * 0.6 + 0.1 * 0.1);
    EXPECT_NEAR(levels.mean_db,
                10 * std::log10(ball_intensity(0.17, range, 0.05, -200)) - 2 * 0.223461 * (range - 0.17),
                kMeanTolerance);
    EXPECT_LE(levels.spread_db, kMostSpread) << bins;
  }
}

// With an array in both directions, on cones: the loudest cell follows the ball. A beam of a Taylor array falls by
// 1.3 dB half-way to the next of 0.469 degrees, and bins by less with a pulse of two bins.
TEST_P(SmallTargetEffectTest, BallsAreSteadyThroughAnArray) {
  for (const BeamShape shape : {BeamShape::kWedge, BeamShape::kCone}) {
    SonarConfig sonar = small_sonar(30);
    Scenario scenario = calibrated(sonar, GetParam());
    scenario.receiver.azimuth_pattern = BeamPattern::kTaylor;
    scenario.receiver.beam_shape = shape;
    const Levels levels = levels_of(scenario, sphere_at({25, 0, 0}, 0.15, shiny(0.05, -30), 0.12), whole);
    EXPECT_LE(levels.spread_db, kMostSpread);
  }
}

// Speckle keeps the mean: over 200 seeds it is known to 1 / sqrt(200), 0.3 dB.
TEST_P(SmallTargetEffectTest, SpeckleKeepsTheMean) {
  Scenario scenario = calibrated(small_sonar(30), GetParam());
  const Scene scene = sphere_at({25, 0.013, 0.022}, 0.15, shiny(0.05, -30), 0.12);
  scenario.receiver.speckle = true;
  double sum = 0;
  constexpr int kSeeds = 200;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    scenario.seed = static_cast<std::uint64_t>(seed);
    sum += whole(ping_of(scenario, scene));
  }
  EXPECT_NEAR(10 * std::log10(sum / kSeeds), 10 * std::log10(ball_intensity(0.15, 25, 0.05, -30)), 1.2);
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
// A ball three columns wide: columns are 0.234 degrees apart by default, 57 mm at 14 m, and normals are compared in
// strips of four, so that at some places one column of the ball is alone in its strip. 36 places over the 0.23 m of a
// strip.
TEST_P(SmallTargetTest, BallsOfThreeColumnsAreSteadyAtTheDefaultSampling) {
  constexpr double kRadius = 0.08, kDistance = 14, kSlope = 0.05, kLambertDb = -28;
  SonarConfig sonar = small_sonar(16);
  sonar.sampling = {};
  sonar.bin_count = 256;
  Simulator simulator(calibrated(sonar, GetParam()), sphere_at({kDistance, 0, 0}, kRadius, shiny(kSlope, kLambertDb)),
                      2);
  const double expected = 10 * std::log10(ball_intensity(kRadius, kDistance, kSlope, kLambertDb));
  const int step = std::string_view(GetParam().engine) == "reference" ? 12 : 1;  // Slow.
  for (int place = 0; place < 36; place += step) {
    PingRequest request;
    request.world_from_vehicle.position.y() = 0.0064 * place;
    Ping ping;
    simulator.ping(0, request, ping);
    EXPECT_NEAR(10 * std::log10(whole(ping)), expected, 1.5) << place;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, SmallTargetTest, testing::Values(kReference, kRays, kRaster), kName);
INSTANTIATE_TEST_SUITE_P(Methods, SmallTargetEffectTest, testing::Values(kRays), kName);

}  // namespace
}  // namespace insonify::validation::small_target_test
