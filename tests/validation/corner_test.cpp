// corner_test.cpp -- echoes of corners of three mirrors, crossed with the array, pulse, absorption, roughness, motion,
// wind and random walks (docs/concepts/multipath.md, "Corners of three mirrors").

#include <complex>
#include <numbers>

#include "base/rotation_between.h"
#include "echo/trihedral.h"
#include "validation/calibrated_scene.h"
#include "validation/walk_scene.h"

namespace insonify::validation::corner_test {
namespace {

class CornerEchoTest : public testing::TestWithParam<Method> {};

constexpr double kFrequency = 430e3, kSpeed = 1480, kEdge = 0.12, kRange = 8.3;

// At a place, with its axis of symmetry towards the origin.
Pose facing_sonar(const Vec3& place) {
  return {.position = place, .orientation = rotation_between(Vec3::Ones(), -place)};
}

const Vec3 kPlace = kRange * Vec3(std::cos(0.3), std::sin(0.3), 0.05).normalized();

Material mirror(double reflection) {
  return glinting(reflection, 0.03);
}

SonarConfig corner_fan() {
  SonarConfig sonar;
  sonar.frequency = kFrequency;
  sonar.min_range = 0;
  sonar.max_range = 12;
  sonar.bin_count = 600;
  sonar.beam_count = 64;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.elevation_aperture = 30 * kDegree;
  return sonar;
}

Scenario corner_scenario(const Method& method) {
  Scenario scenario = calibrated(corner_fan(), method);
  scenario.water.sound_speed = kSpeed;
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.max_surfaces = 3;
  return scenario;
}

// Level of all beams within a bin of a range.
double level_at(const Ping& ping, double range) {
  const std::vector<double> sums = by_range(ping);
  const auto bin = static_cast<std::size_t>(range / (12.0 / 600));
  return 10 * std::log10(sums[bin - 1] + sums[bin] + sums[bin + 1]);
}

// TS = 10 log10 (3 a^4 / lambda^2) = 17.200 dB: a^4 = 2.0736e-4, lambda = 3.44186 mm. At 8.3 m the edges of the outline
// are a sqrt(2/3) = 98 mm off, k R^2 / r = 2.1 at most: the far field's level is not reached. Outline by the hexagon's
// mean wave: summed by hand as Kirchhoff's integral over small squares.
double expected_level(double reflection) {
  const double lambda = kSpeed / kFrequency, k = 2 * std::numbers::pi / lambda;
  const double side = kEdge * std::sqrt(2.0 / 3), apothem = side * std::sqrt(3.0) / 2;
  constexpr int kSquares = 400;
  const double step = 2 * side / kSquares;
  double re = 0, im = 0;
  for (int i = 0; i < kSquares; ++i) {
    for (int j = 0; j < kSquares; ++j) {
      const double x = -side + (i + 0.5) * step, y = -side + (j + 0.5) * step;
      bool inside = true;
      for (int n = 0; n < 3; ++n) {
        const double angle = n * std::numbers::pi / 3;
        inside = inside && std::abs(x * std::cos(angle) + y * std::sin(angle)) < apothem;
      }
      re += inside ? std::cos(k * (x * x + y * y) / kRange) : 0;
      im += inside ? std::sin(k * (x * x + y * y) / kRange) : 0;
    }
  }
  const double amplitude = std::hypot(re, im) * step * step / (lambda * kRange * kRange);
  return 20 * std::log10(amplitude) + 60 * std::log10(reflection);
}

TEST_P(CornerEchoTest, HasItsLevelWhereItIs) {
  const Scene scene = scene_of(trihedral(kEdge, true), mirror(0.8), facing_sonar(kPlace));
  const Ping ping = ping_of(corner_scenario(GetParam()), scene);
  EXPECT_NEAR(level_at(ping, kRange), expected_level(0.8), 0.1);
  // Without paths over three surfaces there is next to nothing there.
  Scenario less = corner_scenario(GetParam());
  less.max_surfaces = 2;
  EXPECT_LT(level_at(ping_of(less, scene), kRange), expected_level(0.8) - 20);
  less.secondary = SecondaryEchoes::kNone;
  EXPECT_LT(level_at(ping_of(less, scene), kRange), expected_level(0.8) - 20);
}

TEST_P(CornerEchoTest, GoesThroughArrayPulseAndAbsorption) {
  const Scene scene = scene_of(trihedral(kEdge, true), mirror(0.8), facing_sonar(kPlace));
  Scenario scenario = corner_scenario(GetParam());
  scenario.primary = PrimaryEchoes::kAuto;  // Rasterised primaries have no elevation pattern.
  scenario.water.absorption = true;
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  scenario.receiver.elevation_pattern = BeamPattern::kRectangular;
  scenario.receiver.pulse = PulseKind::kCw;
  scenario.receiver.pulse_duration = 40e-6;  // 3 cm of range.
  const Ping corner = ping_of(scenario, scene);
  // As a point of its target strength does, cell by cell.
  Scenario with_point = scenario;
  with_point.points = {{.position = kPlace, .target_strength_db = expected_level(0.8) + 40 * std::log10(kRange)}};
  const Ping point = ping_of(with_point, {});
  const auto strongest = std::ranges::max_element(point.intensity) - point.intensity.begin();
  for (const auto cell : {strongest, strongest + 1, strongest - point.beam_count}) {
    EXPECT_NEAR(10 * std::log10(corner.intensity[cell] / point.intensity[cell]), 0, 0.15);
  }
}

// Whatever the direction, the squares of its cosines add up to 1: the three mirrors lose together what one loses at
// normal incidence, 4 k^2 h^2 nepers. .1 mm at 430 kHz: 4 (1825.5 x 1e-4)^2 = .13330 -> .5789 dB.
TEST_P(CornerEchoTest, RoughMirrorsLoseItsCoherentEcho) {
  Material rough = mirror(0.8);
  rough.rms_height = 1e-4;
  Scenario scenario = corner_scenario(GetParam());
  const Pose pose = facing_sonar(kPlace);
  const double smooth = level_at(ping_of(scenario, scene_of(trihedral(kEdge, true), mirror(0.8), pose)), kRange);
  const Scene scene = scene_of(trihedral(kEdge, true), rough, pose);
  EXPECT_NEAR(level_at(ping_of(scenario, scene), kRange) - smooth, -0.5789, 0.03);
  scenario.rough_mirrors = true;
  EXPECT_LT(level_at(ping_of(scenario, scene), kRange), smooth - 20);
}

TEST_P(CornerEchoTest, IsHiddenBehindThingsAndFromOutside) {
  const Scene open = scene_of(trihedral(kEdge, true), mirror(0.8), facing_sonar(kPlace));
  Scene blocked = scene_of_all({open, scene_of(make_sphere(0.05), diffuse(-200), {.position = 0.5 * kPlace})});
  EXPECT_LT(level_at(ping_of(corner_scenario(GetParam()), blocked), kRange), expected_level(0.8) - 20);
  Pose turned = facing_sonar(kPlace);
  turned.orientation = turned.orientation * orientation_from_rpy(std::numbers::pi, 0, 0);
  const Scene away = scene_of(trihedral(kEdge, true), mirror(0.8), turned);
  EXPECT_LT(level_at(ping_of(corner_scenario(GetParam()), away), kRange), expected_level(0.8) - 20);
}

TEST_P(CornerEchoTest, MovesWithItsObject) {
  const Scene scene = scene_of(trihedral(kEdge, true), mirror(0.8), facing_sonar(kPlace));
  const std::string name = scene.instances[0].name;
  Simulator simulator(corner_scenario(GetParam()), scene, 2, std::vector<MovableObject>{{name}});
  EXPECT_NEAR(level_at(simulator.ping(0, {}), kRange), expected_level(0.8), 0.1);
  const Vec3 nearer = 0.6 * kPlace;
  const Ping moved = simulator.ping(0, {.moved = {{.name = name, .world_from_object = facing_sonar(nearer)}}});
  EXPECT_LT(level_at(moved, kRange), expected_level(0.8) - 20);
  const Scene there = scene_of(trihedral(kEdge, true), mirror(0.8), facing_sonar(nearer));
  EXPECT_NEAR(level_at(moved, 0.6 * kRange), level_at(ping_of(corner_scenario(GetParam()), there), 0.6 * kRange), 1e-3);
}

// Two walls of a basin with its floor, and with the water's surface: the sonar's image in the apex, 1/(2 r)^2, within
// Fresnel's ripples. Sonar at the origin; corner of the walls at (5, 3): apexes at r = sqrt(25 + 9 + 1.5^2) = 6.021 and
// sqrt(34 + 4) = 6.164.
TEST_P(CornerEchoTest, BasinHasOneWithItsFloorAndOneWithTheWaterSurface) {
  const auto wall = [](const Vec3& normal, const Vec3& position) {
    return scene_of(make_plane(normal, 14, 14), mirror(0.9), {.position = position});
  };
  const Scene basin = scene_of_all(
      {wall(-Vec3::UnitX(), {5, -2, 0}), wall(-Vec3::UnitY(), {0, 3, 0}), wall(Vec3::UnitZ(), {0, 0, -1.5})});
  const double floor_range = std::sqrt(36.25), surface_range = std::sqrt(38.0);
  Scenario scenario = corner_scenario(GetParam());
  scenario.sonars[0].azimuth_aperture = 100 * kDegree;
  scenario.sonars[0].elevation_aperture = 60 * kDegree;
  scenario.sonars[0].sampling = {4, 300};
  const auto more = [&] {  // Intensity that paths over three surfaces add at the two ranges.
    Scenario two = scenario;
    two.max_surfaces = 2;
    const Ping by_three = ping_of(scenario, basin), by_two = ping_of(two, basin);
    const auto at = [&](double range) {
      return std::pow(10, 0.1 * level_at(by_three, range)) - std::pow(10, 0.1 * level_at(by_two, range));
    };
    return std::pair(at(floor_range), at(surface_range));
  };
  const double floor = std::pow(0.9, 6) / (4 * floor_range * floor_range);
  const double surface = std::pow(0.9, 4) / (4 * surface_range * surface_range);
  const auto [dry_floor, dry_surface] = more();
  EXPECT_NEAR(10 * std::log10(dry_floor / floor), 0, 1);
  EXPECT_LT(dry_surface, 0.02 * surface);
  scenario.surface = SeaSurface{.level = 2};
  EXPECT_NEAR(10 * std::log10(more().second / surface), 0, 1);
  // Waves of centimetres leave nothing coherent.
  scenario.surface->wind_speed = 6;
  const auto [floor_in_waves, surface_in_waves] = more();
  EXPECT_LT(surface_in_waves, 0.1 * surface);
  EXPECT_NEAR(10 * std::log10(floor_in_waves / floor), 0, 1);
}

INSTANTIATE_TEST_SUITE_P(Methods, CornerEchoTest, testing::Values(kRays, kRaster, kReference),
                         [](const auto& test) { return test.param.name; });

// The water's surface inverts the phase, R = -1; a rigid plane in its place, R > 0, does not: fields at the apex, 6.164
// m away, are half a turn apart.
TEST(CornerPhaseTest, WaterInvertsIt) {
  const auto wall = [](const Vec3& normal, const Vec3& position) {
    return scene_of(make_plane(normal, 14, 14), mirror(0.9), {.position = position});
  };
  const std::vector<Scene> walls = {wall(-Vec3::UnitX(), {5, -2, 0}), wall(-Vec3::UnitY(), {0, 3, 0})};
  Scenario scenario = corner_scenario(kRays);
  scenario.sonars[0].azimuth_aperture = 100 * kDegree;
  scenario.sonars[0].elevation_aperture = 60 * kDegree;
  scenario.receiver.speckle = scenario.receiver.field = true;
  const auto at_apex = [&](const Scene& scene) {
    const Ping ping = ping_of(scenario, scene);
    const auto bin = static_cast<int>(std::sqrt(38.0) / 0.02);
    std::complex<double> strongest = 0;
    for (int beam = 0; beam < ping.beam_count; ++beam) {
      const std::complex<double> field = ping.field[ping.index(bin, beam)];
      strongest = std::abs(field) > std::abs(strongest) ? field : strongest;
    }
    return strongest;
  };
  const std::complex<double> rigid = at_apex(scene_of_all({walls[0], walls[1], wall(-Vec3::UnitZ(), {0, 0, 2})}));
  scenario.surface = SeaSurface{.level = 2};
  const std::complex<double> water = at_apex(scene_of_all(walls));
  EXPECT_NEAR(std::abs(std::arg(water / rigid)), std::numbers::pi, 0.2);
}

// What walks would add of three perpendicular smooth mirrors is left to the corner's echo; of rough ones they keep the
// share 1 - e^(-4 k^2 h^2).
TEST(CornerWalkTest, WalksLeaveTheCoherentShareToTheCorner) {
  const auto energy = [](double rms_height, bool corners) {
    Material material = glinting(0.95, 0.1);
    material.rms_height = rms_height;
    const Scene scene =
        scene_of_all({plane(-Vec3::UnitX(), {3, -97, 98}, material), plane(-Vec3::UnitY(), {-97, 3, 98}, material),
                      plane(Vec3::UnitZ(), {-97, -97, -2}, material)});
    SonarConfig sonar = corner_fan();
    sonar.azimuth_aperture = 120 * kDegree;
    sonar.elevation_aperture = 80 * kDegree;
    WalkScene walks("cpu", scene, {.sonar = sonar, .water = {.sound_speed = kSpeed, .absorption = false}}, Vec3::Zero(),
                    20'000);
    walks.world_from_sonar.orientation = orientation_from_rpy(0, 0, 45 * kDegree);
    static_cast<void>(walks.ping(0, {.corners = corners}));
    return walks.energy(3);
  };
  const double all = energy(0, false);
  EXPECT_GT(all, 0.003);  // The image in the apex, of .95^6 / (4 x 22) = 8.4e-3, as far as the fan sees it.
  const double rest = energy(0, true);
  EXPECT_LT(rest, 0.35 * all);  // MMM over two mirrors, one of them twice but not first and last.
  // h = .2 mm: the walks keep 1 - e^-.5332 of the corner's part. Their lobes of 0.1 turn directions by 0.2, so that
  // cos^2 at a mirror is off by 0.2 at most, and e^-g by 0.06.
  constexpr double kByLobes = 0.06;
  const double rough = energy(2e-4, false);
  EXPECT_NEAR((energy(2e-4, true) - rest) / (rough - rest), 1 - std::exp(-0.5332), kByLobes);
  EXPECT_EQ(rough, all);
  EXPECT_EQ(energy(0.01, true), all);
}

}  // namespace
}  // namespace insonify::validation::corner_test
