// crossing.h -- scenarios in which effects meet in one batch: sea surface, moved objects, scanning heads, interference,
// motion, random walks, two sonars.

#pragma once

#include <vector>

#include "insonify/simulator.h"
#include "simulator/small_world.h"

namespace insonify::testing_scenes {

/// Effects of a scenario, as bits.
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
  kPaper = 16384,
  kSides = 32768,  // A side-scan sonar as second sonar, with crosstalk.
  kSwath = 65536,  // A multibeam as second sonar.
};

inline SonarConfig scanning_head() {
  SonarConfig sonar = small_sonar();
  sonar.name = "head";
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 3 * kDegree;
  sonar.head.step = 9 * kDegree;
  sonar.position = {0, -0.3, 0.1};
  return sonar;
}

inline SonarConfig looking_abeam() {
  SonarConfig sonar = small_sonar();
  sonar.name = "sides";
  sonar.type = SonarType::kSideScan;
  sonar.beam_count = 2;
  sonar.azimuth_aperture = 2 * kDegree;
  sonar.elevation_aperture = 50 * kDegree;
  sonar.elevation_center = 0;
  sonar.depression = 25 * kDegree;
  sonar.crosstalk_db = -30;
  sonar.position = {0, 0.2, 0};
  // Abeam of the vehicle is ahead of it: the world lies there.
  sonar.orientation = {0, 0, 70 * kDegree};
  return sonar;
}

inline SonarConfig sounding_ahead() {
  SonarConfig sonar = small_sonar();
  sonar.name = "swath";
  sonar.type = SonarType::kMultibeam;
  sonar.beam_spacing = BeamSpacing::kEquidistant;
  sonar.transmit_elevation_aperture = 3 * kDegree;
  sonar.elevation_center = 0;
  sonar.roll_stabilised = true;
  sonar.position = {0.1, -0.2, 0};
  // Down of the housing is ahead of it: the world lies there.
  sonar.orientation = {0, -75 * kDegree, 0};
  return sonar;
}

inline Scenario crossing_scenario(unsigned effects, const char* engine) {
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
    scenario.sonars.push_back(scanning_head());
  }
  if (has(kSides)) {
    scenario.sonars.push_back(looking_abeam());
  }
  if (has(kSwath)) {
    scenario.sonars.push_back(sounding_ahead());
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

inline Scene crossing_scene(unsigned effects) {
  Scene scene = small_world();
  if ((effects & kGlass) != 0) {
    scene.materials[kBox].transmission = 0.7;
  }
  return scene;
}

inline std::vector<MovableObject> crossing_objects() {
  return {{"ball"}, {"ship"}};
}

/// Pings of all sonars in turn; the last one is the smallest. With kMoved, every second has the ball elsewhere, or the
/// ship.
struct CrossingOrders {
  CrossingOrders(const Scenario& scenario, unsigned effects) : requests(14), pings(requests.size()) {
    for (std::size_t i = 0; i < requests.size(); ++i) {
      PingRequest& request = requests[i];
      const double along = static_cast<double>(i);
      request.number = 5 + i;
      request.time = 0.37 * along;
      request.world_from_vehicle = {{0.2 * along, -0.1 * along, 0.1}, orientation_from_rpy(0.02, 0.05, 0.03 * along)};
      request.twist = {{0.5, 0.2, 0}, {0, 0, 0.1 * along}};
      if ((effects & kMoved) != 0 && i % 2 == 1) {
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

/// Sets of effects that tests cross.
inline constexpr unsigned kCrossings[] = {
    kSea,
    kSea | kWaves | kPoints,
    kSea | kMoved | kFull,
    kSea | kTwo | kWalks,
    kMoved | kPoints | kArray,
    kMoved | kHead | kMotion,
    kMoved | kWalks | kGlass,
    kHead | kOthers | kMutual,
    kHead | kArray | kThrusters | kFull,
    kHead | kWalks | kSea,
    kTwo | kMutual | kMotion | kFull,
    kTwo | kOthers | kPoints | kMoved,
    kMotion | kArray | kOthers | kThrusters,
    kGlass | kPoints | kOthers | kTwo | kMutual,
    kGlass | kSea | kWaves | kMoved | kPoints | kFull,
    kWalks | kMotion | kThrusters | kMoved,
    kSides | kSea | kWaves | kMoved | kPoints | kArray,
    kSides | kMotion | kMutual | kTwo | kFull,
    kSides | kWalks | kOthers | kThrusters | kGlass | kArray,
    kPaper | kSides | kMoved,
    kSwath | kSea | kWaves | kMoved | kPoints | kArray,
    kSwath | kArray | kMotion | kMutual | kTwo | kFull,
    kSwath | kArray | kWalks | kOthers | kThrusters | kGlass,
    kPaper | kSwath | kMoved,
    kPaper | kTwo,
    kPaper | kHead | kMoved,
    kPaper | kSea | kMoved,
    kHead | kTwo | kMutual | kMoved | kSea | kWaves,
    kSea | kWaves | kMoved | kHead | kTwo | kOthers | kMutual | kMotion | kWalks | kPoints | kArray | kThrusters |
        kGlass | kFull,
    kSea | kMoved | kTwo | kOthers | kMutual | kWalks | kPoints | kArray | kThrusters};

}  // namespace insonify::testing_scenes
