// approaching_object.cpp -- a mine-like object drifts towards the sonar: the bins it fills, ping by ping, by ground
// truth.

#include <insonify/error.h>
#include <insonify/files.h>
#include <insonify/simulator.h>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace {

void simulate() {
  insonify::Scene scene;
  insonify::Instance& mine = scene.instances.emplace_back();
  mine.name = "mine";
  mine.mesh = std::make_shared<insonify::Mesh>(insonify::make_sphere(0.5));
  mine.user_material = "steel";
  insonify::assign_materials(scene, {});

  insonify::Scenario scenario;
  insonify::SonarConfig& sonar = scenario.sonars.emplace_back();
  const insonify::Preset preset = insonify::load_preset("blueprint-oculus-m750d");
  sonar = preset.sonar;
  sonar.max_range = 30;
  preset.fit_to_range(sonar, 1500);
  sonar.ping_period = 1;
  insonify::Motion& drift = scenario.motions.emplace_back();
  drift.object = "mine";
  drift.trajectory.waypoints = {{.time = 0, .position = {25, 2, 0}}, {.time = 5, .position = {10, -2, 0}}};

  insonify::Simulator simulator(scenario, scene);
  insonify::Ping ping;  // Used again and again: after the first, pings allocate nothing.
  for (std::uint64_t number = 0; number <= 5; ++number) {
    simulator.make_ping(0, number, ping);
    int cells = 0, nearest = ping.bin_count;
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      for (int beam = 0; beam < ping.beam_count; ++beam) {
        if (ping.instance[ping.index(bin, beam)] == 0) {  // The mine: the scene's only instance.
          ++cells;
          nearest = std::min(nearest, bin);
        }
      }
    }
    std::printf("%.0f s: %d cells, the nearest at %.1f m\n", ping.time, cells, simulator.sonar(0).bin_range(nearest));
  }
}

}  // namespace

int main() {
  try {
    simulate();
    return 0;
  } catch (const insonify::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
