// point_test.cpp -- ideal points: position, level, occlusion and ghosts; thermal noise and volume reverberation (T8,
// T9, T17, T23, T24 of docs/concepts/physics-tests.md).

#include <complex>
#include <numbers>

#include "validation/calibrated_scene.h"

namespace insonify::validation {
namespace {

class PointTest : public testing::TestWithParam<Method> {};

Vec3 at(double range, double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kDegree, elevation = elevation_deg * kDegree;
  return range *
         Vec3(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
}

SonarConfig fan() {
  SonarConfig sonar;
  sonar.min_range = 0;
  sonar.max_range = 25;
  return sonar;
}

// Beam and bin of the strongest cell.
std::pair<int, int> peak(const Ping& ping) {
  const auto strongest = std::ranges::max_element(ping.intensity) - ping.intensity.begin();
  return {static_cast<int>(strongest % ping.beam_count), static_cast<int>(strongest / ping.beam_count)};
}

// T8.
TEST_P(PointTest, ShowsWhereItIsAtItsLevel) {
  for (const double azimuth : {-50.0, -30.0, 0.1, 25.3, 50.0}) {
    Scenario scenario = calibrated(fan(), GetParam());
    scenario.points = {{.position = at(15.02, azimuth, 3), .target_strength_db = -20}};
    const Ping ping = ping_of(scenario, {});
    const auto [beam, bin] = peak(ping);
    EXPECT_NEAR(fan().beam_azimuth(beam) / kDegree, azimuth, 0.5 * 120 / 256 + 1e-9);
    EXPECT_NEAR(fan().bin_range(bin), 15.02, 0.5 * fan().bin_length() + 1e-9);
    EXPECT_NEAR(total_db(ping), -20 - 40 * std::log10(15.02), 1e-4);
  }
}

// T17, without speckle.
TEST_P(PointTest, TwoAtEqualRangeAndAzimuthAreTwiceOne) {
  Scenario scenario = calibrated(fan(), GetParam());
  scenario.points = {{.position = at(10.01, 20, 8)}};
  const Ping one = ping_of(scenario, {});
  scenario.points.push_back({.position = at(10.01, 20, -8)});
  const Ping two = ping_of(scenario, {});
  EXPECT_EQ(peak(one), peak(two));
  EXPECT_NEAR(total_db(two) - total_db(one), 10 * std::log10(2), 0.02);
}

TEST_P(PointTest, NothingIsReceivedFromBehindAWallOrOutsideTheAperture) {
  Scenario scenario = calibrated(fan(), GetParam());
  scenario.points = {{.position = at(12, 0, 0)}};
  const Scene scene = plate_at(10, 1, diffuse(-200));
  EXPECT_LT(total_db(ping_of(scenario, scene)), -200);
  scenario.points = {{.position = at(9, 0, 0)}};
  EXPECT_GT(total_db(ping_of(scenario, scene)), -40);
  scenario.points = {{.position = at(9, 0, 11)}, {.position = at(9, 61, 0)}, {.position = at(26, 0, 0)}};
  EXPECT_LT(total_db(ping_of(scenario, scene)), -200);
}

TEST_P(PointTest, GainCompensatesItsRange) {
  for (const double range : {3.01, 21.01}) {
    Scenario scenario = calibrated(fan(), GetParam());
    scenario.water.absorption = true;
    scenario.receiver.time_varied_gain = 40;
    scenario.points = {{.position = at(range, 5, 0), .target_strength_db = -12}};
    EXPECT_NEAR(total_db(ping_of(scenario, {})), -12, 0.15) << range;  // Gain is that of the bin's middle.
  }
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

TEST_P(PointTest, SurfaceShowsItsGhosts) {
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
TEST_P(PointTest, CalmSurfaceInvertsThePhase) {
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

TEST_P(PointTest, FloorShowsItsGhostsAndPathsByFloorAndSurface) {
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
TEST_P(PointTest, AllPathsBetweenFloorAndSurfaceInterfere) {
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
TEST_P(PointTest, GhostsInAFloorFollowItsExtentAndRoughness) {
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
TEST_P(PointTest, GhostsNeedAClearPathWithinTheAperture) {
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

// With waves, the intensity of a ghost is exponentially distributed from ping to ping. Without speckle it is the mean.
TEST_P(PointTest, WavesMakeItsGhostsFluctuate) {
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
  const int ghost = static_cast<int>(13.45362404707371 / sonar.bin_length());
  const auto level = [&](const Ping& ping) {
    double sum = 0;
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      sum += ping.intensity[ping.index(ghost, beam)];
    }
    return sum;
  };
  Simulator calm(scenario, {}, 1);
  EXPECT_EQ(level(calm.make_ping(0, 0)), level(calm.make_ping(0, 1)));
  scenario.surface->wind_speed = 1;
  scenario.receiver.speckle = false;
  const double mean = level(Simulator(scenario, {}, 1).make_ping(0, 0));
  scenario.receiver.speckle = true;
  Simulator rough(scenario, {}, 1);
  constexpr int kPings = 2000;
  double sum = 0, squares = 0;
  for (int i = 0; i < kPings; ++i) {
    const double ratio = level(rough.make_ping(0, i)) / mean;
    sum += ratio, squares += ratio * ratio;
  }
  EXPECT_NEAR(sum / kPings, 1, 0.1);
  EXPECT_NEAR(squares / kPings / std::pow(sum / kPings, 2), 2, 0.3);
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, PointTest, testing::Values(kReference, kRays), kName);

// T23. Empty water: without noise nothing; with noise, thermal noise with exponentially distributed intensity and the
// mean level NL + 10 log10 B - DI - SL.
TEST(ThermalNoiseTest, HasItsLevelAndItsStatistics) {
  SonarConfig sonar = fan();
  sonar.frequency = 720e3;
  sonar.beam_count = 120;  // Beams of 1 x 20 degrees.
  sonar.source_level_db = 200;
  sonar.bandwidth = 25e3;
  Scenario scenario = calibrated(sonar, kRays);
  EXPECT_EQ(total_db(ping_of(scenario, {})), -std::numeric_limits<double>::infinity());

  scenario.receiver.noise = true;
  const Ping ping = ping_of(scenario, {});
  double sum = 0, squares = 0;
  for (const double value : ping.intensity) {
    sum += value;
    squares += value * value;
  }
  const double n = static_cast<double>(ping.intensity.size()), mean = sum / n;
  EXPECT_NEAR(10 * std::log10(mean), -147.04027, 10 * std::log10(1 + 4 / std::sqrt(n)));
  EXPECT_NEAR(std::sqrt(squares / n / (mean * mean) - 1), 1, 0.02);

  scenario.receiver.ambient_noise_db = 55;
  const double thermal = std::pow(10.0, -147.04027 / 10), more = std::pow(10.0, (55 + 43.97940 - 33.14573 - 200) / 10);
  double loud = 0;
  for (const double value : ping_of(scenario, {}).intensity) {
    loud += value;
  }
  EXPECT_NEAR(10 * std::log10(loud / n / (thermal + more)), 0, 10 * std::log10(1 + 4 / std::sqrt(n)) + 0.01);
  scenario.receiver.ambient_noise_db.reset();

  Simulator simulator(scenario, {}, 2);
  EXPECT_EQ(simulator.make_ping(0, 0).intensity, ping.intensity);
  EXPECT_NE(simulator.make_ping(0, 1).intensity, ping.intensity);
}

// T24. Volume reverberation I = s_v Psi (1/r1 - 1/r2) falls by 20 dB per decade; behind a wall there is none.
TEST(VolumeReverberationTest, FallsWithTheSquareOfRange) {
  SonarConfig sonar;
  sonar.beam_count = 20;  // Beams of 1 x 20 degrees.
  sonar.azimuth_aperture = 20 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 25;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.volume_backscatter_db = -70;
  const Ping ping = ping_of(scenario, {});
  EXPECT_NEAR(cell_db(ping, 100, 7), -119.20713784852252, 0.01);
  EXPECT_NEAR(cell_db(ping, 200, 7), -125.20618464154067, 0.01);
  EXPECT_NEAR(cell_db(ping, 400, 7), -131.2159677501773, 0.01);

  const Ping walled = ping_of(scenario, plate_at(10, 20, diffuse(-200)));
  EXPECT_NEAR(cell_db(walled, 100, 7), cell_db(ping, 100, 7), 0.01);
  EXPECT_LT(cell_db(walled, 300, 7), -160);
  const int bin = 199;  // In the bin of the wall, half of the water is in front of it.
  EXPECT_GT(cell_db(walled, bin + 1, 10), -160);
  EXPECT_LT(cell_db(walled, bin + 1, 10), cell_db(ping, bin + 1, 10) - 1);

  // A point target does not shadow the water behind it.
  scenario.points = {{.position = {5.02, 0.05, 0}, .target_strength_db = -150}};
  const Ping pointed = ping_of(scenario, {});
  EXPECT_EQ(cell_db(pointed, 300, 9), cell_db(ping, 300, 9));

  // A wrong assumed sound speed shifts the ranges of bins; the echo of the water at the true range is unchanged.
  scenario.points.clear();
  scenario.water.sound_speed = 1500;
  scenario.sonars[0].assumed_sound_speed = 1600;
  scenario.sonars[0].steering = Steering::kLens;  // A line's beams would be narrower.
  const double true_range = 15.025 * 1500 / 1600;
  EXPECT_NEAR(cell_db(ping_of(scenario, {}), 300, 7),
              cell_db(ping, 300, 7) + 20 * std::log10(15.025 / true_range) + 10 * std::log10(1500.0 / 1600), 0.01);
}

}  // namespace
}  // namespace insonify::validation
