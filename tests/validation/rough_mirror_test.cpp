// rough_mirror_test.cpp -- images in a mirror of randomly tilted facets.

#include <cmath>
#include <numbers>

#include "insonify/error.h"
#include "validation/secondary_grid.h"

namespace insonify::validation::rough_mirror_test {
namespace {

// The ghost of a sphere in a floor, in a vertical fan.
struct Ghost {
  double energy = 0;               // Energy of path order 2 from the mirror's side.
  double mean = 0, deviation = 0;  // Mean and standard deviation of its elevation [deg].
  double both_ways = 0;            // Energy of path order 3.
  double sharp = 0;                // Share of `energy` within kSharp of the image's elevation.
};

constexpr double kSharp = 2;  // [deg]

// @param height  Height of the sonar above the floor; that of the sphere is 10 m - height.
Ghost ghost_in(const Method& method, double rms_slope, bool rough, double height = 5, double rms_height = 0) {
  Scene scene = sphere_at({10, 0, 10 - 2 * height}, 0.3, diffuse(-10));
  Material mirror = glinting(1, rms_slope);
  mirror.rms_height = rms_height;
  const Scene floor = scene_of(make_plane(Vec3::UnitZ(), 60, 60), mirror, {.position = {5, 0, -height}});
  scene.materials.push_back(floor.materials.front());
  scene.instances.push_back(floor.instances.front());
  scene.instances.back().materials.assign(scene.instances.back().materials.size(), 1);

  SonarConfig sonar;
  sonar.beam_count = 300;
  sonar.azimuth_aperture = 150 * kDegree;
  sonar.elevation_aperture = 40 * kDegree;
  sonar.min_range = 1;
  sonar.max_range = 20;
  sonar.bin_count = 200;
  sonar.sampling = {8, 400};
  const Pose on_its_side{.orientation = orientation_from_rpy(90 * kDegree, 0, 0)};
  const EchoGrid grid = secondary_grid(method, scene, sonar, on_its_side, {.rough_mirrors = rough});
  Ghost ghost;
  double squares = 0;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const double elevation = sonar.beam_azimuth(beam) / kDegree;  // Port is up.
    for (const float energy : grid.energy(2, beam)) {
      if (elevation < -25) {  // The reciprocal path arrives from the sphere itself.
        ghost.energy += energy;
        ghost.mean += energy * elevation;
        ghost.sharp += std::abs(elevation + 45) < kSharp ? energy : 0;
        squares += energy * elevation * elevation;
      }
    }
    for (const float energy : grid.energy(3, beam)) {
      ghost.both_ways += energy;
    }
  }
  ghost.sharp /= ghost.energy;
  ghost.mean /= ghost.energy;
  ghost.deviation = std::sqrt(squares / ghost.energy - ghost.mean * ghost.mean);
  return ghost;
}

class RoughMirrorTest : public testing::TestWithParam<Method> {};

// A facet tilted by t shifts the direction of the image by 2 t R2 / (R1 + R2), with R1 the distance to the mirror and
// R2 from there to the target. Random tilts widen the image by that (a glitter path) and do not change its energy.
TEST_P(RoughMirrorTest, SpreadsTheImageInProportionToItsSlopes) {
  for (const double height : {3.0, 5.0, 7.0}) {
    const Ghost smooth = ghost_in(GetParam(), 0.05, false, height);
    EXPECT_NEAR(smooth.mean, -45, 0.7) << height;
    EXPECT_LT(smooth.deviation, 1) << height;
    const double reflected = 2 * (10 - height) / 10;
    for (const double slope : {0.03, 0.05}) {
      const Ghost rough = ghost_in(GetParam(), slope, true, height);
      const double added = std::sqrt(rough.deviation * rough.deviation - smooth.deviation * smooth.deviation) * kDegree;
      EXPECT_NEAR(added / (reflected * slope), 1, 0.1) << slope << ", " << height;
      EXPECT_NEAR(rough.mean, -45, 1.2) << slope << ", " << height;
      EXPECT_NEAR(10 * std::log10(rough.energy / smooth.energy), 0, 0.3) << slope << ", " << height;
      // Opposite ways interfere where both facets are in one cell, here a beam of half a degree: for two independent
      // Gaussian bearings, with this probability on average.
      const double in_one_cell = 0.5 * kDegree / (2 * std::sqrt(std::numbers::pi) * reflected * slope);
      EXPECT_NEAR(rough.both_ways / smooth.both_ways, 1 + in_one_cell, 0.017) << slope << ", " << height;
    }
  }
}

TEST_P(RoughMirrorTest, WithoutSlopesIsSmooth) {
  const Ghost smooth = ghost_in(GetParam(), 1e-4, false), rough = ghost_in(GetParam(), 1e-4, true);
  EXPECT_NEAR(rough.energy / smooth.energy, 1, 0.01);
  EXPECT_NEAR(rough.deviation, smooth.deviation, 0.01);
}

// A mirror of a small roughness has a sharp image with the coherent share of the energy, over a wide one that holds the
// rest: orders n of a Poisson distribution, each a Gaussian of 2 R2/(R1 + R2) s sqrt(n/g) = s sqrt(n/g) here, where R1
// = R2. Incidence is at 45 degrees: g = 2 k^2 h^2.
TEST_P(RoughMirrorTest, ImageOfASmallRoughnessIsSharpAndWide) {
  constexpr double kSlope = 0.06, kFrequency = 720e3;
  for (const double height : {0.05e-3, 0.1e-3, 0.2e-3}) {
    const double wavenumber = 2 * kDegree * 180 * kFrequency / 1500;
    const double g = 2 * std::pow(wavenumber * height, 2);
    double sharp = 0, share = std::exp(-g);
    for (int n = 0; n < 40; ++n) {
      const double deviation = kSlope * std::sqrt(n / g);
      sharp += share * (n == 0 ? 1 : std::erf(kSharp * kDegree / (std::sqrt(2) * deviation)));
      share *= g / (n + 1);
    }
    const Ghost ghost = ghost_in(GetParam(), kSlope, false, 5, height), smooth = ghost_in(GetParam(), kSlope, false);
    EXPECT_NEAR(ghost.sharp, sharp, 0.05) << height;
    EXPECT_NEAR(10 * std::log10(ghost.energy / smooth.energy), 0, 0.3) << height;
    EXPECT_NEAR(10 * std::log10(ghost.both_ways / smooth.both_ways), 0, 0.3) << height;
  }
}

// The facets of a wide lobe are no mirror: the image is sharp, and has the coherent share alone, twice where both ways
// are by the mirror.
TEST_P(RoughMirrorTest, WideFacetsLeaveTheCoherentShare) {
  constexpr double kSlope = 0.3, kFrequency = 720e3;
  const Ghost smooth = ghost_in(GetParam(), kSlope, false);
  for (const double height : {0.07e-3, 0.15e-3, 0.25e-3}) {
    const double g = 2 * std::pow(2 * kDegree * 180 * kFrequency / 1500 * height, 2);
    const Ghost ghost = ghost_in(GetParam(), kSlope, false, 5, height);
    EXPECT_GT(ghost.sharp, 0.98) << height;
    EXPECT_NEAR(10 * std::log10(ghost.energy / smooth.energy), -10 * std::log10(std::exp(g)), 0.2) << height;
    EXPECT_NEAR(10 * std::log10(ghost.both_ways / smooth.both_ways), -20 * std::log10(std::exp(g)), 0.3) << height;
  }
  EXPECT_EQ(ghost_in(GetParam(), kSlope, false, 5, 2e-3).energy, 0);
  EXPECT_GT(ghost_in(GetParam(), kSlope, true, 5, 2e-3).energy, 0.5 * smooth.energy);
}

// From scenario to ping: ghosts in a windy sea are wider.
TEST(RoughMirrorScenarioTest, WidensTheGhostsOfAWindySea) {
  Scene scene = sphere_at({8, 0, -3}, 0.3, diffuse(-10));
  Scenario scenario;
  scenario.water.absorption = false;
  scenario.receiver.noise = scenario.receiver.speckle = false;
  scenario.secondary = SecondaryEchoes::kAll;
  SonarConfig sonar;
  sonar.name = "upright";
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.position = {0, 0, -3};
  sonar.orientation = {90 * kDegree, 0, 0};
  sonar.max_range = 12;
  scenario.sonars = {sonar};
  double deviation[2] = {};
  for (const bool rough : {false, true}) {
    scenario.surface = SeaSurface{.level = 0, .wind_speed = rough ? 3.0 : 0.0};
    const Ping ping = Simulator(scenario, scene, 2).make_ping(0, 0);
    double sum = 0, moment = 0, squares = 0;
    for (int beam = 0; beam < ping.beam_count; ++beam) {
      const double elevation = sonar.beam_azimuth(beam) / kDegree;
      for (int bin = 0; bin < ping.bin_count; ++bin) {
        const double range = sonar.bin_range(bin);
        if (elevation > 20 && range > 8.3) {  // Excludes the direct echo of the surface, which is nearer.
          const double intensity = ping.intensity[ping.index(bin, beam)];
          sum += intensity;
          moment += intensity * elevation;
          squares += intensity * elevation * elevation;
        }
      }
    }
    deviation[rough ? 1 : 0] = std::sqrt(squares / sum - moment * moment / (sum * sum));
  }
  EXPECT_GT(deviation[1], 3 * deviation[0]);

  scenario.model = EchoModel::kPaper;
  scenario.rough_mirrors = true;
  scenario.surface.reset();
  EXPECT_THROW(scenario.validate(), Error);
}

INSTANTIATE_TEST_SUITE_P(Methods, RoughMirrorTest, testing::Values(kRays, kRaster),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace insonify::validation::rough_mirror_test
