// point_ghosts_test.cpp -- echoes of points by way of plane mirrors: the water's surface, floors and walls, and two of
// them (T9 of docs/concepts/physics-tests.md).

#include <complex>
#include <numbers>

#include "validation/calibrated_scene.h"

namespace insonify::validation::point_ghosts_test {
namespace {

class PointGhostTest : public testing::TestWithParam<Method> {};

SonarConfig fan() {
  SonarConfig sonar;
  sonar.min_range = 0;
  sonar.max_range = 25;
  return sonar;
}

// T9 for points, by the method of image sources (docs/concepts/multipath.md).
struct MirroredPoint {
  Vec3 sonar, point;
  double level;                                // Level of the surface.
  double direct, once, twice;                  // Ranges: direct, by way of the surface one way, and both ways.
  double once_coherent_db, once_db, twice_db;  // Levels re the direct echo. The amplitudes of the two reciprocal echoes
                                               // add (coherent), or their intensities.
};
const MirroredPoint kMirrored[] = {
    {{0, 0, -5}, {10, 0, -4}, 0, 10.04987562112089, 11.7517498340973, 13.45362404707371, 3.487, 0.477, -5.067},
    {{0, 0, -1}, {20, 0, -1}, 0, 20, 20.04987562112089, 20.09975124224178, 5.977, 2.967, -0.086},
    {{0, 0, -2}, {15, 3, -1}, 0, 15.329709716755891, 15.459083492437895, 15.588457268119896, 5.875, 2.865, -0.291}};

TEST_P(PointGhostTest, SurfaceShowsItsGhosts) {
  SonarConfig sonar = fan();
  sonar.elevation_aperture = 100 * kDegree;
  sonar.beam_count = 8;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.bin_count = 2500;  // Bins of 1 cm.
  for (const MirroredPoint& scene : kMirrored) {
    for (const bool coherent : {false, true}) {
      sonar.position = scene.sonar;
      Scenario scenario = calibrated(sonar, GetParam());
      scenario.secondary = SecondaryEchoes::kAll;
      scenario.max_surfaces = 3;
      scenario.surface = SeaSurface{.level = scene.level};
      scenario.receiver.speckle = coherent;
      scenario.points = {{.position = scene.point}};
      const auto received = [&](double range) {
        const Ping ping = ping_of(scenario, {});
        double sum = 0;
        for (int beam = 0; beam < sonar.beam_count; ++beam) {
          const int bin = static_cast<int>(range / sonar.bin_length());
          for (const int near : {bin - 1, bin, bin + 1}) {  // 20 m is at an edge.
            sum += ping.intensity[ping.index(near, beam)];
          }
        }
        return 10 * std::log10(sum);
      };
      const double direct = -40 * std::log10(scene.direct);
      EXPECT_NEAR(received(scene.direct), direct, 0.001);
      EXPECT_NEAR(received(scene.once), direct + (coherent ? scene.once_coherent_db : scene.once_db), 0.001);
      EXPECT_NEAR(received(scene.twice), direct + scene.twice_db, 0.001);
      scenario.max_surfaces = 2;
      EXPECT_LT(received(scene.twice), -200);
      EXPECT_NEAR(received(scene.once), direct + (coherent ? scene.once_coherent_db : scene.once_db), 0.001);
      scenario.secondary = SecondaryEchoes::kNone;
      EXPECT_LT(received(scene.once), -200);
    }
  }
}

// Lloyd's mirror: all echoes interfere in one bin, and each reflection at the calm surface (R = -1) inverts the phase.
TEST_P(PointGhostTest, CalmSurfaceInvertsThePhase) {
  SonarConfig sonar = fan();
  sonar.frequency = 10e3;
  sonar.position = {0, 0, -1};
  sonar.elevation_aperture = 20 * kDegree;
  sonar.azimuth_aperture = 8 * kDegree;
  sonar.beam_count = 8;
  sonar.bin_count = 25;  // Bins of 1 m.
  sonar.sampling = {1, 20};
  for (const double distance : {20.1, 20.3, 20.6}) {
    Scenario scenario = calibrated(sonar, GetParam());
    scenario.water.sound_speed = 1500;
    scenario.secondary = SecondaryEchoes::kAll;
    scenario.surface = SeaSurface{};
    scenario.receiver.speckle = true;
    scenario.points = {{.position = {distance, 0.2, -1}}};
    const double near = std::hypot(distance, 0.2), far = std::hypot(near, 2);
    const auto wave = [](double amplitude, double range) {
      return std::polar(amplitude, 2 * std::numbers::pi * 2 * 10e3 / 1500 * range);
    };
    const double expected = std::norm(wave(1 / (near * near), near) - wave(2 / (near * far), 0.5 * (near + far)) +
                                      wave(1 / (far * far), far));
    EXPECT_NEAR(total_db(ping_of(scenario, {})), 10 * std::log10(expected), 0.02) << distance;
  }
}

// Between a calm surface at z = 0 (R = -1) and a floor at z = -8 of R = .6: legs by the sums over image sources.
struct Channel {
  Vec3 sonar, point;

  // Lengths of the straight leg and of those by surface and floor.
  [[nodiscard]] std::array<double, 3> lengths() const {
    const double along = std::hypot(point.x() - sonar.x(), point.y() - sonar.y());
    return {std::hypot(along, point.z() - sonar.z()), std::hypot(along, -point.z() - sonar.z()),
            std::hypot(along, -16 - point.z() - sonar.z())};
  }
};
constexpr double kFloor = 0.6;
const Channel kChannel{{0, 0, -5}, {11, 1, -6.1}};

Scene channel_floor(double size = 60, double rms_height = 0) {
  Material material = glinting(kFloor, 0.02);
  material.rms_height = rms_height;
  return scene_of(make_plane(Vec3::UnitZ(), size, size), material, {.position = {5, 0, -8}});
}

Scenario channel_scenario(const Method& method) {
  SonarConfig sonar = fan();
  sonar.position = kChannel.sonar;
  sonar.sampling = {4, 200};
  sonar.elevation_aperture = 110 * kDegree;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.beam_count = 8;
  sonar.bin_count = 2500;  // Bins of 1 cm.
  Scenario scenario = calibrated(sonar, method);
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.max_surfaces = 3;
  scenario.surface = SeaSurface{};
  scenario.points = {{.position = kChannel.point, .target_strength_db = -7}};
  return scenario;
}

// What the point adds to a ping at a range [dB].
double added_by_point(const Scenario& scenario, const Scene& scene, double range) {
  Scenario without = scenario;
  without.points.clear();
  const std::vector<double> all = by_range(ping_of(scenario, scene)), rest = by_range(ping_of(without, scene));
  const auto bin = static_cast<std::size_t>(range / scenario.sonars[0].bin_length());
  double sum = 0;
  for (std::size_t near = bin - 1; near <= bin + 1; ++near) {
    sum += all[near] - rest[near];
  }
  return 10 * std::log10(std::max(sum, 1e-30));
}

TEST_P(PointGhostTest, FloorShowsItsGhostsAndPathsByFloorAndSurface) {
  const Scenario scenario = channel_scenario(GetParam());
  const Scene scene = channel_floor();
  const auto [straight, surface, floor] = kChannel.lengths();
  const auto level = [](double share, double out, double back) {
    return -7 + 10 * std::log10(share) - 20 * std::log10(out * back);
  };
  const double loss = kFloor * kFloor;
  EXPECT_NEAR(added_by_point(scenario, scene, straight), level(1, straight, straight), 0.01);
  EXPECT_NEAR(added_by_point(scenario, scene, 0.5 * (straight + floor)), level(2 * loss, straight, floor), 0.01);
  EXPECT_NEAR(added_by_point(scenario, scene, floor), level(loss * loss, floor, floor), 0.01);
  EXPECT_NEAR(added_by_point(scenario, scene, 0.5 * (surface + floor)), level(2 * loss, surface, floor), 0.01);
  Scenario two = scenario;
  two.max_surfaces = 2;
  EXPECT_NEAR(added_by_point(two, scene, 0.5 * (straight + floor)), level(2 * loss, straight, floor), 0.01);
  EXPECT_LT(added_by_point(two, scene, 0.5 * (surface + floor)), -150);
}

// All echoes in one bin: the field is the square of the sum over all legs, out and back.
TEST_P(PointGhostTest, AllPathsBetweenFloorAndSurfaceInterfere) {
  Scenario scenario = channel_scenario(GetParam());
  scenario.sonars[0].frequency = 12e3;
  scenario.sonars[0].bin_count = 1;
  scenario.sonars[0].sampling = {1, 20};
  scenario.water.sound_speed = 1490;
  scenario.receiver.speckle = true;
  const Scene scene = channel_floor();
  for (const double x : {10.0, 10.7, 12.9}) {
    const Channel channel{kChannel.sonar, {x, 1, -6.1}};
    scenario.points = {{.position = channel.point, .target_strength_db = 30}};  // Louder than the floor itself.
    const auto [straight, surface, floor] = channel.lengths();
    const auto wave = [](double amplitude, double length) {
      return std::polar(amplitude / length, 2 * std::numbers::pi * 12e3 / 1490 * length);
    };
    const double field = std::abs(wave(1, straight) + wave(-1, surface) + wave(kFloor, floor));
    EXPECT_NEAR(total_db(ping_of(scenario, scene)), 30 + 40 * std::log10(field), 0.05) << x;
  }
}

// The floor reflects the point at x = 5.16 (3 m and 1.9 m above it). A floor that ends before, or whose mirror is
// behind something, shows nothing; a rough one e^-g, g = 4 k^2 h^2 cos^2; and a small one the share (A cos / (lambda
// rho))^2.
TEST_P(PointGhostTest, GhostsInAFloorFollowItsExtentAndRoughness) {
  const Scenario scenario = channel_scenario(GetParam());
  const auto [straight, surface, floor] = kChannel.lengths();
  const double far = floor;  // Bindings cannot be captured.
  const double expected = -7 + 40 * std::log10(kFloor) - 40 * std::log10(far);
  const auto both_ways = [&](const Scene& scene) { return added_by_point(scenario, scene, far) - expected; };
  const double cosine = 4.9 / far;
  const Vec3 bounce = kChannel.sonar + 3 / 4.9 * (Vec3(11, 1, -9.9) - kChannel.sonar);

  Scene floor_beside = channel_floor(20);
  floor_beside.instances[0].world_from_mesh.position.x() = bounce.x() - 10.1;
  EXPECT_LT(both_ways(floor_beside), -100);
  const Scene covered = scene_of_all(
      {channel_floor(), scene_of(make_sphere(0.1), diffuse(-200), {.position = 0.5 * (bounce + kChannel.point)})});
  EXPECT_LT(both_ways(covered), -60);

  const double wave = 2 * std::numbers::pi * scenario.sonars[0].frequency / 1500;
  Scenario given = scenario;
  given.water.sound_speed = 1500;
  const double height = 2e-4, rayleigh = std::pow(2 * wave * height * cosine, 2);
  EXPECT_NEAR(added_by_point(given, channel_floor(60, height), far) - expected,
              -20 * std::log10(std::exp(1)) * rayleigh, 0.02);

  Scene small = channel_floor(0.04);
  small.instances[0].world_from_mesh.position = {bounce.x(), bounce.y(), -8};
  const double out = 3 / 4.9 * far, rho = out * (far - out) / far;
  const double share = 0.04 * 0.04 * cosine * wave / (2 * std::numbers::pi * rho);
  EXPECT_NEAR(added_by_point(given, small, far) - expected, 40 * std::log10(share), 0.02);
}

// The ghost is 42 degrees up, outside a level fan of 20 degrees. A plate under the surface blocks the ghost, and a
// plate in front of the point blocks the direct path.
TEST_P(PointGhostTest, GhostsNeedAClearPathWithinTheAperture) {
  SonarConfig sonar = fan();
  sonar.position = {0, 0, -5};
  Scenario scenario = calibrated(sonar, GetParam());
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.max_surfaces = 3;
  scenario.surface = SeaSurface{};
  scenario.points = {{.position = {10, 0, -4}}};
  const double direct = -40 * std::log10(10.04987562112089);
  EXPECT_NEAR(total_db(ping_of(scenario, {})), direct, 1e-3);
  scenario.sonars[0].elevation_aperture = 100 * kDegree;
  EXPECT_GT(total_db(ping_of(scenario, {})), direct + 2);
  const auto plate = [](double height) {
    return scene_of(make_plane(Vec3::UnitZ(), 2, 2), diffuse(-200), {.position = {5.5, 0, height}});
  };
  EXPECT_NEAR(total_db(ping_of(scenario, plate(-0.1))), direct, 1e-3);
  // Only the echo by way of the surface both ways remains, at the range of the image.
  const Scene wall = scene_of(make_plane(Vec3::UnitX(), 0.2, 0.2), diffuse(-200), {.position = {9, 0, -4.1}});
  EXPECT_NEAR(total_db(ping_of(scenario, wall)), -40 * std::log10(13.45362404707371), 1e-3);
}

// With waves, the intensity of a leg over the water is an exponential number x from ping to ping, the same out and
// back. The two echoes with one such leg are in phase: 4 x times the intensity of one. That with two has x^2, of the
// mean 2: 3.01 dB more than without speckle, where nothing interferes.
TEST_P(PointGhostTest, WavesMakeItsGhostsFluctuate) {
  SonarConfig sonar = fan();
  sonar.position = {0, 0, -5};
  sonar.elevation_aperture = 100 * kDegree;
  sonar.bin_count = 250;
  sonar.beam_count = 4;
  sonar.azimuth_aperture = 20 * kDegree;
  sonar.sampling = {1, 20};
  Scenario scenario = calibrated(sonar, GetParam());
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.surface = SeaSurface{};
  scenario.receiver.speckle = true;
  scenario.points = {{.position = {10, 0, -4}, .target_strength_db = 40}};
  const auto level = [&](const Ping& ping, double range = 11.7517498340973) {
    double sum = 0;
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      sum += ping.intensity[ping.index(static_cast<int>(range / sonar.bin_length()), beam)];
    }
    return sum;
  };
  constexpr double kTwice = 13.45362404707371;
  Simulator calm(scenario, {}, 1);
  EXPECT_EQ(level(calm.make_ping(0, 0)), level(calm.make_ping(0, 1)));
  scenario.receiver.speckle = false;
  const Ping without_waves = ping_of(scenario, {});
  scenario.surface->wind_speed = 1;
  const Ping means = ping_of(scenario, {});
  const double loss = level(means) / level(without_waves);  // Of the surface, once.
  EXPECT_NEAR(level(means, kTwice) / level(without_waves, kTwice), loss * loss, 0.01 * loss * loss);
  const double mean = 2 * level(means);
  scenario.receiver.speckle = true;
  Simulator rough(scenario, {}, 1);
  constexpr int kPings = 2000;
  double sum = 0, squares = 0;
  for (int i = 0; i < kPings; ++i) {
    const Ping ping = rough.make_ping(0, i);
    const double ratio = level(ping) / mean;
    sum += ratio, squares += ratio * ratio;
    EXPECT_NEAR(level(ping, kTwice) / level(means, kTwice), ratio * ratio, 1e-3 + 0.01 * ratio * ratio);
  }
  EXPECT_NEAR(sum / kPings, 1, 0.1);
  EXPECT_NEAR(squares / kPings / std::pow(sum / kPings, 2), 2, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Methods, PointGhostTest, testing::Values(kReference, kRays),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace insonify::validation::point_ghosts_test
