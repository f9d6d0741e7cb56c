// bench_changes.cpp -- times changes of sonars and objects while a simulator runs.

#include <array>
#include <chrono>

#include "benchmark/bench.h"
#include "benchmark/bench_scene.h"
#include "benchmark/bench_timing.h"
#include "insonify/simulator.h"

namespace insonify {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kBuoy = "buoy";
constexpr int kThreadsOfChanges = 2;

// A change made before a ping, and the times of each change and the ping after it [ms].
struct Change {
  const char* name;
  void (*make)(Simulator& simulator, PingRequest& request);
  std::vector<double> own_ms = {}, ping_ms = {};
};

Scene buoy() {
  Scene scene;
  Instance& instance = scene.instances.emplace_back();
  instance.name = kBuoy;
  instance.mesh = std::make_shared<const Mesh>(make_sphere(0.5));
  instance.world_from_mesh.position = {6, 1, -1};
  assign_materials(scene, {});
  return scene;
}

// Alternates between two ranges.
void set_range(Simulator& simulator, PingRequest&) {
  SonarConfig sonar = simulator.scenario().sonars[0];
  sonar.max_range = sonar.max_range > 19 ? 18 : 20;
  simulator.set_sonar(0, sonar);
}

void add_buoy(Simulator& simulator, PingRequest&) {
  const std::array movable = {MovableObject{kBuoy}};
  simulator.add_objects(buoy(), movable);
}

void move_buoy(Simulator&, PingRequest& request) {
  request.moved = {{.name = kBuoy, .world_from_object = {.position = {7, 0.5, -1}}}};
}

void remove_buoy(Simulator& simulator, PingRequest& request) {
  request.moved.clear();
  simulator.remove_object(kBuoy);
}

// Makes the changes in turn, each followed by a ping.
std::array<Change, 5> time_changes(Simulator& simulator, int repetitions) {
  std::array<Change, 5> changes = {Change{"none", [](Simulator&, PingRequest&) {}}, Change{"set_sonar", set_range},
                                   Change{"add_objects", add_buoy}, Change{"moved", move_buoy},
                                   Change{"remove_object", remove_buoy}};
  constexpr int kWarmUp = 2;
  PingRequest request;
  Ping ping;
  for (int turn = -kWarmUp; turn < repetitions; ++turn) {
    for (Change& change : changes) {
      ++request.number;
      const auto start = Clock::now();
      change.make(simulator, request);
      const double own = milliseconds_since(start);
      const auto then = Clock::now();
      simulator.ping(0, request, ping);
      if (turn >= 0) {
        change.own_ms.push_back(own);
        change.ping_ms.push_back(milliseconds_since(then));
      }
    }
  }
  return changes;
}

}  // namespace

int bench_changes(const BenchOptions& options) {
  say("256 beams x 500 bins, all effects on, {} threads; medians of {}. What a change takes, and the ping after it.\n\n"
      "{:>9} {:<10} {:<13} | {:>9} {:>8}\n",
      kThreadsOfChanges, options.repetitions, "triangles", "model", "change", "change ms", "ping ms");
  BenchRows rows;
  rows.begin("changes", "{:>9} {:<10} {:<13} | {:>9.2f} {:>8.2f}\n",
             {"triangles", "model", "change", "change_ms", "ping_ms"});
  for (const int count : options.triangles) {
    const Scene scene = make_bench_scene(count);
    for (const auto& [model, name] :
         {std::pair(EchoModel::kPaper, "paper"), std::pair(EchoModel::kCalibrated, "calibrated")}) {
      Scenario scenario;
      scenario.model = model;
      scenario.engine = "cpu";
      scenario.sonars = {bench_sonar()};
      Simulator simulator(scenario, scene, kThreadsOfChanges);
      for (const Change& change : time_changes(simulator, options.repetitions)) {
        rows.add(scene.triangle_count(), name, change.name, median(change.own_ms), median(change.ping_ms));
      }
    }
  }
  rows.write(options.json);
  return 0;
}

}  // namespace insonify
