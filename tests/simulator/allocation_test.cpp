// allocation_test.cpp -- a simulator allocates no memory after its first pings.

#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>

#include "engines/test_scenes.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define INSONIFY_COUNTS_ALLOCATIONS 0  // Sanitizers replace the allocator.
#else
#define INSONIFY_COUNTS_ALLOCATIONS 1
#endif

namespace {

std::atomic<int> allocations = 0;

}  // namespace

#if INSONIFY_COUNTS_ALLOCATIONS

// The allocation functions that every library of this process uses, operator new included.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  ++allocations;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}

#endif

namespace insonify::allocation_test {
namespace {

using testing_scenes::quiet_scenario;
using testing_scenes::SceneMaker;

Scenario busy_scenario(int beams) {
  SonarConfig sonar;
  sonar.beam_count = beams;
  sonar.azimuth_aperture = radians_from_degrees(beams > 1 ? 60 : 3);
  sonar.elevation_aperture = radians_from_degrees(20);
  sonar.bin_count = 200;
  sonar.max_range = 10;
  Scenario scenario = quiet_scenario(sonar);
  scenario.receiver.noise = true;
  scenario.secondary = SecondaryEchoes::kAll;
  return scenario;
}

// Number of allocations in the last forty pings.
// @param open_share  Of a net before the port half of the fan; 0: there is none.
int allocations_of_pings(const Scenario& scenario, int threads, double open_share = 0) {
  SceneMaker maker;
  maker.add_floor(-2);
  maker.add_wall(8);
  maker.add_sphere({5, 0.3, -1}, 0.6, 0.8, 0.2);
  maker.add("rope", make_cylinder(0.006, 1), {.position = {4, -0.2, -0.5}});
  maker.add("post", make_box({0.3, 0.3, 2}),
            {.position = {5, -1.2, 0}, .orientation = orientation_from_rpy(0, 0, radians_from_degrees(30))});
  if (open_share > 0) {
    maker.add("net", make_plane(Vec3::UnitX(), 6, 6), {.position = {2, 3.2, 0}});
  }
  Scene scene = maker.scene();
  scene.materials.back().open_share = open_share;
  for (Material& material : scene.materials) {
    material.rms_height = 1e-5;  // Glints of faces, and edges.
  }
  Simulator simulator(scenario, scene, threads);
  const ScenarioRequests requests(simulator.scenario());
  PingRequest request;
  Ping ping;
  std::uint64_t number = 0;
  const auto allocations_of = [&](int pings) {
    const int before = allocations;
    for (int i = 0; i < pings; ++i) {
      requests.fill(0, number++, request);
      simulator.ping(0, request, ping);
    }
    return allocations - before;
  };
  // On a busy machine, worker threads may start only some pings later, and then allocate their own state.
  int last = allocations_of(40);
  for (int i = 0; i < 6 && (i == 0 || last > 0); ++i) {
    last = allocations_of(40);
  }
  EXPECT_GT(simulator.ray_counts().return_legs, 0U);
  return last;
}

TEST(AllocationTest, PingsOfAFanAllocateNothing) {
  if (INSONIFY_COUNTS_ALLOCATIONS == 0) {
    GTEST_SKIP() << "allocations cannot be counted here";
  }
  EXPECT_EQ(allocations_of_pings(busy_scenario(64), 1), 0);
  EXPECT_EQ(allocations_of_pings(busy_scenario(64), 2), 0);
}

TEST(AllocationTest, PingsOfASingleBeamAllocateNothing) {
  if (INSONIFY_COUNTS_ALLOCATIONS == 0) {
    GTEST_SKIP() << "allocations cannot be counted here";
  }
  EXPECT_EQ(allocations_of_pings(busy_scenario(1), 1), 0);
}

// A scenario with every feature of the calibrated model.
Scenario calibrated_scenario(SonarType type) {
  Scenario scenario = busy_scenario(type == SonarType::kForwardLooking ? 64 : 1);
  SonarConfig& sonar = scenario.sonars[0];
  sonar.type = type;
  sonar.head.sector_width = radians_from_degrees(20);
  sonar.leak_db = -30;
  sonar.dead_range = 0.5;
  sonar.group_gains_db = {1};
  sonar.crosstalk_db = -40;
  scenario.model = EchoModel::kCalibrated;
  scenario.ground_truth = GroundTruth::kFull;
  scenario.surface = SeaSurface{.level = 4, .wind_speed = 3};
  scenario.points = {{.position = {4, 0.2, -1}}};
  scenario.thrusters = {{.position = {0.5, 0.3, -0.1}, .blade_rate = 60, .modulation = 0.5}};
  scenario.water.absorption = true;
  scenario.water.volume_backscatter_db = -70;
  scenario.receiver.azimuth_pattern = BeamPattern::kHann;
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_duration = 1e-3;
  scenario.receiver.speckle = true;
  scenario.receiver.time_varied_gain = 30;
  scenario.receiver.counts = true;
  scenario.receiver.full_scale_share = 0.01;
  scenario.random_walks = 100;
  return scenario;
}

TEST(AllocationTest, CalibratedPingsAllocateNothing) {
  if (INSONIFY_COUNTS_ALLOCATIONS == 0) {
    GTEST_SKIP() << "allocations cannot be counted here";
  }
  Scenario fan = calibrated_scenario(SonarType::kForwardLooking);
  EXPECT_EQ(allocations_of_pings(fan, 2), 0);
  fan.receiver.speckle = false;
  EXPECT_EQ(allocations_of_pings(fan, 1), 0);
  EXPECT_EQ(allocations_of_pings(calibrated_scenario(SonarType::kMechanicallyScanned), 1), 0);
}

TEST(AllocationTest, PingsThroughANetAllocateNothing) {
  if (INSONIFY_COUNTS_ALLOCATIONS == 0) {
    GTEST_SKIP() << "allocations cannot be counted here";
  }
  EXPECT_EQ(allocations_of_pings(calibrated_scenario(SonarType::kForwardLooking), 2, 0.8), 0);
}

TEST(AllocationTest, CalibratedPingsOfConesAndElevationPatternsAllocateNothing) {
  if (INSONIFY_COUNTS_ALLOCATIONS == 0) {
    GTEST_SKIP() << "allocations cannot be counted here";
  }
  Scenario scenario = busy_scenario(64);
  scenario.model = EchoModel::kCalibrated;
  scenario.receiver.beam_shape = BeamShape::kCone;
  scenario.receiver.elevation_pattern = BeamPattern::kRectangular;
  EXPECT_EQ(allocations_of_pings(scenario, 1), 0);
  EXPECT_EQ(allocations_of_pings(scenario, 2), 0);
}

// Checks the counter itself: a deliberate allocation is counted.
TEST(AllocationTest, WhatIsAllocatedIsCounted) {
  if (INSONIFY_COUNTS_ALLOCATIONS == 0) {
    GTEST_SKIP() << "allocations cannot be counted here";
  }
  const int before = allocations;
  Simulator simulator(busy_scenario(64), SceneMaker().add_wall(8).scene(), 1);
  EXPECT_GT(allocations - before, 10);
}

}  // namespace
}  // namespace insonify::allocation_test
