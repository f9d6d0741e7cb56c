// level_test.cpp -- levels of the calibrated model against closed forms: size, tilt, seabed, absorption, sphere, plate,
// materials (T2, T3, T4, T6, T7, T19 of docs/concepts/physics-tests.md). Reference values were computed independently
// of this code, in double precision.

#include <numeric>

#include "validation/calibrated_scene.h"

namespace insonify::validation::level_test {
namespace {

class LevelTest : public testing::TestWithParam<Method> {};
class SphereLevelTest : public testing::TestWithParam<Method> {};

// A narrow, finely sampled fan, for targets smaller than the default sample spacing.
SonarConfig fine_sonar() {
  SonarConfig sonar;
  sonar.beam_count = 16;
  sonar.azimuth_aperture = 8 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.min_range = 5;
  sonar.max_range = 15;
  sonar.bin_count = 200;
  sonar.sampling = {32, 800};
  return sonar;
}

// T2.
TEST_P(LevelTest, GrowsWithTheAreaOfTheTarget) {
  const Scenario scenario = calibrated(fine_sonar(), GetParam());
  const double small = total_db(ping_of(scenario, plate_at(10, 0.05, diffuse(-10))));
  const double large = total_db(ping_of(scenario, plate_at(10, 0.1, diffuse(-10))));
  EXPECT_NEAR(small, -76.02065419979581, 0.3);
  EXPECT_NEAR(large, -70.00021714253623, 0.3);
  EXPECT_NEAR(large - small, 6.02, 0.2);
}

// T3.
TEST_P(LevelTest, FallsWithTheSquareOfTheCosineOfTilt) {
  const Scenario scenario = calibrated(fine_sonar(), GetParam());
  EXPECT_NEAR(total_db(ping_of(scenario, plate_at(10, 0.1, diffuse(-10), 45 * kDegree))), -73.01008282278912, 0.3);
  EXPECT_NEAR(total_db(ping_of(scenario, plate_at(10, 0.1, diffuse(-10), 60 * kDegree))), -76.02016563309283, 0.3);
}

// T4. A flat Lambert seabed and a level sonar: I = mu h^2 psi (r1^-4 - r2^-4) / 4 in every beam.
SonarConfig seabed_sonar() {
  SonarConfig sonar;
  sonar.beam_count = 128;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.elevation_center = -15 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 40;
  sonar.bin_count = 400;
  return sonar;
}

TEST_P(LevelTest, SeabedFallsOffWithTheFifthPowerOfRange) {
  const Ping ping = ping_of(calibrated(seabed_sonar(), GetParam()), seabed_at(-3, diffuse(-27)));
  struct {
    int bin;
    double level;
  } constexpr kBins[] = {
      {80, -90.60804474730088}, {100, -95.4268540696684}, {160, -105.59262956345407}, {240, -114.37474864461319}};
  for (const auto& [bin, level] : kBins) {
    for (const int beam : {0, 20, 63, 64, 127}) {
      EXPECT_NEAR(cell_db(ping, bin, beam), level, 0.2) << bin << ", " << beam;
    }
  }

  // From 8 to 30 m the level falls by 50 dB per decade of range.
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (int bin = 80; bin < 300; ++bin) {
    const double decades = std::log10((bin + 0.5) * 0.1), level = cell_db(ping, bin, 64);
    n += 1, x += decades, y += level, xx += decades * decades, xy += decades * level;
  }
  EXPECT_NEAR((n * xy - x * y) / (n * xx - x * x), -50, 0.5);

  // The aperture, 5 to 25 degrees down, meets the bottom from 7.0986 to 34.42 m.
  for (int beam = 0; beam < ping.beam_count; ++beam) {
    EXPECT_EQ(ping.intensity[ping.index(69, beam)], 0);
    EXPECT_GT(ping.intensity[ping.index(71, beam)], 0);
    EXPECT_GT(ping.intensity[ping.index(343, beam)], 0);
    EXPECT_EQ(ping.intensity[ping.index(345, beam)], 0);
  }
}

// The same for tall fans that look along, down and up, with as many rows as a fan of 20 degrees has by default, where
// sound meets the seabed at 5 degrees or more.
TEST_P(LevelTest, TallFansHearTheSeabedAsItIs) {
  struct {
    double aperture, centre, height;
  } constexpr kFans[] = {{88, -45, -3.7}, {120, 0, -2.2}, {110, -29, -5.1}, {120, 28, 4.3}, {67, -55, -6}};
  for (const auto& [aperture, centre, height] : kFans) {
    SonarConfig sonar;
    sonar.beam_count = 12;
    sonar.azimuth_aperture = 30 * kDegree;
    sonar.elevation_aperture = aperture * kDegree;
    sonar.elevation_center = centre * kDegree;
    sonar.min_range = 0;
    sonar.max_range = 31;
    sonar.bin_count = 310;
    const Ping ping = ping_of(calibrated(sonar, GetParam()), seabed_at(height, diffuse(-27)));
    // The bins that the fan sees whole.
    const double steepest = (height < 0 ? aperture / 2 - centre : aperture / 2 + centre) * kDegree;
    const double flattest =
        std::max(5 * kDegree, (height < 0 ? -centre - aperture / 2 : centre - aperture / 2) * kDegree);
    const double distance = std::abs(height), nearest = distance / std::sin(std::min(steepest, 89 * kDegree));
    const double farthest = std::min(30.0, distance / std::sin(flattest));
    int compared = 0;
    for (int bin = static_cast<int>(10 * nearest) + 2; bin < 10 * farthest - 1; ++bin, ++compared) {
      const double r1 = 0.1 * bin, r2 = r1 + 0.1, width = 2.5 * kDegree;
      const double wanted =
          -27 + 10 * std::log10(distance * distance * width * (std::pow(r1, -4) - std::pow(r2, -4)) / 4);
      for (const int beam : {0, 5, 11}) {
        EXPECT_NEAR(cell_db(ping, bin, beam), wanted, 0.7) << aperture << " about " << centre << ", bin " << bin;
      }
    }
    EXPECT_GT(compared, 30);
  }
}

// T6. The levels of the same bin with and without absorption differ by 2 alpha r.
TEST_P(LevelTest, AbsorptionIsTwoWay) {
  for (const auto& [distance, loss] : {std::pair{10.01, 4.469220773725542}, {50.01, 22.34610386862771}}) {
    SonarConfig sonar = fine_sonar();
    sonar.frequency = 720e3;
    sonar.max_range = 60;
    sonar.bin_count = 1100;
    sonar.sampling = {4, 200};
    Scenario scenario = calibrated(sonar, GetParam());
    const Scene scene = plate_at(distance, 100, diffuse(-20));
    const Ping clear = ping_of(scenario, scene);
    scenario.water.absorption = true;  // 10 degC, 35 PSU, pH 8, at the surface.
    const Ping absorbing = ping_of(scenario, scene);
    const int bin = static_cast<int>((distance - 5) / 0.05);
    EXPECT_NEAR(cell_db(clear, bin, 8) - cell_db(absorbing, bin, 8),
                loss * (5 + 0.05 * bin + 0.025) / (distance - 0.01), 0.05);
  }
}

// T7. The specular echo of a large plate is that of a mirror, |R|^2 / (2 r)^2, for every facet slope; the slopes spread
// it in range.
TEST_P(LevelTest, LargePlateIsAMirror) {
  SonarConfig sonar;
  sonar.beam_count = 90;
  sonar.azimuth_aperture = 90 * kDegree;
  sonar.elevation_aperture = 90 * kDegree;
  sonar.min_range = 9.5;
  sonar.max_range = 14.5;
  sonar.bin_count = 5000;
  sonar.sampling = {4, 800};
  const Ping ping = ping_of(calibrated(sonar, GetParam()), plate_at(10, 10, glinting(1, 0.1)));
  EXPECT_NEAR(total_db(ping), -26.0206, 0.3);
  const std::vector<double> received = by_range(ping);
  const double all = std::accumulate(received.begin(), received.end(), 0.0);
  const auto within = [&](double distance) {
    return std::accumulate(received.begin(), received.begin() + std::lround((0.5 + distance) * 1000), 0.0) / all;
  };
  EXPECT_NEAR(within(0), 0, 2e-4);
  EXPECT_NEAR(within(0.06908), 0.50, 0.01);
  EXPECT_NEAR(within(0.29522), 0.95, 0.005);
}

// A plate that is narrower than the lobe of its facets, on the sonar's axis at the distance d: the share of the
// mirror's echo is the integral of the slopes' density, exp(-x^2 / (2 (d s)^2)) along both sides a: erf^2(a / (2
// sqrt(2) d s)). By hand: -3.3155 dB for 1 m at 10 m with s = 0.05, -1.0857e-1 dB with s = 0.02; -8.3377 dB for 0.7 m
// at 14 m, s = 0.05.
TEST_P(LevelTest, PlateNarrowerThanItsLobeFallsBelowTheMirror) {
  struct Plate {
    double side, distance, slope, expected_db;
  };
  for (const auto& [side, distance, slope, expected] :
       {Plate{1, 10, 0.05, -3.3155}, Plate{1, 10, 0.02, -0.1086}, Plate{0.7, 14, 0.05, -8.3377}}) {
    SonarConfig sonar;
    sonar.beam_count = 16;
    sonar.azimuth_aperture = 8 * kDegree;
    sonar.elevation_aperture = 8 * kDegree;
    sonar.min_range = distance - 0.1;
    sonar.max_range = distance + 0.1;
    sonar.bin_count = 50;
    sonar.sampling = {16, 800};
    const Ping ping = ping_of(calibrated(sonar, GetParam()), plate_at(distance, side, glinting(0.9, slope)));
    const double mirror = 20 * std::log10(0.9 / (2 * distance));
    EXPECT_NEAR(total_db(ping) - mirror, expected, 0.15) << side << " m at " << distance << " m, slope " << slope;
  }
}

// T19.
TEST_P(LevelTest, MaterialsDifferByTheirReflectionCoefficients) {
  SonarConfig sonar = fine_sonar();
  sonar.sampling = {4, 200};
  const Scenario scenario = calibrated(sonar, GetParam());
  const auto level = [&](const char* name) {
    Material material = *find_material(name);
    material.lambert_db = -200;
    material.rms_slope = 0.1;
    material.rms_height = 0;  // Else plates glint.
    return total_db(ping_of(scenario, plate_at(10, 20, material)));
  };
  EXPECT_NEAR(level("steel") - level("pvc"), 8.2517, 0.1);
  EXPECT_NEAR(level("air") - level("steel"), 0.5728, 0.1);
}

// T7. Facets of slope 0.1 widen a sphere's highlight slightly: +0.04 dB on 10 log10(a^2 / 4).
TEST_P(SphereLevelTest, SphereHasItsTargetStrength) {
  const Scenario scenario = calibrated(fine_sonar(), GetParam());
  EXPECT_NEAR(total_db(ping_of(scenario, sphere_at({10, 0, 0}, 0.5, glinting(1, 0.1)))), -51.557027268314684, 0.3);
  EXPECT_NEAR(total_db(ping_of(scenario, sphere_at({10, 0, 0}, 0.5, glinting(1, 0.2)))), -51.447063, 0.3);
  const Ping diffuse_ping = ping_of(scenario, sphere_at({10, 0, 0}, 0.5, diffuse(-27)));
  EXPECT_NEAR(total_db(diffuse_ping), -69.47014770806686, 0.2);

  const std::vector<double> received = by_range(diffuse_ping);
  const auto first = std::ranges::find_if(received, [](double value) { return value > 0; });
  EXPECT_EQ(first - received.begin(), 90);  // 9.5 m.
}

// The same for a mesh of 80 000 triangles, whose normals differ by less than a degree, of a material that reflects
// coherently: it is no plane face.
TEST_P(SphereLevelTest, AFinelyMeshedSphereHasIt) {
  Material material = glinting(1, 0.1);
  material.rms_height = 3e-5;
  const Ping ping = ping_of(calibrated(fine_sonar(), GetParam()), sphere_at({10, 0, 0}, 0.5, material, 0.029));
  EXPECT_NEAR(total_db(ping), -51.557027268314684, 0.3);
}

// The level is right up to the last bin, although samples beyond it are not deposited.
TEST_P(LevelTest, SeabedKeepsItsLevelUpToTheLastBin) {
  SonarConfig sonar;
  sonar.beam_count = 8;
  sonar.azimuth_aperture = 8 * kDegree;
  sonar.elevation_aperture = 40 * kDegree;
  sonar.min_range = 20;
  sonar.max_range = 60;
  sonar.bin_count = 400;
  for (const int rows : {100, 200, 1000}) {
    sonar.sampling = {4, rows};
    const Ping ping = ping_of(calibrated(sonar, GetParam()), seabed_at(-5, diffuse(-20)));
    for (int bin = 200; bin < sonar.bin_count; ++bin) {
      double sum = 0;
      for (int beam = 0; beam < sonar.beam_count; ++beam) {
        sum += ping.intensity[ping.index(bin, beam)] / sonar.beam_count;
      }
      const double expected =
          -20 + 10 * std::log10(25 * 1 * kDegree * sonar.bin_length() / std::pow(sonar.bin_range(bin), 5));
      EXPECT_NEAR(10 * std::log10(sum), expected, 0.5) << rows << ", " << sonar.bin_range(bin);
    }
  }
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, LevelTest, testing::Values(kReference, kRays, kRaster), kName);
INSTANTIATE_TEST_SUITE_P(Methods, SphereLevelTest, testing::Values(kRays, kRaster), kName);

}  // namespace
}  // namespace insonify::validation::level_test
