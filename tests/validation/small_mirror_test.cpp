// small_mirror_test.cpp -- echoes by way of a plate that is smaller than a Fresnel zone.

#include <complex>

#include "validation/secondary_grid.h"

namespace insonify::validation::small_mirror_test {
namespace {

constexpr double kNear = 10, kAcross = 5, kTarget = 0.05, kWavelength = 1500 / 720e3;

struct Levels {
  double once = 0, twice = 0;  // Energies of the echoes by the mirror one way and both ways.
};

// A square plate 10 m ahead, turned by 45 degrees, sends sound up to a diffuse ball 5 m above it.
Levels levels_by(const Method& method, double side) {
  const Scene plate = scene_of(make_plane(-Vec3::UnitX(), side, side), glinting(1, 0.05),
                               {.position = {kNear, 0, 0}, .orientation = orientation_from_rpy(0, 45 * kDegree, 0)});
  const Scene scene = scene_of_all({plate, sphere_at({kNear, 0, kAcross}, kTarget, diffuse(-10), 0.1)});
  SonarConfig sonar;
  sonar.beam_count = 10;
  sonar.azimuth_aperture = 3 * kDegree;
  sonar.elevation_center = 13 * kDegree;
  sonar.elevation_aperture = 30 * kDegree;
  sonar.min_range = 5;
  sonar.max_range = 25;
  sonar.bin_count = 200;
  sonar.sampling = {40, 4000};
  const EchoGrid grid = secondary_grid(method, scene, sonar, {});
  Levels levels;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    for (int bin = 0; bin < sonar.bin_count; ++bin) {
      levels.once += grid.energy(2, beam)[bin];
      levels.twice += grid.energy(3, beam)[bin];
    }
  }
  return levels;
}

// The integral of exp(i pi t^2/2) from 0 to x, by Simpson's rule.
std::complex<double> fresnel(double x) {
  constexpr int kSteps = 2000;
  std::complex<double> sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = x * i / kSteps, weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * std::polar(1.0, 0.5 * 3.14159265358979 * t * t);
  }
  return sum * x / (3.0 * kSteps);
}

// Intensity from the plate at a distance across from the mirror's direction, re an infinite mirror, for one of its
// sides as the sound sees it: a window that diverges from the sonar, convolved with a Gaussian beam.
double sent(double side, double place) {
  const double half = 0.5 * side * (1 + kAcross / kNear);
  const double scale = 1 / (std::sqrt(2) * kWavelength / (std::sqrt(2 * 3.14159265358979) * side) * kAcross);
  return 0.5 * (std::erf((half + place) * scale) + std::erf((half - place) * scale));
}

// The same on the way back: Fresnel's integrals about the point of reflection.
double returned(double side, double place) {
  const double rho = kNear * kAcross / (kNear + kAcross), zone = std::sqrt(2 / (kWavelength * rho));
  const double at = place * kNear / (kNear + kAcross);
  return 0.5 * std::norm(fresnel((0.5 * side - at) * zone) + fresnel((0.5 * side + at) * zone));
}

// Mean over the ball's disc, which Lambert's law weights with the cosine.
template <typename Value>
double over_the_ball(const Value& value) {
  double sum = 0, weights = 0;
  constexpr int kSteps = 20;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      const double y = kTarget * i / kSteps, z = kTarget * j / kSteps;
      const double rest = 1 - (y * y + z * z) / (kTarget * kTarget);
      if (rest > 0) {
        sum += std::sqrt(rest) * value(y, z);
        weights += std::sqrt(rest);
      }
    }
  }
  return sum / weights;
}

class SmallMirrorTest : public testing::TestWithParam<Method> {};

// Plates of 0.3 to 2 Fresnel zones: 0.3 to 14 dB below an infinite mirror on the way out, and as much again back.
TEST_P(SmallMirrorTest, HasTheEchoesOfFresnelsIntegrals) {
  const Levels infinite = levels_by(GetParam(), 6);
  for (const double side : {0.04, 0.07, 0.15}) {
    const Levels small = levels_by(GetParam(), side);
    const double upright = side * std::cos(45 * kDegree);  // Its other side as the sound sees it.
    const double once = over_the_ball([&](double y, double z) { return sent(side, y) * sent(upright, z); });
    const double twice = over_the_ball([&](double y, double z) {
      return sent(side, y) * sent(upright, z) * returned(side, y) * returned(upright, z);
    });
    EXPECT_NEAR(10 * std::log10(small.once / infinite.once), 10 * std::log10(once), 0.8) << side;
    EXPECT_NEAR(10 * std::log10(small.twice / infinite.twice), 10 * std::log10(twice), 1) << side;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, SmallMirrorTest, testing::Values(kRays, kRaster),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace insonify::validation::small_mirror_test
