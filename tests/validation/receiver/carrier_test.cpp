// carrier_test.cpp -- correlation of the speckle of pings at different carrier frequencies.

#include <functional>

#include "validation/calibrated_scene.h"

namespace insonify::validation::carrier_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A fan of 100 degrees on a floor: bins of 60 mm, beams of 1.2 degrees.
Scenario floor_at(double frequency) {
  SonarConfig sonar;
  sonar.frequency = frequency;
  sonar.azimuth_aperture = 100 * kDegree;
  sonar.azimuth_resolution = 1.2 * kDegree;
  sonar.elevation_center = -16 * kDegree;
  sonar.min_range = 9;
  sonar.max_range = 33;
  sonar.bin_count = 400;
  sonar.position = {0.2, 3.1, -0.15};
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.sound_speed = 1480;
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  scenario.receiver.speckle = true;
  return scenario;
}

// Correlation of the intensities of two pings, each divided by its mean without speckle.
double correlation(Scenario one, Scenario other, const Material& material = diffuse(-20)) {
  const Scene scene = seabed_at(-4, material);
  const std::vector<float> a = ping_of(one, scene).intensity, b = ping_of(other, scene).intensity;
  one.receiver.speckle = other.receiver.speckle = false;
  const std::vector<float> mean_a = ping_of(one, scene).intensity, mean_b = ping_of(other, scene).intensity;
  double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 256 * 30; i < a.size() - 256 * 10; ++i) {
    if (i % 256 < 10 || i % 256 >= 246) {
      continue;
    }
    const double u = a[i] / mean_a[i], v = b[i] / mean_b[i];
    n += 1, x += u, y += v, xx += u * u, yy += v * v, xy += u * v;
  }
  return (n * xy - x * y) / std::sqrt((n * xx - x * x) * (n * yy - y * y));
}

// The scatterers of a resolution cell lie anywhere in the pulse: at two carriers f apart their phases differ by 4 pi f
// r / c, and the correlation of intensities is the square of the transform of the energy |p(r)|^2 (Goodman, Speckle
// Phenomena in Optics (2007), section 5.3): sinc^2(2 f L / c) for a bin of length L, (1 - f / B)^2 for a chirp, and for
// a matched tone of duration T, with a = 2 pi f T, (6 / a^2 (1 - sin(a) / a))^2. The simulation's bands of frequency
// differ from it by up to 0.06, 0.12 where a bin is as long as the resolution of a chirp.
TEST(CarrierTest, SpeckleOfTwoCarriersFollowsThePulse) {
  struct Case {
    PulseKind kind;
    double duration, bandwidth;
    std::function<double(double)> expected;
    double tolerance;
  };
  const auto sinc2 = [](double x) { return std::pow(std::sin(kPi * x) / (kPi * x), 2); };
  const auto tone = [](double a) { return std::pow(6 / (a * a) * (1 - std::sin(a) / a), 2); };
  const auto chirp = [](double x) { return x < 1 ? (1 - x) * (1 - x) : 0.0; };
  const Case cases[] = {
      {PulseKind::kNone, 1e-3, 1e3, [&](double f) { return sinc2(2 * f * 0.06 / 1480); }, 0.06},
      {PulseKind::kCw, 200e-6, 1e3, [&](double f) { return tone(2 * kPi * f * 200e-6); }, 0.06},
      {PulseKind::kLfm, 4e-3, 4e3, [&](double f) { return chirp(f / 4e3); }, 0.06},
      {PulseKind::kLfm, 4e-3, 12.333e3, [&](double f) { return chirp(f / 12.333e3); }, 0.13},
  };
  constexpr double kCarrier = 517e3, kStatistics = 0.02;
  for (const Case& c : cases) {
    const auto at = [&](double frequency) {
      Scenario scenario = floor_at(frequency);
      scenario.receiver.pulse = c.kind;
      scenario.receiver.pulse_duration = c.duration;
      scenario.receiver.pulse_bandwidth = c.bandwidth;
      return scenario;
    };
    // 12.333 kHz = c / (2 x 60 mm): phases of neighbouring bins then differ by whole turns.
    for (const double shift : {10.0, 1e3, 2e3, 3.1e3, 6e3, 9e3, 12.333e3, 18e3, 24.667e3, 50e3, 130e3}) {
      EXPECT_NEAR(correlation(at(kCarrier), at(kCarrier + shift)), c.expected(shift), c.tolerance + kStatistics)
          << static_cast<int>(c.kind) << ", " << c.bandwidth << ": " << shift;
    }
  }
}

// Where in the world the sonar is makes no difference: 150 m sideways as much as at the origin.
TEST(CarrierTest, DoesNotDependOnThePlaceInTheWorld) {
  for (const double sideways : {0.0, 17.0, -150.0}) {
    const auto at = [&](double frequency) {
      Scenario scenario = floor_at(frequency);
      scenario.sonars[0].position.y() = sideways;
      scenario.receiver.pulse = PulseKind::kCw;
      scenario.receiver.pulse_duration = 200e-6;
      return scenario;
    };
    // (6 / a^2 (1 - sin(a) / a))^2, a = 2 pi f T = 1.2566: 0.8514; up to 0.02 less by a metre sideways.
    EXPECT_NEAR(correlation(at(517e3), at(518e3)), 0.85, 0.05) << sideways;
  }
}

// Few scatterers in a cell have places in it, and phases with them.
TEST(CarrierTest, SparseScatterersChangeWithTheCarrierToo) {
  Material stones = diffuse(-20);
  stones.scatterer_density = 400;
  EXPECT_GT(correlation(floor_at(600e3), floor_at(600.2e3), stones), 0.95);
  EXPECT_NEAR(correlation(floor_at(600e3), floor_at(640e3), stones), 0, 0.1);
}

}  // namespace
}  // namespace insonify::validation::carrier_test
