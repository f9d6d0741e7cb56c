// multipath_test.cpp -- echoes by way of mirrors: ghosts in the sea surface, corners, reciprocity (T9, T10, T21 of
// docs/concepts/physics-tests.md). Expected ranges and levels are those of image sources, computed independently.

#include "base/rotation_between.h"
#include "validation/secondary_grid.h"

namespace insonify::validation::multipath_test {
namespace {

class MultipathTest : public testing::TestWithParam<Method> {};
class ElevationMultipathTest : public testing::TestWithParam<Method> {};

EchoGrid echoes_of(const Method& method, const Scene& scene, const SonarConfig& sonar, const Vec3& position,
                   int max_surfaces = 3, const std::optional<ArraySettings>& elevation_array = {}) {
  return secondary_grid(method, scene, sonar, {.position = position},
                        {.max_surfaces = max_surfaces, .elevation_array = elevation_array});
}

double total_db(const EchoGrid& grid, int order) {
  double sum = 0;
  for (int beam = 0; beam < grid.beam_count(); ++beam) {
    for (const float value : grid.energy(order, beam)) {
      sum += value;
    }
  }
  return 10 * std::log10(sum);
}

// Level of one path order within 0.3 m of a range. At other ranges the surface itself echoes by way of the sphere.
double level_db(const EchoGrid& grid, const SonarConfig& sonar, int order, double range) {
  double sum = 0;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    for (int bin = 0; bin < sonar.bin_count; ++bin) {
      sum += std::abs(sonar.bin_range(bin) - range) < 0.3 ? grid.energy(order, beam)[bin] : 0;
    }
  }
  return 10 * std::log10(sum);
}

// Range of the bin with most energy of one path order.
double peak_range(const EchoGrid& grid, const SonarConfig& sonar, int order) {
  std::vector<double> sums(sonar.bin_count, 0.0);
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    for (int bin = 0; bin < sonar.bin_count; ++bin) {
      sums[bin] += grid.energy(order, beam)[bin];
    }
  }
  return sonar.bin_range(static_cast<int>(std::ranges::max_element(sums) - sums.begin()));
}

SonarConfig tall_sonar(double elevation_aperture_deg) {
  SonarConfig sonar;
  sonar.beam_count = 16;
  sonar.azimuth_aperture = 8 * kDegree;
  sonar.elevation_aperture = elevation_aperture_deg * kDegree;
  sonar.min_range = 1;
  sonar.max_range = 25;
  sonar.bin_count = 480;
  sonar.sampling = {8, 2000};
  return sonar;
}

// T9. A calm sea surface above a small sphere: the direct echo (order 1), the two reciprocal paths by way of the
// surface one way (order 2), and the path by way of it both ways (order 3).
TEST_P(MultipathTest, SurfaceGhostsHaveTheirRangesAndLevels) {
  const Material calm = glinting(1, 0.005);
  {
    const SonarConfig sonar = tall_sonar(90);
    const Scene scene =
        scene_of_all({plane(Vec3::UnitZ(), {0, 0, 0}, calm), sphere_at({10, 0, -4}, 0.1, glinting(1, 0.1), 0.1)});
    const EchoGrid grid = echoes_of(GetParam(), scene, sonar, {0, 0, -5});
    const double bin = 1.01 * sonar.bin_length();  // The facet lobe spreads a highlight to longer ranges.
    EXPECT_NEAR(peak_range(grid, sonar, 1), 10.04987562112089 - 0.1, bin);
    EXPECT_NEAR(peak_range(grid, sonar, 2), 11.7517498340973 - 0.1 * std::cos(18.14 * kDegree), bin);
    EXPECT_NEAR(peak_range(grid, sonar, 3), 13.45362404707371 - 0.1, bin);
    EXPECT_NEAR(total_db(grid, 2) - total_db(grid, 1), 0.477, 0.5);
    EXPECT_NEAR(total_db(grid, 3) - total_db(grid, 1), -5.067, 0.5);
  }
  {
    // The ghost arrives from 42 degrees up, outside a level fan of 20 degrees.
    const SonarConfig sonar = tall_sonar(20);
    const Scene scene =
        scene_of_all({plane(Vec3::UnitZ(), {0, 0, 0}, calm), sphere_at({10, 0, -4}, 0.1, glinting(1, 0.1), 0.1)});
    const EchoGrid grid = echoes_of(GetParam(), scene, sonar, {0, 0, -5});
    EXPECT_LT(total_db(grid, 2) - total_db(grid, 1), -100);
    EXPECT_LT(total_db(grid, 3) - total_db(grid, 1), -100);
  }
  {
    const SonarConfig sonar = tall_sonar(20);
    const Scene scene =
        scene_of_all({plane(Vec3::UnitZ(), {0, 0, 0}, calm), sphere_at({20, 0, -1}, 0.1, glinting(1, 0.1), 0.1)});
    const EchoGrid grid = echoes_of(GetParam(), scene, sonar, {0, 0, -1});
    EXPECT_NEAR(total_db(grid, 2) - total_db(grid, 1), 2.967, 0.5);
    EXPECT_NEAR(total_db(grid, 3) - total_db(grid, 1), -0.086, 0.5);
  }
}

// T9 with an array of 20 degrees in elevation (sinc^2 one way) on transmission and reception: ghosts from 42 degrees up
// are weak, but received through its side lobe.
TEST_P(ElevationMultipathTest, SurfaceGhostsAreWeightedByThePatternBothWays) {
  const Material calm = glinting(1, 0.005);
  SonarConfig sonar = tall_sonar(20);
  sonar.beam_count = 3;
  sonar.azimuth_aperture = 0.6 * kDegree;  // Wide enough for the whole highlight.
  sonar.sampling = {12, 2000};
  constexpr struct {
    double range, height, depth, both, twice;
  } kScenes[] = {{10, -4, -5, -15.138, -36.296}, {20, -1, -1, 2.026, -1.968}};
  for (const auto& [range, height, depth, both, twice] : kScenes) {
    const Scene scene = scene_of_all(
        {plane(Vec3::UnitZ(), {0, 0, 0}, calm), sphere_at({range, 0, height}, 0.1, glinting(1, 0.1), 0.2)});
    const EchoGrid grid = echoes_of(GetParam(), scene, sonar, {0, 0, depth}, 3, ArraySettings{});
    const double straight = std::hypot(range, height - depth) - 0.1,
                 by_mirror = std::hypot(range, height + depth) - 0.1;
    const double direct = level_db(grid, sonar, 1, straight);
    EXPECT_NEAR(level_db(grid, sonar, 2, 0.5 * (straight + by_mirror)) - direct, both, 0.5) << range;
    EXPECT_NEAR(level_db(grid, sonar, 3, by_mirror) - direct, twice, 0.5) << range;
    EXPECT_NEAR(peak_range(grid, sonar, 1), straight, 1.01 * sonar.bin_length());
  }
}

// Ghosts in the sea surface of a scenario.
TEST(SeaSurfaceTest, GhostsComeAndGoWithTheSurface) {
  Scenario scenario = calibrated(tall_sonar(90), kRays);
  scenario.sonars[0].position = {0, 0, -5};
  scenario.secondary = SecondaryEchoes::kAll;
  const Scene scene = sphere_at({10, 0, -4}, 0.1, glinting(1, 0.1), 0.1);
  const double without = validation::total_db(ping_of(scenario, scene));
  scenario.surface = SeaSurface{};
  const double with = validation::total_db(ping_of(scenario, scene));
  const double ghosts = std::pow(10, 0.0477) + std::pow(10, -0.5067);
  EXPECT_NEAR(with - without, 10 * std::log10(1 + ghosts), 0.3);
  scenario.max_surfaces = 1;
  EXPECT_NEAR(validation::total_db(ping_of(scenario, scene)), without, 0.01);
}

TEST(SeaSurfaceTest, WindMakesItRoughAndLossy) {
  const Material calm = sea_surface_material({}, 100e3), windy = sea_surface_material({.wind_speed = 8}, 100e3);
  EXPECT_EQ(calm.reflection_at(720e3), 1);
  EXPECT_NEAR(windy.rms_slope, std::sqrt(0.5 * (0.003 + 0.00512 * 8)), 1e-12);
  EXPECT_NEAR(windy.rms_height, 0.25 * 0.21 * 8 * 8 / 9.81, 1e-12);
  EXPECT_EQ(calm.rms_height, 0);
  const double straight_up_db = 1.26e-3 * std::pow(8, 1.57) * std::pow(100, 0.85);
  EXPECT_NEAR(windy.reflection_at(720e3), std::pow(10, -straight_up_db / 20), 1e-9);
  for (const double grazing : {6.0, 20.0, 45.0}) {
    const double sine = std::sin(grazing * kDegree);
    EXPECT_NEAR(10 * std::log10(windy.scattering(720e3).reflectance(sine)), -straight_up_db / sine, 0.02);
    EXPECT_EQ(calm.scattering(720e3).reflectance(sine), 1);
  }
}

// T10.
TEST_P(MultipathTest, CornerEchoesAtItsApexAndBehind) {
  const SonarConfig sonar = corner_sonar();
  const EchoGrid grid = echoes_of(GetParam(), corner(1, -20), sonar, {0, 0, -5});
  EXPECT_NEAR(peak_range(grid, sonar, 2), 10.44030650891055, sonar.bin_length());
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const double apex = 10.44030650891055;  // Nearest at azimuth 0; farther in every other beam.
    for (int bin = 0; sonar.bin_range(bin) < apex - sonar.bin_length(); ++bin) {
      ASSERT_EQ(grid.energy(2, beam)[bin], 0) << beam << ", " << bin;
    }
  }
  EXPECT_EQ(total_db(echoes_of(GetParam(), corner(1, -20), sonar, {0, 0, -5}, 1), 2),
            -std::numeric_limits<double>::infinity());
}

// T10, T21. Two perpendicular mirrors have one double image, whose echo is |R1 R2|^2 / (2 d)^2.
TEST_P(MultipathTest, CornerOfTwoMirrorsIsOneImage) {
  const double whole = total_db(echoes_of(GetParam(), corner(1, -200), corner_sonar(), {0, 0, -5}), 2);
  const double half = total_db(echoes_of(GetParam(), corner(0.5, -200), corner_sonar(), {0, 0, -5}), 2);
  EXPECT_NEAR(whole, -26.39486489268586, 0.3);
  EXPECT_NEAR(half - whole, 2 * 20 * std::log10(0.5), 0.01);
}

// Two mirrors whose facets are too steep for ghosts: of their image all is left but what both reflect incoherently,
// whichever of them is the smoother.
TEST_P(MultipathTest, CornerOfTwoRoughMirrorsLacksWhatBothScatter) {
  const auto total = [](double wall_slope, double wall_height, double floor_slope, double floor_height) {
    Material wall = glinting(1, wall_slope), floor = glinting(1, floor_slope);
    wall.rms_height = wall_height;
    floor.rms_height = floor_height;
    const Scene scene =
        scene_of_all({plane(-Vec3::UnitX(), {10, 0, 92}, wall), plane(Vec3::UnitZ(), {-90, 0, -8}, floor)});
    return total_db(echoes_of(GetParam(), scene, corner_sonar(), {0, 0, -5}), 2);
  };
  for (const auto& [wall, floor] : {std::pair(0.15, 0.12), std::pair(0.12, 0.15), std::pair(0.13, 0.13)}) {
    const double smooth = total(wall, 0, floor, 0);
    EXPECT_NEAR(total(wall, 0.2e-3, floor, 0), smooth, 0.5) << wall;
    EXPECT_NEAR(total(wall, 0, floor, 1e-3), smooth, 0.5) << wall;
    EXPECT_LT(total(wall, 0.2e-3, floor, 1e-3), smooth - 1) << wall;
    EXPECT_LT(total(wall, 1e-3, floor, 5e-3), smooth - 20) << wall;
  }
}

// T21. The two reciprocal echoes of a diffuse surface have equal levels; each is received in the beam of its arrival.
TEST_P(MultipathTest, ReciprocalEchoesHaveEqualLevels) {
  SonarConfig sonar = corner_sonar();
  sonar.beam_count = 60;
  sonar.azimuth_aperture = 120 * kDegree;
  // A mirror wall along the port side, and a small diffuse target ahead to starboard.
  const Scene scene = scene_of_all(
      {plane(-Vec3::UnitY(), {0, 4, 0}, glinting(1, 0.005)), sphere_at({10, -1, 0}, 0.5, diffuse(-10), 0.1)});
  const EchoGrid grid = echoes_of(GetParam(), scene, sonar, {0, 0, 0});
  double port = 0, starboard = 0;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    double& side = sonar.beam_azimuth(beam) > 0 ? port : starboard;
    for (const float value : grid.energy(2, beam)) {
      side += value;
    }
  }
  ASSERT_GT(port, 0);
  EXPECT_NEAR(starboard / port, 1, 1e-5);
}

// A sphere is a mirror that makes sound diverge. A small plate of area A that faces the reflected ray, insonified and
// received by way of a sphere of radius a, has the level mu A G^2 with 1/G = r^2 (1 + p (1/r + 2/(a cos t))) (1 + p
// (1/r + 2 cos t/a)), where r is the range of the reflection, t the angle of incidence and p the distance from the
// reflection to the plate (Deschamps, Proc. IEEE 60, 1022 (1972)).
TEST_P(MultipathTest, SpheresSpreadSoundBothWays) {
  const double a = 1, turned = 35 * kDegree, across = 4;
  const Vec3 centre(10, 0, 0), normal(-std::cos(turned), 0, std::sin(turned));
  const Vec3 mirror = centre + a * normal, direction = mirror.normalized();
  const Vec3 reflected = direction - 2 * direction.dot(normal) * normal;
  const double r = mirror.norm(), cosine = -direction.dot(normal);
  const double gain = 1 / (r * r * (1 + across * (1 / r + 2 / (a * cosine))) * (1 + across * (1 / r + 2 * cosine / a)));
  const double elevation = std::asin(direction.z());
  SonarConfig sonar = tall_sonar(1.2);
  sonar.azimuth_aperture = 1.2 * kDegree;
  sonar.elevation_center = elevation;
  sonar.sampling = {16, 400};
  const double side = 0.3;
  const Eigen::Quaterniond facing = rotation_between(Vec3::UnitX(), -reflected);
  const Scene scene = scene_of_all({sphere_at(centre, a, glinting(0.9, 0.005), 0.05),
                                    scene_of(make_plane(Vec3::UnitX(), side, side), diffuse(-20),
                                             {.position = mirror + across * reflected, .orientation = facing})});
  const EchoGrid grid = echoes_of(GetParam(), scene, sonar, Vec3::Zero());
  const double expected = 0.01 * side * side * std::pow(0.9, 4) * gain * gain;
  EXPECT_NEAR(level_db(grid, sonar, 3, r + across), 10 * std::log10(expected), 0.3);
}

// At its limb a smooth sphere spreads the sound of one sample over metres of the floor behind. At the default sampling
// these few samples must not stand out as spots: no bin is far above what many samples make of the same haze.
TEST_P(MultipathTest, HazeBehindASphereHasNoSpotsAtTheDefaultSampling) {
  SonarConfig sonar;
  sonar.beam_count = 96;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.elevation_aperture = 12 * kDegree;
  sonar.elevation_center = -15 * kDegree;
  sonar.bin_count = 400;
  sonar.min_range = 0.5;
  sonar.max_range = 20;
  const Scene scene =
      scene_of_all({seabed_at(-2.5, diffuse(-27)), sphere_at({8, 0, -2}, 0.5, glinting(0.94, 0.1), 0.04)});
  const auto strongest_behind = [&](Sampling sampling) {
    sonar.sampling = sampling;
    const EchoGrid grid = echoes_of(GetParam(), scene, sonar, Vec3::Zero());
    float strongest = 0;
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      for (int bin = 0; bin < sonar.bin_count; ++bin) {
        strongest = std::max(strongest, sonar.bin_range(bin) > 14 ? grid.energy(2, beam)[bin] : 0.0F);
      }
    }
    return 10 * std::log10(strongest);
  };
  const auto many = strongest_behind({32, 1600});
  ASSERT_TRUE(std::isfinite(many));
  EXPECT_NEAR(strongest_behind(Sampling()), many, 1.5);
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, MultipathTest, testing::Values(kRays, kRaster), kName);
INSTANTIATE_TEST_SUITE_P(Methods, ElevationMultipathTest, testing::Values(kReference, kRays), kName);

}  // namespace
}  // namespace insonify::validation::multipath_test
