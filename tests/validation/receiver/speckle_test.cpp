// speckle_test.cpp -- distribution and correlation of speckle, and its dependence on motion (T11, T12, T13, T17 of
// docs/concepts/physics-tests.md).

#include <complex>
#include <functional>

#include "validation/calibrated_scene.h"

namespace insonify::validation::speckle_test {
namespace {

// Speckle of a diffuse seabed: intensity divided by the intensity without speckle.
class SpeckleTest : public testing::Test {
 protected:
  static SonarConfig fan() {
    SonarConfig sonar;
    sonar.azimuth_resolution = 1 * kDegree;
    sonar.min_range = 8;
    sonar.max_range = 30;
    sonar.elevation_center = -15 * kDegree;
    return sonar;
  }
  static Scenario scenario_of(const SonarConfig& sonar) {
    Scenario scenario = calibrated(sonar, kRays);
    scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
    scenario.receiver.speckle = true;
    return scenario;
  }
  static Scenario scenario_at(const Vec3& position, double yaw = 0) {
    SonarConfig sonar = fan();
    sonar.position = position;
    sonar.orientation = {0, 0, yaw};
    return scenario_of(sonar);
  }

  // Intensity over mean intensity, [bin][beam]; 0 where there is no echo.
  static std::vector<float> speckle_of(Scenario scenario, const Material& material = diffuse(-20)) {
    const Scene scene = seabed_at(-3, material);
    std::vector<float> received = ping_of(scenario, scene).intensity;
    scenario.receiver.speckle = false;
    const std::vector<float> mean = ping_of(scenario, scene).intensity;
    for (std::size_t i = 0; i < received.size(); ++i) {
      received[i] = mean[i] > 0 ? received[i] / mean[i] : 0;
    }
    return received;
  }
};

constexpr int kBins = 500, kBeams = 256;

// Correlation between the cells (bin, beam) of one table and (bin + bins, beam + beams) of the other, over the cells
// for which `counts` is true.
double correlation(
    const std::vector<float>& one, const std::vector<float>& other, int bins = 0, int beams = 0,
    const std::function<bool(int bin, int beam)>& counts = [](int, int) { return true; }) {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (int bin = 20; bin < kBins - 20; ++bin) {
    for (int beam = 10; beam < kBeams - 10; ++beam) {
      if (counts(bin, beam)) {
        const double x = one[bin * kBeams + beam], y = other[(bin + bins) * kBeams + beam + beams];
        n += 1, a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
      }
    }
  }
  return (n * ab - a * b) / std::sqrt((n * aa - a * a) * (n * bb - b * b));
}

// T11.
TEST_F(SpeckleTest, IntensityIsExponentialAndNeighbouringBeamsCorrelate) {
  const std::vector<float> speckle = speckle_of(scenario_at({0, 0, 0}));
  double n = 0, sum = 0, squares = 0, amplitudes = 0;
  for (int bin = 50; bin < 500; ++bin) {
    for (int beam = 20; beam < 236; ++beam) {
      const double value = speckle[bin * kBeams + beam];
      n += 1, sum += value, squares += value * value, amplitudes += std::sqrt(value);
    }
  }
  const double independent = 0.415 * n;  // Beams overlap.
  EXPECT_NEAR(sum / n, 1, 4 / std::sqrt(independent));
  EXPECT_NEAR(std::sqrt(squares / n / std::pow(sum / n, 2) - 1), 1, 0.028);
  EXPECT_NEAR(std::sqrt(sum / n / std::pow(amplitudes / n, 2) - 1), 0.5227232008770634, 0.0105);
  // Straight ahead it is 0.5465. Beams are evenly spaced in angle, so at the sides they are closer together in u.
  EXPECT_NEAR(correlation(speckle, speckle, 0, 1), 0.60, 0.07);
  EXPECT_NEAR(correlation(speckle, speckle, 1, 0), 0, 0.02);
}

// T13 with all features of the calibrated model.
TEST_F(SpeckleTest, PingsDoNotDependOnThreads) {
  Scenario scenario = scenario_at({0, 0, 0});
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.surface = SeaSurface{.level = 6};
  scenario.receiver.noise = true;
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_duration = 1e-3;
  scenario.water.volume_backscatter_db = -70;
  Scene scene = sphere_at({14, 2, -1}, 2, glinting(0.8, 0.2));
  Scene bed = seabed_at(-3, diffuse(-20));
  bed.instances[0].materials.assign(bed.instances[0].materials.size(), 1);
  scene.materials.push_back(bed.materials[0]);
  scene.instances.push_back(bed.instances[0]);
  const Ping one = Simulator(scenario, scene, 1).make_ping(0, 2);
  for (const int threads : {2, 5, 16}) {
    EXPECT_EQ(Simulator(scenario, scene, threads).make_ping(0, 2).intensity, one.intensity) << threads;
  }
}

// T12.
TEST_F(SpeckleTest, IsTheSameWhileNothingMoves) {
  Simulator simulator(scenario_at({1, 2, 0}), seabed_at(-3, diffuse(-20)), 2);
  EXPECT_EQ(simulator.make_ping(0, 0).intensity, simulator.make_ping(0, 7).intensity);

  Scenario other = scenario_at({1, 2, 0});
  other.seed = 2;
  EXPECT_NEAR(correlation(speckle_of(scenario_at({1, 2, 0})), speckle_of(other)), 0, 0.02);
}

// T12. Moving an array of length D sideways by d leaves a correlation of (1 - 2 d / D)^2 (docs/concepts/speckle.md). At
// the sides of the fan the motion is also a shift in range.
TEST_F(SpeckleTest, DecorrelatesAsTheArrayMovesSideways) {
  Scenario scenario = scenario_at({0, 0, 0});
  const double wavelength = scenario.water.true_sound_speed() / fan().frequency;
  const double length = 0.8858929413781328 * wavelength / (2 * std::sin(0.5 * kDegree));
  for (const Vec3& start : {Vec3(0, 0, 0), Vec3(5.2, -3.1, 0.1), Vec3(0.3, 0.45, 0)}) {
    const std::vector<float> first = speckle_of(scenario_at(start));
    for (const auto& [share, expected] : {std::pair{0.02, 0.9216}, {0.1, 0.64}, {0.25, 0.25}, {0.5, 0.0}}) {
      const std::vector<float> later = speckle_of(scenario_at(start + Vec3(0, share * length, 0)));
      const auto ahead = [](int, int beam) { return std::abs(beam - 127.5) < 25; };
      EXPECT_NEAR(correlation(first, later, 0, 0, ahead), expected, 0.05) << start.transpose() << ": " << share;
      EXPECT_NEAR(correlation(first, later), 0.9 * expected, 0.08) << start.transpose() << ": " << share;
    }
  }
}

// Moving ahead by five bins shifts the speckle of distant cells straight ahead by five bins. The integral over the bed
// (SpeckleMotionTest) has a correlation of 0.77 here: the range of a point on the bed changes by 1 % less than the
// step, and that of a point 2.5 degrees aside by another 0.1 %, which turns its phase by 0.2. Bins without a pulse
// differ from it by up to 1/16; the estimate from 1100 independent cells has a standard deviation of 0.02.
TEST_F(SpeckleTest, MovesByBinsAsTheSonarApproaches) {
  const double step = 5 * fan().bin_length();
  double sum = 0;
  constexpr int kPlaces = 6;
  for (int place = 0; place < kPlaces; ++place) {
    const Vec3 start(0.317 * place, 1.173 * place + 0.113, 0);
    const std::vector<float> first = speckle_of(scenario_at(start));
    const std::vector<float> later = speckle_of(scenario_at(start + Vec3(step, 0, 0)));
    const auto ahead = [](int bin, int beam) { return bin > 250 && std::abs(beam - 127.5) < 6; };
    sum += correlation(first, later, -5, 0, ahead);
    EXPECT_LT(correlation(first, later, 0, 0, ahead), 0.1);
  }
  EXPECT_NEAR(sum / kPlaces, 0.77, 1.0 / 16 + 4 * 0.02 / std::sqrt(kPlaces));
}

// The phase of cells straight ahead changes by 4 pi / wavelength per metre of range, as that of a point.
TEST_F(SpeckleTest, PhaseFollowsThePathLength) {
  const double wavelength = scenario_at({0, 0, 0}).water.true_sound_speed() / fan().frequency;
  const auto field_at = [](double x) {
    Scenario scenario = scenario_at({x, 0, 0});
    scenario.receiver.field = true;
    return ping_of(scenario, seabed_at(-3, diffuse(-20))).field;
  };
  const std::vector<std::complex<float>> first = field_at(0), second = field_at(wavelength / 16);
  std::complex<double> product = 0;
  for (int bin = 250; bin < kBins; ++bin) {
    const std::size_t at = static_cast<std::size_t>(bin) * kBeams + 127;
    product += std::complex<double>(second[at]) * std::conj(std::complex<double>(first[at]));
  }
  EXPECT_NEAR(std::arg(product), -0.25 * 3.14159265, 0.05);
}

// Turning by three beams to port shifts the speckle by three beams to starboard; turning by a third of a beam changes
// it little.
TEST_F(SpeckleTest, MovesByBeamsAsTheSonarTurns) {
  const double beam = fan().azimuth_aperture / kBeams;
  const std::vector<float> first = speckle_of(scenario_at({0, 0, 0}));
  EXPECT_GT(correlation(first, speckle_of(scenario_at({0, 0, 0}, 3 * beam)), 0, 3), 0.9);
  EXPECT_LT(correlation(first, speckle_of(scenario_at({0, 0, 0}, 3 * beam)), 0, 0), 0.1);
  EXPECT_GT(correlation(first, speckle_of(scenario_at({0, 0, 0}, beam / 3)), 0, 0), 0.6);
}

// Sparse scatterers: a cell with N of them on average contains none with the probability e^-N, and intensities have
// <I^2> = (2 + 1/N) <I>^2. On a flat bed a cell's area is r dr dphi for any height of the sonar.
TEST_F(SpeckleTest, SparseScatterersHavePoissonStatistics) {
  Scenario scenario = scenario_at({0, 0, 0});
  scenario.receiver.azimuth_pattern = BeamPattern::kTopHat;
  const SonarConfig sonar = fan();
  for (const double density : {60.0, 250.0, 1000.0}) {
    Material material = diffuse(-20);
    material.scatterer_density = density;
    const std::vector<float> sparse = speckle_of(scenario, material);
    for (int first = 60; first < kBins - 60; first += 60) {
      const double range = 0.5 * (sonar.bin_range(first) + sonar.bin_range(first + 59));
      const double mean = density * range * sonar.bin_length() * sonar.azimuth_aperture / kBeams;
      double n = 0, sum = 0, squares = 0, empty = 0;
      for (std::size_t i = std::size_t{kBeams} * first; i < std::size_t{kBeams} * (first + 60); ++i) {
        const double value = sparse[i];
        n += 1, sum += value, squares += value * value, empty += value == 0 ? 1 : 0;
      }
      EXPECT_NEAR(sum / n, 1, 0.06) << density << ", " << range;
      EXPECT_NEAR(empty / n, std::exp(-mean), 0.015) << density << ", " << range;
      EXPECT_NEAR(squares / n / std::pow(sum / n, 2) / (2 + 1 / mean), 1, 0.12) << density << ", " << range;
    }
  }
}

TEST_F(SpeckleTest, SparseScatterersAreFixedInTheWorldAndManyAreGaussian) {
  Material material = diffuse(-20);
  material.scatterer_density = 100;
  const Scenario scenario = scenario_at({1, 2, 0});
  Simulator simulator(scenario, seabed_at(-3, material), 2);
  const std::vector<float> first = simulator.make_ping(0, 0).intensity;
  EXPECT_EQ(simulator.make_ping(0, 5).intensity, first);
  const std::vector<float> many = speckle_of(scenario);
  EXPECT_NE(speckle_of(scenario, material), many);
  material.scatterer_density = 1e7;
  EXPECT_EQ(speckle_of(scenario, material), many);
}

// T17. Two equal points in one cell interfere: the intensity is between 0 and four times that of one, depending on the
// seed.
TEST_F(SpeckleTest, TwoPointsInOneCellInterfere) {
  SonarConfig sonar = fan();
  sonar.min_range = 0;
  sonar.elevation_center = 0;
  sonar.beam_count = 16;
  sonar.bin_count = 60;
  sonar.azimuth_aperture = 16 * kDegree;
  Scenario scenario = scenario_of(sonar);
  for (const double elevation : {-8 * kDegree, 8 * kDegree}) {
    scenario.points.push_back({.position = 10.01 * Vec3(std::cos(elevation), 0, std::sin(elevation))});
  }
  scenario.receiver.speckle = false;
  const std::vector<float> mean = ping_of(scenario, {}).intensity;
  const std::size_t peak = std::ranges::max_element(mean) - mean.begin();
  scenario.receiver.speckle = true;
  double sum = 0, squares = 0, greatest = 0;
  constexpr int kSeeds = 500;
  for (int seed = 0; seed < kSeeds; ++seed) {
    scenario.seed = seed;
    const double ratio = 2 * ping_of(scenario, {}).intensity[peak] / mean[peak];
    sum += ratio, squares += ratio * ratio, greatest = std::max(greatest, ratio);
  }
  EXPECT_NEAR(sum / kSeeds, 2, 0.25);
  EXPECT_NEAR(std::sqrt(squares / kSeeds / std::pow(sum / kSeeds, 2) - 1), 0.7071, 0.09);
  EXPECT_NEAR(greatest, 4, 0.05);
}

}  // namespace
}  // namespace insonify::validation::speckle_test
