// mirror_pings_test.cpp -- echoes that are computed on objects and by mirrors (glints of plane faces, corners, ghosts
// of points, ways back by the water) do not depend on batches, threads and other sonars.

#include "base/rotation_between.h"
#include "echo/trihedral.h"
#include "simulator/small_world.h"

namespace insonify::mirror_pings_test {
namespace {

using namespace testing_scenes;

constexpr int kThreads = 3, kPings = 9;

// Pings of a case have motion in the ping, noise, speckle, an array, a chirp, and bins that hold several looks of it.
struct Case {
  const char* name;
  const char* engine;
  SonarType type;
  bool surface;
};
constexpr Case kCases[] = {{"fan", "cpu", SonarType::kForwardLooking, false},
                           {"fanUnderTheSurface", "cpu", SonarType::kForwardLooking, true},
                           {"head", "cpu", SonarType::kMechanicallyScanned, false},
                           {"headUnderTheSurface", "cpu", SonarType::kMechanicallyScanned, true},
                           {"reference", "reference", SonarType::kForwardLooking, true}};

class MirrorPingsTest : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Cases, MirrorPingsTest, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

// Two walls on a floor, smooth enough for glints and for corners, and a corner of its own before them.
Scene room(double rms_height = 2e-5) {
  Scene scene = SceneMaker()
                    .add("floor", make_plane(Vec3::UnitZ(), 16, 16), {.position = {0, 0, -3}})
                    .add("wall", make_plane(-Vec3::UnitX(), 16, 16), {.position = {8, 0, 0}})
                    .add("side", make_plane(-Vec3::UnitY(), 16, 16), {.position = {0, 4, 0}})
                    .add("corner", trihedral(0.3, true),
                         {.position = {6, -2, -1}, .orientation = rotation_between(Vec3::Ones(), -Vec3(6, -2, -1))})
                    .scene();
  for (Material& material : scene.materials) {
    material.reflection = 0.7;
    material.lambert_db = -25;
    material.rms_slope = 0.05;
    material.rms_height = rms_height;
  }
  return scene;
}

SonarConfig sonar_of(const Case& on) {
  SonarConfig sonar = small_sonar();
  sonar.type = on.type;
  sonar.elevation_aperture = 70 * kDegree;
  sonar.elevation_center = 0;
  sonar.sampling = {.columns_per_beam = 2, .rows = 50};
  if (on.type == SonarType::kMechanicallyScanned) {
    sonar.beam_count = 1;
    sonar.azimuth_aperture = 12 * kDegree;
    sonar.sampling.columns_per_beam = 16;
    sonar.head.step = 7 * kDegree;
    sonar.head.sector_center = -60 * kDegree;  // From the corner's side to the walls'.
  }
  return sonar;
}

Scenario scenario_of(const Case& on) {
  Scenario scenario = quiet_scenario(sonar_of(on));
  scenario.engine = on.engine;
  scenario.model = EchoModel::kCalibrated;
  scenario.secondary = SecondaryEchoes::kSelective;
  scenario.ground_truth = GroundTruth::kFull;
  scenario.motion_in_ping = true;
  scenario.points = {{.position = {5, 0.5, -1}, .target_strength_db = -20}};
  scenario.receiver.noise = scenario.receiver.speckle = scenario.receiver.field = true;
  scenario.receiver.azimuth_pattern = BeamPattern::kHann;
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_duration = 200e-6;
  scenario.receiver.pulse_bandwidth = 60e3;
  scenario.receiver.decimation = Decimation::kPeak;
  if (on.surface) {
    scenario.surface = SeaSurface{.level = 1.2};
  }
  return scenario;
}

std::vector<PingRequest> requests() {
  std::vector<PingRequest> requests(kPings);
  for (int i = 0; i < kPings; ++i) {
    requests[i].number = 3 + static_cast<std::uint64_t>(i);
    requests[i].time = 0.2 * i;
    requests[i].world_from_vehicle = {{0.15 * i, 0.1 * i, -0.02 * i}, orientation_from_rpy(0.03, 0.02, 0.06 * i)};
    requests[i].twist = {{0.8, -0.3, 0.1}, {0, 0, 0.2}};
  }
  return requests;
}

TEST_P(MirrorPingsTest, AreTheSameInABatchAndAlone) {
  Simulator together(scenario_of(GetParam()), room(), kThreads), alone(scenario_of(GetParam()), room(), 1);
  const std::vector<PingRequest> asked = requests();
  std::vector<Ping> pings(asked.size());
  together.ping(0, asked, pings);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(pings[i], alone.ping(0, asked[i]));
  }
}

// The corner that moves by itself goes along in a batch's later pings.
TEST_P(MirrorPingsTest, AreTheSameWhenAnObjectMoves) {
  const std::vector<MovableObject> movable = {{"corner"}};
  Simulator together(scenario_of(GetParam()), room(), kThreads, movable);
  Simulator alone(scenario_of(GetParam()), room(), 1, movable);
  std::vector<PingRequest> asked = requests();
  const Pose moved{{5, -1, -0.5}, rotation_between(Vec3::Ones(), -Vec3(5, -1, -0.5))};
  asked[2].moved = asked[3].moved = {{.name = "corner", .world_from_object = moved}};
  std::vector<Ping> pings(asked.size());
  together.ping(0, asked, pings);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(pings[i], alone.ping(0, asked[i]));
  }
  PingRequest still = asked[2];
  still.moved.clear();
  EXPECT_GT(apart(alone.ping(0, still), pings[2]), 1e-3);
}

TEST_P(MirrorPingsTest, AreTheSameBesideAnotherSonar) {
  Scenario both = scenario_of(GetParam());
  SonarConfig other = sonar_of(kCases[0]);
  other.name = "other";
  other.frequency = 455e3;
  other.position = {0.3, -0.4, -0.2};
  other.orientation = {0, 0.2, -0.4};
  both.sonars.push_back(other);
  Scenario own = both;
  own.sonars = {other};
  Simulator together(both, room(), kThreads), first(scenario_of(GetParam()), room(), 1), second(own, room(), 1);
  const std::vector<PingRequest> asked = requests();
  std::vector<Ping> pings(asked.size());
  together.ping(1, asked, pings);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(pings[i], second.ping(0, asked[i]));
    expect_same(together.ping(0, asked[i]), first.ping(0, asked[i]));  // In turns.
    expect_same(together.ping(1, asked[i]), pings[i]);
  }
}

// What is compared above is there: each kind of echo changes a ping without noise and speckle.
TEST_P(MirrorPingsTest, HoldEveryKindOfEcho) {
  Scenario scenario = scenario_of(GetParam());
  scenario.receiver.noise = scenario.receiver.speckle = scenario.receiver.field = false;
  const auto energy_of = [&](const Scenario& changed, const Scene& scene) {
    Simulator simulator(changed, scene, 2);
    double sum = 0;
    for (const PingRequest& request : requests()) {
      for (const float value : simulator.ping(0, request).intensity) {
        sum += double{value};
      }
    }
    return sum;
  };
  Scenario bare = scenario;
  bare.points.clear();
  bare.secondary = SecondaryEchoes::kNone;
  const double primary = energy_of(bare, room());
  EXPECT_GT(std::abs(primary / energy_of(bare, room(0.1)) - 1), 0.1) << "glints";
  bare.secondary = scenario.secondary;
  bare.max_surfaces = 2;
  const double two = energy_of(bare, room());
  bare.max_surfaces = 3;
  const double three = energy_of(bare, room());
  EXPECT_GT(three - two, 0.1 * primary) << "corners";
  const double ghosts = energy_of(scenario, room()) - three;
  bare.points = scenario.points;
  bare.secondary = SecondaryEchoes::kNone;
  const double direct = energy_of(bare, room()) - primary;
  EXPECT_GT(ghosts, 1.1 * direct) << "ghosts";
}

}  // namespace
}  // namespace insonify::mirror_pings_test
