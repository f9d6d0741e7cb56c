// layered_water_test.cpp -- pings through a sound-speed profile: ranges, elevations and levels by the closed form of
// its rays, shadow zones, agreement of engines, and what is refused.

#include <gmock/gmock.h>

#include <numeric>

#include "engines/remote_engine.h"
#include "insonify/acoustics/sound_speed_profile.h"
#include "insonify/error.h"
#include "support/message_of.h"
#include "validation/calibrated_scene.h"

namespace insonify::layered_water_test {
namespace {

using namespace validation;

// Slower by 1 m/s in each metre; 1500 m/s at 50 m.
const std::vector<ProfilePoint> kFalling = {{.depth = 0, .sound_speed = 1550}, {.depth = 100, .sound_speed = 1450}};

double energy(const Ping& ping) {
  return std::accumulate(ping.intensity.begin(), ping.intensity.end(), 0.0);
}

SonarConfig one_beam(double elevation, double aperture, int rows) {
  SonarConfig sonar;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 2 * kDegree;
  sonar.elevation_center = elevation;
  sonar.elevation_aperture = aperture;
  sonar.min_range = 0;
  sonar.sampling = {.columns_per_beam = 4, .rows = rows};
  return sonar;
}

// So narrow that a plate of a few decimetres fills it.
SonarConfig narrow_beam(double elevation, double aperture, int rows) {
  SonarConfig sonar = one_beam(elevation, aperture, rows);
  sonar.azimuth_aperture = 0.1 * kDegree;
  return sonar;
}

// What an echo in a single bin may be off, and a little for rounding and chords [m].
double half_bin(const SonarConfig& sonar) {
  return 0.5 * sonar.bin_length() + 2e-4;
}

struct EngineOfWater {
  const char* name;
  Method method;
  EchoModel model;
};

class LayeredWaterTest : public testing::TestWithParam<EngineOfWater> {
 protected:
  // The sonar is at the origin of the world.
  static Scenario scenario_in(const std::vector<ProfilePoint>& profile, double depth, const SonarConfig& sonar) {
    Scenario scenario = calibrated(sonar, GetParam().method);
    scenario.model = GetParam().model;
    scenario.water.depth = depth;
    scenario.water.profile = profile;
    return scenario;
  }
};

const EngineOfWater kEngines[] = {{"cpuCalibrated", kRays, EchoModel::kCalibrated},
                                  {"cpuPaper", kRays, EchoModel::kPaper},
                                  {"referenceCalibrated", kReference, EchoModel::kCalibrated},
                                  {"referencePaper", kReference, EchoModel::kPaper}};
INSTANTIATE_TEST_SUITE_P(Engines, LayeredWaterTest, testing::ValuesIn(kEngines),
                         [](const auto& test) { return test.param.name; });

void PrintTo(const EngineOfWater& on, std::ostream* out) {
  *out << on.name;
}

// T25. Sound that leaves level meets what is 50 m away .83356 m deeper, after .0333457 s: it appears straight ahead, at
// 1500 m/s times that.
TEST_P(LayeredWaterTest, ATargetAppearsWhereItsRayLeaves) {
  SonarConfig sonar = narrow_beam(0, 8 * kDegree, 6400);
  sonar.min_range = 49.9;
  sonar.max_range = 50.1;
  sonar.bin_count = 80;
  const Scenario scenario = scenario_in(kFalling, 50, sonar);
  Scene plate = plate_at(50, 0.1, diffuse(-10));
  plate.instances[0].world_from_mesh.position.z() = -.8335649435050052;
  const Ping ping = ping_of(scenario, plate);
  double moment = 0, height = 0;
  for (int bin = 0; bin < ping.bin_count; ++bin) {
    if (ping.intensity[bin] > 0) {
      moment += ping.intensity[bin] * sonar.bin_range(bin);
      height += ping.intensity[bin] * ping.elevation[bin];
    }
  }
  EXPECT_NEAR(moment / energy(ping), 1500 * .033345687249336106, half_bin(sonar));
  // A row of the lattice, 1 mm in 50 m; in the paper's model the plate's two bins weigh about the same.
  EXPECT_NEAR(height / energy(ping), 0, GetParam().model == EchoModel::kPaper ? 1e-4 : 2.2e-5);
}

// The same with the ray of a water of three layers, down and up.
TEST_P(LayeredWaterTest, RangeAndElevationAreThoseOfTheEigenray) {
  const std::vector<ProfilePoint> points = {{.depth = 0, .sound_speed = 1518},
                                            {.depth = 10, .sound_speed = 1518},
                                            {.depth = 14, .sound_speed = 1494},
                                            {.depth = 40, .sound_speed = 1490}};
  const SoundSpeedProfile water(points);
  for (const Vec3& place : {Vec3(38, 0, -14), Vec3(30, 0, 5), Vec3(45, 0, -2)}) {
    const auto ray = water.eigenray(11, 11 - place.z(), place.x());
    ASSERT_TRUE(ray);
    SonarConfig sonar = narrow_beam(-ray->launch_angle, 6 * kDegree, 1200);
    const double range = water.speed_at(11) * ray->time;
    sonar.min_range = range - 0.1;
    sonar.max_range = range + 0.1;
    sonar.bin_count = 80;
    Scene plate = plate_at(place.x(), 0.1, diffuse(-10), 0);
    plate.instances[0].world_from_mesh = {.position = place,
                                          .orientation = orientation_from_rpy(0, ray->arrival_angle, 0)};
    const Ping ping = ping_of(scenario_in(points, 11, sonar), plate);
    double moment = 0, height = 0;
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      if (ping.intensity[bin] > 0) {
        moment += ping.intensity[bin] * sonar.bin_range(bin);
        height += ping.intensity[bin] * ping.elevation[bin];
      }
    }
    EXPECT_NEAR(moment / energy(ping), range, half_bin(sonar)) << place.transpose();
    EXPECT_NEAR(height / energy(ping), -ray->launch_angle, 9e-5) << place.transpose();
  }
}

TEST_P(LayeredWaterTest, AConstantProfileGivesTheBytesOfItsSpeed) {
  SonarConfig sonar = one_beam(-30 * kDegree, 50 * kDegree, 200);
  sonar.max_range = 40;
  sonar.bin_count = 200;
  Scenario scenario = scenario_in({{.depth = 0, .sound_speed = 1483}, {.depth = 90, .sound_speed = 1483}}, 20, sonar);
  scenario.secondary = SecondaryEchoes::kAll;
  const Scene bed = seabed_at(-8, diffuse(-20));
  const Ping ping = ping_of(scenario, bed);
  scenario.water.profile.clear();
  scenario.water.sound_speed = 1483;
  EXPECT_EQ(ping_of(scenario, bed).intensity, ping.intensity);
  EXPECT_GT(energy(ping), 0);
}

// Speed falls from 1600 m/s at the surface by 5 m/s a metre: rays are circles of 320 m and more. The one from 5 m that
// grazes the surface meets it after sqrt(320^2 - 315^2) = 56.35 m and is 320 - sqrt(320^2 - 63.65^2) = 6.39 m deep at
// 120 m.
TEST_P(LayeredWaterTest, NothingEchoesFromAShadowZone) {
  SonarConfig sonar = narrow_beam(0, 60 * kDegree, 3000);
  sonar.max_range = 140;
  sonar.bin_count = 280;
  const auto at_depth = [&](double depth) {
    Scene plate = plate_at(120, 0.4, diffuse(-10));
    plate.instances[0].world_from_mesh.position.z() = 5 - depth;
    return energy(
        ping_of(scenario_in({{.depth = 0, .sound_speed = 1600}, {.depth = 40, .sound_speed = 1400}}, 5, sonar), plate));
  };
  EXPECT_EQ(at_depth(6.1), 0);  // Its lower edge is 6.3 m deep.
  EXPECT_GT(at_depth(6.7), 0);
}

// The levels of a bed, by the definition of Lambert's law with the angle of arrival: in a wedge of width w a bin holds
// mu w times the integral of sin(arrival) cos(launch)/r^2 over its launch angles.
TEST(LayeredWaterLevelTest, ABedEchoesByTheAngleOfArrival) {
  constexpr double kHeight = 12;
  SonarConfig sonar = one_beam(-46 * kDegree, 86 * kDegree, 6000);
  sonar.max_range = 70;
  sonar.bin_count = 140;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.depth = 50;
  scenario.water.profile = {{.depth = 0, .sound_speed = 1520},
                            {.depth = 52, .sound_speed = 1520},
                            {.depth = 55, .sound_speed = 1490},
                            {.depth = 70, .sound_speed = 1488}};
  const SoundSpeedProfile water(scenario.water.profile);
  std::vector<double> expected(140, 0.0);
  std::vector<double> moment(140, 0.0);
  constexpr int kSteps = 50'000;
  for (int i = 0; i < kSteps; ++i) {
    const double launch = (3 + (i + 0.5) * 86.0 / kSteps) * kDegree;
    double time = 0, later = 0.3;  // To the bed, by halving: rays go down without a turn.
    for (int k = 0; k < 45; ++k) {
      const double middle = (time + later) / 2;
      (water.after_time(50, launch, middle).depth < 50 + kHeight ? time : later) = middle;
    }
    const double range = 1520 * time;
    const auto bin = static_cast<std::size_t>(range / sonar.bin_length());
    if (bin < expected.size()) {
      const double echo = std::pow(10, -2.7) * 2 * kDegree * std::sin(water.after_time(50, launch, time).angle) *
                          std::cos(launch) / (range * range) * 86 * kDegree / kSteps;
      expected[bin] += echo;
      moment[bin] -= launch * echo;
    }
  }
  const Ping ping = ping_of(scenario, seabed_at(-kHeight, diffuse(-27)));
  for (int bin = 0; bin < 140; ++bin) {
    if (bin < 24) {
      EXPECT_EQ(ping.intensity[bin], 0) << bin;  // Straight down the bed is at 12.05 m: 1520 m/s is too fast.
    } else if (bin >= 30 && bin < 130) {
      EXPECT_NEAR(10 * std::log10(ping.intensity[bin] / expected[bin]), 0, 0.15) << bin;
      EXPECT_NEAR(ping.elevation[bin], moment[bin] / expected[bin], 0.1 * kDegree) << bin;
    }
  }
  EXPECT_GT(ping.intensity[24], 0);
}

// ---------------------------------------------------------------- Engines, and other settings

Scene things() {
  return scene_of_all({seabed_at(-9, diffuse(-20)), sphere_at({14, 1, -3}, 1, glinting(0.6, 0.2), 0.3),
                       plate_at(20, 6, glinting(0.5, 0.1), 0.4)});
}

TEST(LayeredWaterAgreementTest, EnginesAgree) {
  SonarConfig sonar = one_beam(-15 * kDegree, 40 * kDegree, 300);
  sonar.beam_count = 8;
  sonar.azimuth_aperture = 40 * kDegree;
  sonar.max_range = 30;
  sonar.bin_count = 150;
  for (const EchoModel model : {EchoModel::kCalibrated, EchoModel::kPaper}) {
    Ping pings[2];
    for (const Method& method : {kRays, kReference}) {
      Scenario scenario = calibrated(sonar, method);
      scenario.model = model;
      scenario.secondary = SecondaryEchoes::kAll;
      scenario.water.depth = 50;
      scenario.water.profile = kFalling;
      pings[method.engine == kReference.engine ? 1 : 0] = ping_of(scenario, things());
    }
    double apart = 0;
    for (std::size_t i = 0; i < pings[0].intensity.size(); ++i) {
      apart += std::abs(double{pings[0].intensity[i]} - double{pings[1].intensity[i]});
    }
    EXPECT_LT(apart, 3e-3 * energy(pings[1]));
  }
}

TEST(LayeredWaterAgreementTest, AMovedObjectEchoesAsOneThatIsThere) {
  SonarConfig sonar = one_beam(0, 30 * kDegree, 400);
  sonar.max_range = 60;
  sonar.bin_count = 300;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.depth = 50;
  scenario.water.profile = kFalling;
  Scene moved = plate_at(20, 2, diffuse(-10));
  moved.instances[0].moving = true;
  Simulator simulator(scenario, moved, 2);
  PingRequest request;
  request.moved = {{.name = "diffuse", .world_from_object = {.position = {40, 0, -2}}}};
  Scene there = plate_at(20, 2, diffuse(-10));
  there.instances[0].world_from_mesh = request.moved[0].world_from_object;
  const Ping ping = simulator.ping(0, request), expected = ping_of(scenario, there);
  EXPECT_NEAR(energy(ping) / energy(expected), 1, 1e-3);
  EXPECT_NE(energy(simulator.make_ping(0, 0)), energy(ping));
}

// A point 40 m away, and a sonar that comes nearer by 3 m/s: v r/c = 8 cm less, as in uniform water.
TEST(LayeredWaterAgreementTest, MotionInThePingIsThatOfApparentRanges) {
  SonarConfig sonar = one_beam(0, 20 * kDegree, 100);
  sonar.min_range = 39;
  sonar.max_range = 41;
  sonar.bin_count = 400;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.depth = 50;
  scenario.water.profile = kFalling;
  scenario.points = {{.position = {40, 0, -1}}};
  const auto peak = [&] {
    const Ping ping = ping_of(scenario, {});
    return sonar.bin_range(static_cast<int>(std::ranges::max_element(ping.intensity) - ping.intensity.begin()));
  };
  const double still = peak();
  const auto ray = SoundSpeedProfile(kFalling).eigenray(50, 51, 40);
  EXPECT_NEAR(still, 1500 * ray->time, 0.003);
  scenario.motion_in_ping = true;
  scenario.trajectory.waypoints = {{.time = 0}, {.time = 1, .position = {3, 0, 0}}};
  EXPECT_NEAR(peak(), still - 3 * 40 / 1500.0, 0.006);
}

// Straight up the surface is 20 m away and water gets faster by 1 m/s a metre: ln(1550/1530)/(1/s).
TEST(LayeredWaterAgreementTest, TheSeasSurfaceEchoesThroughTheProfile) {
  SonarConfig sonar = one_beam(69 * kDegree, 39 * kDegree, 800);
  sonar.max_range = 30;
  sonar.bin_count = 600;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.water.profile = kFalling;
  scenario.surface = SeaSurface{.level = 20, .wind_speed = 8};
  const Ping ping = ping_of(scenario, {});
  const auto first = std::ranges::find_if(ping.intensity, [](float value) { return value > 0; });
  EXPECT_NEAR(static_cast<double>(first - ping.intensity.begin()) * sonar.bin_length(), 1530 * std::log(1550.0 / 1530),
              2 * sonar.bin_length());
}

// ---------------------------------------------------------------- Refusals

Scenario falling() {
  SonarConfig sonar = one_beam(-30 * kDegree, 40 * kDegree, 50);
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.depth = 50;
  scenario.water.profile = kFalling;
  return scenario;
}

std::string fault(const Scenario& scenario, const Scene& scene = {}) {
  return message_of([&] { (void)ping_of(scenario, scene); });
}

TEST(LayeredWaterMessagesTest, NamesWhatLiesBelowTheProfile) {
  Scene bed = seabed_at(-55, diffuse(-20));
  bed.instances[0].name = "bed";
  EXPECT_EQ(fault(falling(), bed), "water.profile ends at 100 m, above bed, which reaches down to 105 m");
  Scenario deep = falling();
  deep.trajectory.waypoints = {{.time = 0}};
  PingRequest request;
  request.world_from_vehicle.position.z() = -60;
  EXPECT_EQ(message_of([&] { (void)Simulator(deep, {}, 1).ping(0, request); }),
            "ping 0 of sonar: the sonar is 110 m deep, below the end of water.profile at 100 m");
}

TEST(LayeredWaterMessagesTest, NamesTheSettingsThatDoNotGoWithAProfile) {
  Scenario both = falling();
  both.water.sound_speed = 1500;
  EXPECT_EQ(fault(both), "water.sound_speed = 1500 m/s and water.profile both give the speed; leave one out");
  Scenario drawn = falling();
  drawn.primary = PrimaryEchoes::kRaster;
  EXPECT_EQ(fault(drawn), "primary = raster draws along straight rays; with water.profile it must be auto or rays");
  Scenario unsorted = falling();
  std::swap(unsorted.water.profile[0], unsorted.water.profile[1]);
  EXPECT_EQ(fault(unsorted), "water.profile[1].depth = 0 m must be greater than water.profile[0].depth = 100 m");
}

TEST(LayeredWaterMessagesTest, AnEngineOfStraightRaysIsRefused) {
  Scenario straight = falling();
  straight.engine = testing_scenes::RemoteEngine::kKind.name;
  EXPECT_EQ(fault(straight),
            "engine = remote traces straight rays, and water.profile bends them; use cpu, reference or auto");
}

TEST(LayeredWaterMessagesTest, AutoTakesAnEngineThatBendsRays) {
  Scenario any = falling();
  any.engine = std::string(kAutoEngine);
  EXPECT_EQ(Simulator(any, {}, 1).engine_choice(),
            "engine: cpu, since water.profile bends rays, which a graphics card does not trace");
}

}  // namespace
}  // namespace insonify::layered_water_test
