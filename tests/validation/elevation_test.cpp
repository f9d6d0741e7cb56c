// elevation_test.cpp -- levels over elevation and bearings on cones, in whole pings (T27, T24, T13). T numbers are
// those of docs/concepts/physics-tests.md.

#include <numeric>

#include "validation/calibrated_scene.h"

namespace insonify::validation::elevation_test {
namespace {

class ElevationLevelTest : public testing::TestWithParam<Method> {};
class ConeTest : public testing::TestWithParam<Method> {};

constexpr double kPi = std::numbers::pi;

// One-way |p|^2 of a continuous line that is 20 degrees wide at half power.
double one_way(double elevation) {
  const double x = kPi * 0.8858929413781328 / (2 * std::sin(10 * kDegree)) * std::sin(elevation);
  return x == 0 ? 1 : std::pow(std::sin(x) / x, 2);
}

double both_ways_db(double elevation_deg) {
  return 20 * std::log10(one_way(elevation_deg * kDegree));
}

// Elevations [deg]. The last three are in the first side lobe, which extends from 23.1 to 51.6 with its peak at 34.1.
constexpr double kElevations[] = {0, 5, 10, 15, -15, 28, 34.1, -42};

Vec3 at(double range, double azimuth_deg, double elevation_deg) {
  return point_from_spherical({range, azimuth_deg * kDegree, elevation_deg * kDegree});
}

// A narrow fan around the acoustic axis.
SonarConfig narrow(Sampling sampling) {
  SonarConfig sonar;
  sonar.beam_count = 8;
  sonar.azimuth_aperture = 2 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.min_range = 5;
  sonar.max_range = 15;
  sonar.bin_count = 200;
  sonar.sampling = sampling;
  return sonar;
}

Scenario with_pattern(const SonarConfig& sonar, const Method& method) {
  Scenario scenario = calibrated(sonar, method);
  scenario.receiver.elevation_pattern = BeamPattern::kRectangular;
  return scenario;
}

TEST_P(ElevationLevelTest, PointsFallWithThePatternBothWays) {
  for (const double elevation : kElevations) {
    Scenario scenario = with_pattern(narrow({1, 20}), GetParam());
    scenario.points = {{.position = at(10.01, 0.1, elevation), .target_strength_db = -20}};
    EXPECT_NEAR(total_db(ping_of(scenario, {})), -20 - 40 * std::log10(10.01) + both_ways_db(elevation), 0.001)
        << elevation;
  }
}

// A Lambert plate of 0.1 m that faces the sonar has a level of -70.00021714 dB on the axis (T2).
TEST_P(ElevationLevelTest, PlatesFallWithThePatternBothWays) {
  const Scenario scenario = with_pattern(narrow({32, 1500}), GetParam());
  for (const double elevation : kElevations) {
    Scene scene = plate_at(10, 0.1, diffuse(-10));
    scene.instances[0].world_from_mesh = {at(10, 0, elevation), orientation_from_rpy(0, -elevation * kDegree, 0)};
    EXPECT_NEAR(total_db(ping_of(scenario, scene)), -70.00021714253623 + both_ways_db(elevation), 0.08) << elevation;
  }
}

// At the centre of a Lambert sphere of radius r the echo per unit solid angle is mu / r^2 in every direction. The total
// is the integral of the two-way pattern over the whole sector, for any number of rows.
TEST_P(ElevationLevelTest, SphereAroundTheSonarSumsThePattern) {
  const Scene shell = sphere_at({0, 0, 0}, 10, diffuse(-20), 0.08);
  for (const double center : {0.0, -30.0}) {
    for (const BeamShape shape : {BeamShape::kWedge, BeamShape::kCone}) {
      SonarConfig sonar = narrow({2, 60});
      sonar.azimuth_aperture = 60 * kDegree;
      sonar.elevation_center = center * kDegree;
      Scenario scenario = with_pattern(sonar, GetParam());
      scenario.receiver.beam_shape = shape;
      // d(solid angle) = cos(elevation) d(azimuth) d(elevation).
      double sum = 0;
      constexpr double kStep = 0.01 * kDegree;
      for (double elevation = -89 * kDegree; elevation < 89 * kDegree; elevation += kStep) {
        const double azimuths =
            shape == BeamShape::kWedge ? 60 * kDegree : 2 * std::asin(std::min(1.0, 0.5 / std::cos(elevation)));
        sum += std::pow(one_way(elevation - center * kDegree), 2) * azimuths * std::cos(elevation) * kStep;
      }
      // The triangles lie slightly inside the sphere.
      EXPECT_NEAR(total_db(ping_of(scenario, shell)), -20 - 20 * std::log10(10) + 10 * std::log10(sum), 0.02)
          << center << (shape == BeamShape::kWedge ? " wedge" : " cone");
    }
  }
}

// T24 with a pattern: volume reverberation is weighted by the two-way pattern.
TEST(ElevationReverberationTest, VolumeIsWeightedByThePatternBothWays) {
  const SonarConfig sonar = narrow({2, 60});
  Scenario scenario = with_pattern(sonar, kRays);
  scenario.water.volume_backscatter_db = -70;
  double height = 0;
  constexpr double kStep = 0.01 * kDegree;
  for (double elevation = -89 * kDegree; elevation < 89 * kDegree; elevation += kStep) {
    height += std::pow(one_way(elevation), 2) * std::cos(elevation) * kStep;
  }
  const double psi = sonar.azimuth_aperture / sonar.beam_count * height;
  const double bin = 10 * std::log10(1 / 10.0 - 1 / 10.05);
  const Ping open = ping_of(scenario, {});
  EXPECT_NEAR(cell_db(open, 100, 3), -70 + 10 * std::log10(psi) + bin, 0.01);

  // Behind a sphere around the sonar no water is insonified.
  const Ping shut = ping_of(scenario, sphere_at({0, 0, 0}, 8, diffuse(-200), 0.08));
  EXPECT_LT(cell_db(shut, 100, 3), cell_db(open, 100, 3) - 50);
}

SonarConfig wide() {
  SonarConfig sonar;
  sonar.beam_count = 280;
  sonar.azimuth_aperture = 130 * kDegree;
  sonar.elevation_aperture = 30 * kDegree;
  sonar.azimuth_resolution = 1 * kDegree;
  sonar.min_range = 5;
  sonar.max_range = 15;
  sonar.bin_count = 100;
  sonar.sampling = {4, 300};
  return sonar;
}

// Azimuth of the strongest beam [deg].
double shown_at(const Ping& ping) {
  const auto strongest = std::ranges::max_element(ping.intensity) - ping.intensity.begin();
  return wide().beam_azimuth(static_cast<int>(strongest % ping.beam_count)) / kDegree;
}

// T27. Targets off the plane of the fan appear at the bearing asin(sin(azimuth) cos(elevation)); points and surfaces.
TEST_P(ConeTest, TargetsOffThePlaneShowAtTheirCones) {
  constexpr struct {
    double azimuth, elevation, cone;
  } kPlaces[] = {{60, 10, 58.5250511108145},
                 {30, 10, 29.498704231103652},
                 {45, -13, 43.54971209884169},
                 {-60, 10, -58.5250511108145}};
  constexpr double kHalfBeam = 0.234;   // Half the beam spacing (130 degrees / 280), and some of the target's width.
  constexpr double kHalfStrip = 0.036;  // Plates are four strips, each of which is in one beam.
  for (const auto& [azimuth, elevation, cone] : kPlaces) {
    Scene plate = plate_at(10, 0.05, diffuse(-10));
    plate.instances[0].world_from_mesh = {at(10, azimuth, elevation),
                                          orientation_from_rpy(0, -elevation * kDegree, azimuth * kDegree)};
    for (const BeamShape shape : {BeamShape::kWedge, BeamShape::kCone}) {
      Scenario scenario = calibrated(wide(), GetParam());
      scenario.receiver.beam_shape = shape;
      const double shown = shape == BeamShape::kCone ? cone : azimuth;
      EXPECT_NEAR(shown_at(ping_of(scenario, plate)), shown, kHalfBeam + kHalfStrip) << azimuth << ", " << elevation;

      scenario.points = {{.position = at(10, azimuth, elevation)}};
      EXPECT_NEAR(shown_at(ping_of(scenario, {})), shown, kHalfBeam) << azimuth << ", " << elevation;
      scenario.receiver.azimuth_pattern = BeamPattern::kHamming;
      scenario.receiver.elevation_pattern = BeamPattern::kRectangular;
      EXPECT_NEAR(shown_at(ping_of(scenario, {})), shown, kHalfBeam) << azimuth << ", " << elevation;
    }
  }
}

// Sum of |a - b|.
double apart(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0, std::plus(),
                            [](double x, double y) { return std::abs(x - y); });
}

// A plate off the axis has the same level and ranges with cones as with wedges.
TEST_P(ConeTest, PlatesKeepTheirLevelsAndRanges) {
  SonarConfig sonar = wide();
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 16 * kDegree;
  sonar.bin_count = 400;
  sonar.sampling = {16, 800};
  sonar.elevation_aperture = 60 * kDegree;
  Scene scene = plate_at(10, 1, diffuse(-10));
  for (const double elevation : {0.0, 20.0}) {
    for (const double tilt : {0.0, 40.0}) {
      scene.instances[0].world_from_mesh = {at(10, 0, elevation),
                                            orientation_from_rpy(0, (tilt - elevation) * kDegree, tilt * kDegree)};
      Scenario scenario = calibrated(sonar, GetParam());
      const Ping wedge = ping_of(scenario, scene);
      scenario.receiver.beam_shape = BeamShape::kCone;
      const Ping cone = ping_of(scenario, scene);
      EXPECT_NEAR(total_db(cone), total_db(wedge), 0.02) << elevation << ", " << tilt;
      const std::vector<double> a = by_range(wedge), b = by_range(cone);
      EXPECT_LT(apart(a, b), 0.02 * std::accumulate(a.begin(), a.end(), 0.0)) << elevation << ", " << tilt;
    }
  }
}

// A flat Lambert seabed h below the array. Between r and r + dr in range and u and u + du in sine of bearing it has the
// area r^2/x dr du at the distance x ahead of the array, x^2 = r^2 (1 - u^2) - h^2. So I = mu h^2 du r^-4 / x dr in
// every bin, without gaps between samples, which are up to fifteen bins apart here.
TEST_P(ConeTest, SeabedHasItsLevelInEveryBin) {
  SonarConfig sonar;
  sonar.beam_count = 64;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.elevation_center = -15 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 40;
  sonar.bin_count = 800;
  sonar.sampling = {1, 100};
  Scenario scenario = calibrated(sonar, GetParam());
  scenario.receiver.beam_shape = BeamShape::kCone;
  const Ping ping = ping_of(scenario, seabed_at(-3, diffuse(-27)));
  double worst = 0, mean = 0, squares = 0;
  int count = 0;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const double u = std::sin(sonar.beam_azimuth(beam));
    const double half = 0.5 * 120 * kDegree / 64;
    const double du = std::sin(sonar.beam_azimuth(beam) + half) - std::sin(sonar.beam_azimuth(beam) - half);
    for (int bin = 180; bin < 500; ++bin) {  // 9 to 25 m
      const double r = sonar.bin_range(bin);
      const double ahead = std::sqrt(r * r * (1 - u * u) - 9);
      const double expected = 10 * std::log10(9 * du * std::pow(r, -4) / ahead * sonar.bin_length()) - 27;
      const double off = cell_db(ping, bin, beam) - expected;
      worst = std::max(worst, std::abs(off));
      mean += off;
      squares += off * off;
      ++count;
    }
  }
  EXPECT_LT(worst, 0.25);
  EXPECT_LT(std::sqrt(squares / count), 0.05);
  EXPECT_NEAR(mean / count, 0, 0.02);
}

// A slanting and leaning wall fills the same beams and bins with few samples as with many, because each sample is
// spread over the ranges that its footprint covers, along its column and across it.
TEST_P(ConeTest, SlantingWallIsTheSameWithFewSamplesAndMany) {
  SonarConfig sonar = wide();
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 100 * kDegree;
  sonar.bin_count = 200;
  double lean = 0;
  const auto received = [&](const Sampling& sampling) {
    sonar.sampling = sampling;
    Scenario scenario = calibrated(sonar, GetParam());
    scenario.receiver.beam_shape = BeamShape::kCone;
    const Ping ping = ping_of(
        scenario, scene_of(make_plane(-Vec3::UnitX(), 40, 40), diffuse(-10),
                           {.position = {10, 0, 0}, .orientation = orientation_from_rpy(0, lean, 30 * kDegree)}));
    return std::vector<double>(ping.intensity.begin(), ping.intensity.end());
  };
  // With an upright wall (no lean) footprints are spread only by the width of columns.
  for (const auto& [lean_deg, aperture_deg, tolerance] : {std::tuple{40, 30, 0.08}, {0, 4, 0.11}}) {
    lean = lean_deg * kDegree;
    sonar.elevation_aperture = aperture_deg * kDegree;
    const std::vector<double> few = received({1, 40}), many = received({16, 1000});
    EXPECT_LT(apart(few, many) / std::accumulate(many.begin(), many.end(), 0.0), tolerance) << lean_deg;
  }
}

// The outermost samples of a column represent everything up to the edges of the sector: the first and last echo of a
// wall in a beam are at the ranges d / (n . direction) at which the wall's plane meets the beam's edges.
TEST_P(ConeTest, SlantingWallEndsAtTheEdgesOfTheSector) {
  SonarConfig sonar = wide();
  sonar.beam_count = 8;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.elevation_aperture = 50 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 40;
  sonar.bin_count = 800;
  sonar.sampling = {16, 10};
  Scenario scenario = calibrated(sonar, GetParam());
  scenario.receiver.beam_shape = BeamShape::kCone;
  const Eigen::Quaterniond turn = orientation_from_rpy(0, 20 * kDegree, 25 * kDegree);
  const Vec3 normal = turn * Vec3::UnitX();
  const Ping ping = ping_of(scenario, scene_of(make_plane(-Vec3::UnitX(), 100, 100), diffuse(-10),
                                               {.position = {10, 0, 0}, .orientation = turn}));
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    double nearest = std::numeric_limits<double>::max(), farthest = 0;
    for (const double edge : {-0.5, 0.5}) {
      const double bearing = sonar.beam_azimuth(beam) + edge * sonar.azimuth_aperture / sonar.beam_count;
      for (const double elevation : {-25 * kDegree, 25 * kDegree}) {
        const double y = std::sin(bearing), z = std::sin(elevation);
        const double range = 10 * normal.x() / normal.dot(Vec3(std::sqrt(1 - y * y - z * z), y, z));
        nearest = std::min(nearest, range);
        farthest = std::max(farthest, range);
      }
    }
    int first = 0, last = sonar.bin_count - 1;
    while (ping.intensity[ping.index(first, beam)] == 0) {
      ++first;
    }
    while (ping.intensity[ping.index(last, beam)] == 0) {
      --last;
    }
    EXPECT_NEAR(sonar.bin_range(first), nearest, 0.2) << beam;
    EXPECT_NEAR(sonar.bin_range(last), farthest, 0.2) << beam;
  }
}

// Nothing is received from behind the array, although cones extend there.
TEST_P(ConeTest, NothingIsReceivedFromBehind) {
  Scenario scenario = calibrated(wide(), GetParam());
  scenario.receiver.beam_shape = BeamShape::kCone;
  scenario.points = {{.position = at(10, 150, 0)}};
  EXPECT_LT(total_db(ping_of(scenario, {})), -200);
  scenario.points = {{.position = at(10, 30, 0)}};
  EXPECT_GT(total_db(ping_of(scenario, {})), -41);
}

// T13 with cones and patterns.
TEST(ConeThreadsTest, PingsDoNotDependOnThreads) {
  SonarConfig sonar = wide();
  sonar.beam_count = 64;
  Scenario scenario = with_pattern(sonar, kRays);
  scenario.receiver.beam_shape = BeamShape::kCone;
  scenario.receiver.azimuth_pattern = BeamPattern::kTaylor;
  scenario.receiver.speckle = true;
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.surface = SeaSurface{.level = 4};
  scenario.water.volume_backscatter_db = -70;
  const Scene scene = sphere_at({9, 2, -1}, 2, glinting(0.8, 0.2));
  const Ping one = Simulator(scenario, scene, 1).make_ping(0, 2);
  EXPECT_GT(total_db(one), -100);
  for (const int threads : {2, 5, 16}) {
    EXPECT_EQ(Simulator(scenario, scene, threads).make_ping(0, 2).intensity, one.intensity) << threads;
  }
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, ElevationLevelTest, testing::Values(kReference, kRays), kName);
INSTANTIATE_TEST_SUITE_P(Methods, ConeTest, testing::Values(kReference, kRays), kName);

}  // namespace
}  // namespace insonify::validation::elevation_test
