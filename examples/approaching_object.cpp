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

  const insonify::MovableObject movable[] = {{"mine"}};
  insonify::Simulator simulator(scenario, scene, 0, movable);
  insonify::PingRequest request;
  request.moved = {{.name = "mine"}};
  insonify::Ping ping;  // Used again and again: after the first, pings allocate nothing.
  for (int second = 0; second <= 5; ++second) {
    request.number = static_cast<std::uint64_t>(second);
    request.time = second;
    request.moved[0].world_from_object.position = {25 - 3.0 * second, 2 - 0.8 * second, 0};
    simulator.ping(0, request, ping);
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
