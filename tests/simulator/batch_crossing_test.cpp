// batch_crossing_test.cpp -- a batch gives the bytes of its pings made alone, whatever effects meet in it.

#include <string>

#include "engines/remote_engine.h"
#include "insonify/simulator.h"
#include "simulator/small_world.h"

namespace insonify::batch_crossing_test {
namespace {

using namespace testing_scenes;

// Effects of a scenario, as bits.
enum Effect : unsigned {
  kSea = 1,
  kWaves = 2,  // On the sea.
  kMoved = 4,
  kHead = 8,  // A scanning head as second sonar.
  kTwo = 16,  // A second fan, of other size.
  kOthers = 32,
  kMutual = 64,  // With two sonars.
  kMotion = 128,
  kWalks = 256,
  kPoints = 512,
  kArray = 1024,  // Array, pulse and coarse bins.
  kThrusters = 2048,
  kGlass = 4096,  // A box that transmits sound.
  kFull = 8192,   // Full ground truth.
  kPaper = 16384
};

SonarConfig head() {
  SonarConfig sonar = small_sonar();
  sonar.name = "head";
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 3 * kDegree;
  sonar.head.step = 9 * kDegree;
  sonar.position = {0, -0.3, 0.1};
  return sonar;
}

Scenario scenario_of(unsigned effects, const char* engine) {
  const auto has = [&](unsigned effect) { return (effects & effect) != 0; };
  Scenario scenario =
      small_scenario({"", engine, has(kPaper) ? EchoModel::kPaper : EchoModel::kCalibrated, PrimaryEchoes::kAuto});
  if (!has(kFull)) {
    scenario.ground_truth = has(kPoints) ? GroundTruth::kNone : GroundTruth::kLabels;
  }
  if (has(kSea)) {
    scenario.surface = SeaSurface{.level = 3, .wind_speed = has(kWaves) ? 5.0 : 0.0};
  }
  if (has(kHead)) {
    scenario.sonars.push_back(head());
  }
  if (has(kTwo)) {
    scenario.sonars.push_back(small_sonar());
    scenario.sonars.back().name = "second";
    scenario.sonars.back().position = {0, 0.4, 0};
    scenario.sonars.back().bin_count = 61;
  }
  if (has(kOthers)) {
    scenario.interferers = {{.position = {14, 4, 0}, .source_level_db = 190, .period = 0.013}};
  }
  if (has(kPoints)) {
    scenario.points = {{.position = {6, 1, -0.5}, .target_strength_db = -20}, {.position = {8, -2.5, -1}}};
  }
  if (has(kArray)) {
    scenario.receiver.azimuth_pattern = BeamPattern::kHann;
    scenario.receiver.pulse = PulseKind::kCw;
    scenario.receiver.pulse_duration = 4e-5;
  }
  if (has(kThrusters)) {
    scenario.thrusters = {{.position = {0.6, 0.3, 0}}, {.position = {0.2, -0.9, 0}}};
  }
  scenario.mutual_interference = has(kMutual);
  scenario.motion_in_ping = has(kMotion);
  scenario.random_walks = has(kWalks) ? 150 : 0;
  return scenario;
}

// Pings of all sonars in turn. Every second has the ball elsewhere, or the ship.
struct Orders {
  explicit Orders(const Scenario& scenario, bool moved) : requests(13), pings(requests.size()) {
    for (std::size_t i = 0; i < requests.size(); ++i) {
      PingRequest& request = requests[i];
      const double along = static_cast<double>(i);
      request.number = 5 + i;
      request.time = 0.37 * along;
      request.world_from_vehicle = {{0.2 * along, -0.1 * along, 0.1}, orientation_from_rpy(0.02, 0.05, 0.03 * along)};
      request.twist = {{0.5, 0.2, 0}, {0, 0, 0.1 * along}};
      if (moved && i % 2 == 1) {
        request.moved = {
            {.name = i % 4 == 1 ? "ball" : "ship", .world_from_object = {.position = {7, 0.1 * along, -1}}}};
      }
      orders.push_back({static_cast<int>(i % scenario.sonars.size()), &request, &pings[i]});
    }
  }
  std::vector<PingRequest> requests;
  std::vector<Ping> pings;
  std::vector<PingOrder> orders;
};

class BatchCrossingTest : public testing::TestWithParam<unsigned> {};

TEST_P(BatchCrossingTest, GivesTheBytesOfPingsMadeAlone) {
  const unsigned effects = GetParam();
  const std::vector<MovableObject> movable = {{"ball"}, {"ship"}};
  Scene scene = small_world();
  if ((effects & kGlass) != 0) {
    scene.materials[kBox].transmission = 0.7;
  }
  Simulator alone(scenario_of(effects, "cpu"), scene, 1, movable);
  Orders one_by_one(alone.scenario(), (effects & kMoved) != 0);
  for (const PingOrder& order : one_by_one.orders) {
    alone.ping({&order, 1});
  }
  for (const char* engine : {"cpu", "remote"}) {
    Simulator simulator(scenario_of(effects, engine), scene, 3, movable);
    if (auto* remote = dynamic_cast<RemoteEngine*>(&simulator.engine())) {
      remote->has_walks = (effects & kWalks) != 0;
    }
    Orders batch(simulator.scenario(), (effects & kMoved) != 0);
    for (int round = 0; round < 2; ++round) {  // The second reuses all memory.
      simulator.ping(batch.orders);
      for (std::size_t i = 0; i < batch.pings.size(); ++i) {
        SCOPED_TRACE(testing::Message() << engine << ", ping " << i << ", round " << round);
        expect_same(batch.pings[i], one_by_one.pings[i]);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, BatchCrossingTest,
                         testing::Values(kSea, kSea | kWaves | kPoints, kSea | kMoved | kFull, kSea | kTwo | kWalks,
                                         kMoved | kPoints | kArray, kMoved | kHead | kMotion, kMoved | kWalks | kGlass,
                                         kHead | kOthers | kMutual, kHead | kArray | kThrusters | kFull,
                                         kHead | kWalks | kSea, kTwo | kMutual | kMotion | kFull,
                                         kTwo | kOthers | kPoints | kMoved, kMotion | kArray | kOthers | kThrusters,
                                         kGlass | kPoints | kOthers | kTwo | kMutual,
                                         kGlass | kSea | kWaves | kMoved | kPoints | kFull,
                                         kWalks | kMotion | kThrusters | kMoved, kPaper | kTwo, kPaper | kHead | kMoved,
                                         kPaper | kSea | kMoved, kHead | kTwo | kMutual | kMoved | kSea | kWaves,
                                         kSea | kWaves | kMoved | kHead | kTwo | kOthers | kMutual | kMotion | kWalks |
                                             kPoints | kArray | kThrusters | kGlass | kFull,
                                         kSea | kMoved | kTwo | kOthers | kMutual | kWalks | kPoints | kArray |
                                             kThrusters));

}  // namespace
}  // namespace insonify::batch_crossing_test
