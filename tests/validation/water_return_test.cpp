// water_return_test.cpp -- echoes out by a mirror and back by the water's surface, against image sources
// (docs/concepts/multipath.md, "Return over the water's surface").

#include "base/rotation_between.h"
#include "validation/calibrated_scene.h"
#include "validation/walk_scene.h"

namespace insonify::validation::water_return_test {
namespace {

// A wall at y = 4 reflects onto a small plate, which scatters by Lambert's law. Surface at z = 0.
const Vec3 kSonar(0, 0, -2), kPlate(6, 1, -4), kNormal = Vec3(-0.6, 0.2, 0.77).normalized();
constexpr double kReflection = 0.7, kLambertDb = -12, kSide = 0.2;

// Images of the sonar in the wall and in the surface, and the way from the plate there.
const Vec3 kByWall = Vec3(0, 8, -2) - kPlate, kByWater = Vec3(0, 0, 2) - kPlate;
const double kRange = 0.5 * (kByWall.norm() + kByWater.norm());  // 8.989 m; other paths: 8.54 m and 9.43 m.

Scene wall() {
  return plane(-Vec3::UnitY(), {0, 4, 0}, glinting(kReflection, 0.02));
}

Scene plate() {
  const Pose pose{.position = kPlate, .orientation = rotation_between(Vec3::UnitZ(), kNormal)};
  return scene_of(make_plane(Vec3::UnitZ(), kSide, kSide), diffuse(kLambertDb), pose);
}

Scene wall_and_plate() {
  return scene_of_all({wall(), plate()});
}

Scenario by_water(const Method& method) {
  SonarConfig sonar;
  sonar.frequency = 300e3;
  sonar.position = kSonar;
  sonar.beam_count = 64;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.elevation_aperture = 100 * kDegree;
  sonar.min_range = 5;
  sonar.max_range = 12;
  sonar.bin_count = 350;
  sonar.sampling = {8, 800};
  Scenario scenario = calibrated(sonar, method);
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.max_surfaces = 3;
  scenario.surface = SeaSurface{};
  return scenario;
}

double near_range(const Ping& ping, double reach = 0.2) {
  const std::vector<double> sums = by_range(ping);
  double sum = 0;
  for (std::size_t bin = 0; bin < sums.size(); ++bin) {
    sum += std::abs(5.01 + 0.02 * static_cast<double>(bin) - kRange) < reach ? sums[bin] : 0;
  }
  return 10 * std::log10(std::max(sum, 1e-30));
}

// Two echoes of mu A cos cos |R|^2 / (L1^2 L2^2).
double expected_level() {
  const double in = kNormal.dot(kByWall.normalized()), out = kNormal.dot(kByWater.normalized());
  return kLambertDb + 20 * std::log10(kReflection) +
         10 * std::log10(2 * kSide * kSide * in * out / (kByWall.squaredNorm() * kByWater.squaredNorm()));
}

class WaterReturnTest : public testing::TestWithParam<Method> {};

TEST_P(WaterReturnTest, HasTheLevelAndBearingsOfImageSources) {
  Scenario scenario = by_water(GetParam());
  const Ping ping = ping_of(scenario, wall_and_plate());
  EXPECT_NEAR(near_range(ping), expected_level(), 0.3);
  // One echo arrives from the wall, at atan(7/6), the other below the surface, at atan(1/6).
  const auto bin = static_cast<int>((kRange - 5) / 0.02);
  for (const double azimuth : {std::atan2(7, 6), std::atan2(1, 6)}) {
    double sum = 0;
    for (int near = bin - 10; near <= bin + 10; ++near) {
      for (int beam = 0; beam < ping.beam_count; ++beam) {
        const bool here = std::abs(scenario.sonars[0].beam_azimuth(beam) - azimuth) < 3 * kDegree;
        sum += here ? ping.intensity[ping.index(near, beam)] : 0;
      }
    }
    EXPECT_NEAR(10 * std::log10(sum), expected_level() - 10 * std::log10(2), 0.3) << azimuth;
  }
  scenario.max_surfaces = 2;
  EXPECT_LT(near_range(ping_of(scenario, wall_and_plate())), expected_level() - 20);
}

TEST_P(WaterReturnTest, LosesAbsorptionAndVanishesBehindThings) {
  Scenario scenario = by_water(GetParam());
  const double calm = near_range(ping_of(scenario, wall_and_plate()));
  Scenario absorbing = scenario;
  absorbing.water.absorption = true;
  const double per_metre = absorbing.water_at(absorbing.filled_in(absorbing.sonars[0])).absorption_db_per_m_at(300e3);
  EXPECT_NEAR(near_range(ping_of(absorbing, wall_and_plate())) - calm, -2 * kRange * per_metre, 0.02);
  // Half-way between the plate and the surface, where no other of the paths is.
  const Vec3 in_the_way = kPlate + 0.35 * kByWater;
  const Scene blocked = scene_of_all({wall(), plate(), sphere_at(in_the_way, 0.2, diffuse(-200), 0.5)});
  EXPECT_LT(near_range(ping_of(scenario, blocked)), calm - 20);
}

// Waves leave the share e^-g coherent, g = 4 k^2 h^2 cos^2. A wind of 0.25 m/s makes waves of h = 0.21 x 0.0625 / 9.81
// / 4 = 0.33448 mm rms; k = 2 pi 300e3 / 1500 = 1256.64 per m, cos^2 = 36 / 73: g = 0.34852 -> 1.5136 dB. The bubbles
// of so little wind take 3e-3 dB. At 8 m/s h is 0.34 m, and nothing is left. What the surface itself scatters is the
// same without the plate.
TEST_P(WaterReturnTest, LosesItsCoherenceToWind) {
  Scenario scenario = by_water(GetParam());
  scenario.water.sound_speed = 1500;
  constexpr double kReach = 0.06;  // The glitter of waves out and back by them, from 8.54 m on, has faded there.
  const auto of_plate = [&](double wind) {
    scenario.surface->wind_speed = wind;
    const double with = std::pow(10, 0.1 * near_range(ping_of(scenario, wall_and_plate()), kReach));
    return with - std::pow(10, 0.1 * near_range(ping_of(scenario, wall()), kReach));
  };
  const double calm = of_plate(0);
  EXPECT_NEAR(10 * std::log10(of_plate(0.25) / calm), -1.5136, 0.03);
  EXPECT_LT(std::abs(of_plate(8)), 0.02 * calm);
}

// What arrives from the wall, at atan(7/6), was sent towards the surface, at atan(1/6), and the other way round: each
// has the transmitter's gain where it was sent, sinc^2(l sin) of a line of l = 0.88589 / (2 sin 40 deg) = 0.68910.
TEST_P(WaterReturnTest, IsSentInOneDirectionAndArrivesFromAnother) {
  const auto near = [](const Ping& ping, const SonarConfig& sonar, double azimuth) {
    const auto bin = static_cast<int>((kRange - 5) / 0.02);
    double sum = 0;
    for (int i = bin - 10; i <= bin + 10; ++i) {
      for (int beam = 0; beam < ping.beam_count; ++beam) {
        const bool here = std::abs(sonar.beam_azimuth(beam) - azimuth) < 3 * kDegree;
        sum += here ? ping.intensity[ping.index(i, beam)] : 0;
      }
    }
    return 10 * std::log10(sum);
  };
  Scenario scenario = by_water(GetParam());
  const Ping alike = ping_of(scenario, wall_and_plate());
  scenario.sonars[0].transmit_width = 80 * kDegree;
  const Ping weighted = ping_of(scenario, wall_and_plate());
  const double wall = std::atan2(7, 6), water = std::atan2(1, 6);
  for (const auto& [arrival, sent] : {std::pair(wall, water), std::pair(water, wall)}) {
    const double x = 3.14159265358979 * 0.68910 * std::sin(sent);
    EXPECT_NEAR(near(weighted, scenario.sonars[0], arrival) - near(alike, scenario.sonars[0], arrival),
                20 * std::log10(std::sin(x) / x), 0.1)
        << arrival;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, WaterReturnTest, testing::Values(kRays, kRaster, kReference),
                         [](const auto& test) { return test.param.name; });

TEST(SelectiveWaterReturnTest, KeepsTheLevelOnAverage) {
  Scenario scenario = by_water(kRays);
  scenario.secondary = SecondaryEchoes::kSelective;
  Mean mean;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    scenario.seed = seed;
    mean.add(std::pow(10, 0.1 * near_range(ping_of(scenario, wall_and_plate()))));
  }
  const double expected = std::pow(10, 0.1 * expected_level());
  EXPECT_NEAR(mean.value(), expected, 4 * mean.error() + 0.05 * expected);
}

// The walks leave out what these echoes hold: with the surface given, the energy of three surfaces is less by theirs.
// Lobes of the walks are wider, by 11 degrees.
TEST(WalkWaterTest, WalksLeaveOutTheWaysBackByTheWater) {
  Scene scene = scene_of_all({plane(-Vec3::UnitY(), {0, 4, 0}, glinting(0.8, 0.02)),
                              plane(Vec3::UnitZ(), {0, 0, -5}, diffuse(-10)),
                              plane(-Vec3::UnitZ(), {0, 0, 0}, glinting(1, 0.02))});
  scene.instances[2].endless = true;
  SonarConfig sonar = by_water(kRays).sonars[0];
  const auto water = surface_label(2, 2);
  const auto energy = [&](SurfaceLabel surface, double rms_height) {
    scene.materials[2].rms_height = rms_height;
    WalkScene walks("cpu", scene, {.sonar = sonar, .water = {.sound_speed = 1500, .absorption = false}}, kSonar,
                    40'000);
    static_cast<void>(walks.ping(0, {.water = surface}));
    return walks.energy(3);
  };
  const double all = energy(kNoSurface, 0), rest = energy(water, 0);
  EXPECT_EQ(energy(water, 1), all);  // Waves of a metre: nothing is coherent.
  EXPECT_LT(rest, all);

  // The engine's own: what paths over three surfaces add, without those that leave and come back by one mirror.
  Scene still = scene;
  still.materials[2].rms_height = 0;
  const auto plan = make_flat_plan({.sonar = sonar,
                                    .water = {.sound_speed = 1500, .absorption = false},
                                    .model = EchoModel::kCalibrated,
                                    .materials = still.materials,
                                    .secondary = SecondaryEchoes::kAll});
  const auto own = [&](bool endless) {
    Scene seen = still;
    seen.instances[2].endless = endless;
    const auto engine = test_engine("cpu", 2);
    engine->set_scene(seen);
    EchoGrid grid(sonar.beam_count, sonar.bin_count, kPathOrders);
    engine->insonify(*plan, {.position = kSonar}, grid);
    double sum = 0;
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      for (int bin = 0; bin < sonar.bin_count; ++bin) {
        sum += grid.energy(3, beam)[bin];
      }
    }
    return sum;
  };
  EXPECT_NEAR(10 * std::log10((all - rest) / (own(true) - own(false))), 0, 1);
}

}  // namespace
}  // namespace insonify::validation::water_return_test
