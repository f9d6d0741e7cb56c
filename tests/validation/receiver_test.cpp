// receiver_test.cpp -- array, pulse and speckle of whole pings (T11, T12, T14, T17, T18 of PHYSICS 11).

#include "validation/calibrated_scene.h"

namespace insonify::validation {
namespace {

constexpr double kPi = 3.14159265358979323846;

SonarConfig fan() {
  SonarConfig sonar;
  sonar.azimuth_resolution = 1 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 25;
  return sonar;
}

double decibels(double ratio) {
  return 10 * std::log10(ratio);
}

// A lone point shows in every beam at its range, as the array's pattern in the sine of bearing has it.
TEST(ArrayPingTest, PointDrawsThePatternAcrossTheBeams) {
  for (const int beam : {40, 85, 127, 200}) {
    const SonarConfig sonar = fan();
    const double azimuth = sonar.beam_azimuth(beam) - 0.25 * 120 * kDegree / 256;  // The middle of half a beam.
    Scenario scenario = calibrated(sonar, kRays);
    scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
    scenario.points = {{.position = 15.02 * Vec3(std::cos(azimuth), std::sin(azimuth), 0)}};
    const Ping ping = ping_of(scenario, {});
    const int bin = static_cast<int>(15.02 / sonar.bin_length());
    const double length = 0.8858929413781328 / (2 * std::sin(0.5 * kDegree));  // D / wavelength
    const double level = -40 * std::log10(15.02);
    for (int other = 0; other < sonar.beam_count; ++other) {
      const double x = kPi * length * (std::sin(azimuth) - std::sin(sonar.beam_azimuth(other)));
      const double expected = decibels(std::pow(std::sin(x) / x, 2));
      if (expected > -35) {
        EXPECT_NEAR(cell_db(ping, bin, other) - level, expected, 0.05) << beam << ", " << other;
      }
    }
  }
}

// Whatever the window, a lone point keeps its level where the array looks, upright arrays as well.
TEST(ArrayPingTest, EveryWindowKeepsALonePointsLevel) {
  const double azimuth = fan().beam_azimuth(100) - 0.25 * 120 * kDegree / 256;  // The middle of half a beam.
  for (int window = 1; window <= static_cast<int>(BeamPattern::kDolphChebyshev); ++window) {
    Scenario scenario = calibrated(fan(), kRays);
    scenario.receiver.azimuth_pattern = scenario.receiver.elevation_pattern = static_cast<BeamPattern>(window);
    scenario.points = {{.position = 15.02 * Vec3(std::cos(azimuth), std::sin(azimuth), 0)}};
    const Ping ping = ping_of(scenario, {});
    EXPECT_NEAR(cell_db(ping, static_cast<int>(15.02 / fan().bin_length()), 100), -40 * std::log10(15.02), 0.2)
        << window;  // The beam looks an eighth of its width aside.
  }
}

// A scanning head sends and hears with one array: its side lobes are 26.5 dB down.
TEST(ArrayPingTest, ScanningHeadIsTwoWay) {
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 3 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 25;
  sonar.step = 0.375 * kDegree;  // An eighth of a beam: the point is in the middle of a cell in every ping.
  const double first = 0.1875 * kDegree;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  scenario.points = {{.position = 15.02 * Vec3(std::cos(first), std::sin(first), 0)}};
  Simulator simulator(scenario, {}, 2);
  const double length = 0.8858929413781328 / (2 * std::sin(1.5 * kDegree));  // D / wavelength
  for (int ping = 0; ping < 20; ++ping) {
    const double x = kPi * length * std::sin(first - ping * sonar.step);
    const double expected = decibels(std::pow(std::sin(x) / x, 4));
    if (expected > -50) {
      EXPECT_NEAR(total_db(simulator.make_ping(0, ping)) + 40 * std::log10(15.02), expected, 0.05) << ping;
    }
  }
}

// A beam of an array is labelled with the strongest of the cells in its own slice, whichever it is.
TEST(ArrayPingTest, BeamTakesTheLabelOfItsStrongestCell) {
  SonarConfig sonar;
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 8 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 25;
  sonar.sampling = {64, 400};
  Scenario scenario = calibrated(sonar, kRays);
  scenario.receiver.azimuth_pattern = BeamPattern::kHann;
  // Plates in one bin in the middles of three cells, -3.5, 0.5 and 2.5 degrees off: weak, strong, middling.
  Scene scene;
  for (const auto& [azimuth, level] : {std::pair{3.5, -30.0}, {-0.5, -10.0}, {-2.5, -20.0}}) {
    Scene plate = plate_at(10, 0.1, diffuse(level));
    plate.instances[0].world_from_mesh = {
        .position = 10.02 * Vec3(std::cos(azimuth * kDegree), std::sin(azimuth * kDegree), 0),
        .orientation = orientation_from_rpy(0, 0, azimuth * kDegree)};
    plate.instances[0].materials.assign(plate.instances[0].materials.size(),
                                        static_cast<std::uint16_t>(scene.materials.size()));
    scene.materials.push_back(plate.materials[0]);
    scene.instances.push_back(plate.instances[0]);
  }
  const Ping ping = ping_of(scenario, scene);
  EXPECT_EQ(ping.instance[ping.index(static_cast<int>(10.02 / sonar.bin_length()), 0)], 1);
}

Ping two_plates(PulseKind pulse) {
  SonarConfig sonar = fan();
  sonar.beam_count = 8;
  sonar.azimuth_aperture = 4 * kDegree;
  sonar.elevation_aperture = 1 * kDegree;
  sonar.min_range = 9.8;
  sonar.max_range = 10.2;
  sonar.bin_count = 200;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.sound_speed = 1500;
  scenario.receiver.pulse = pulse;
  scenario.receiver.pulse_duration = pulse == PulseKind::kCw ? 50e-6 : 1e-3;
  scenario.receiver.pulse_bandwidth = 100e3;
  scenario.points = {{.position = {10.001, 0.001, 0}}, {.position = {10.031, 0.001, 0}}};
  return ping_of(scenario, {});
}

TEST(PulsePingTest, ChirpResolvesWhatAToneDoesNot) {
  const auto dip = [](const Ping& ping) {
    const std::vector<double> heard = by_range(ping);
    const auto level = [&](double range) { return decibels(heard[static_cast<int>((range - 9.8) / 0.002)]); };
    return std::min(level(10.001), level(10.031)) - level(10.016);
  };
  EXPECT_GT(dip(two_plates(PulseKind::kLfm)), 3);
  EXPECT_LT(dip(two_plates(PulseKind::kCw)), 2);
}

// Speckle of a wide diffuse plate, relative to the mean that is heard without it.
class SpeckleTest : public testing::Test {
 protected:
  static Scenario scenario_of(BeamPattern pattern, bool speckle, std::uint64_t seed = 1) {
    SonarConfig sonar = fan();
    sonar.min_range = 8;
    sonar.max_range = 30;
    sonar.elevation_center = -15 * kDegree;
    Scenario scenario = calibrated(sonar, kRays);
    scenario.receiver.azimuth_pattern = pattern;
    scenario.receiver.speckle = speckle;
    scenario.seed = seed;
    return scenario;
  }
  static std::vector<float> ping_of_seabed(const Scenario& scenario) {
    return ping_of(scenario, seabed_at(-3, diffuse(-20))).intensity;
  }
};

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
  const auto n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ma += a[i] / n, mb += b[i] / n;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - ma) * (a[i] - ma), bb += (b[i] - mb) * (b[i] - mb), ab += (a[i] - ma) * (b[i] - mb);
  }
  return ab / std::sqrt(aa * bb);
}

TEST_F(SpeckleTest, IntensityIsExponentialAndNeighbouringBeamsAreAlike) {
  const std::vector<float> mean = ping_of_seabed(scenario_of(BeamPattern::kRectangular, false));
  const std::vector<float> heard = ping_of_seabed(scenario_of(BeamPattern::kRectangular, true));
  std::vector<double> here, next;
  double sum = 0, squares = 0, amplitudes = 0;
  constexpr int kBeams = 256;
  for (int bin = 50; bin < 500; ++bin) {
    for (int beam = 20; beam < 236; ++beam) {
      const std::size_t at = static_cast<std::size_t>(bin) * kBeams + beam;
      here.push_back(heard[at] / mean[at]);
      next.push_back(heard[at + 1] / mean[at + 1]);
      sum += here.back(), squares += here.back() * here.back(), amplitudes += std::sqrt(here.back());
    }
  }
  const auto n = static_cast<double>(here.size());
  const double independent = 0.415 * n;  // Beams overlap.
  EXPECT_NEAR(sum / n, 1, 4 / std::sqrt(independent));
  EXPECT_NEAR(std::sqrt(squares / n / std::pow(sum / n, 2) - 1), 1, 0.028);
  EXPECT_NEAR(std::sqrt(sum / n / std::pow(amplitudes / n, 2) - 1), 0.5227232008770634, 0.0105);
  // Straight ahead it would be 0.5465; beams are evenly spaced in angle, and overlap less in u at the sides.
  EXPECT_NEAR(correlation(here, next), 0.60, 0.07);
}

// T13 with all that the calibrated model has.
TEST_F(SpeckleTest, PingsDoNotDependOnThreads) {
  Scenario scenario = scenario_of(BeamPattern::kRectangular, true);
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

TEST_F(SpeckleTest, StaysWhileNothingMoves) {
  Simulator simulator(scenario_of(BeamPattern::kRectangular, true), seabed_at(-3, diffuse(-20)), 2);
  const Ping first = simulator.make_ping(0, 0), later = simulator.make_ping(0, 7);
  EXPECT_EQ(first.intensity, later.intensity);
  EXPECT_EQ(first.intensity, ping_of_seabed(scenario_of(BeamPattern::kRectangular, true)));

  const std::vector<float> other = ping_of_seabed(scenario_of(BeamPattern::kRectangular, true, 2));
  const std::vector<float> mean = ping_of_seabed(scenario_of(BeamPattern::kRectangular, false));
  std::vector<double> a, b;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    if (mean[i] > 0) {
      a.push_back(first.intensity[i] / mean[i]);
      b.push_back(other[i] / mean[i]);
    }
  }
  EXPECT_NEAR(correlation(a, b), 0, 0.05);
}

}  // namespace
}  // namespace insonify::validation
