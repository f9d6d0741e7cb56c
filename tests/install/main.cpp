// main.cpp -- what a user of the installed library might write: a ping of a sphere, recorded and drawn.

#include <insonify/insonify.h>

#include <cstdio>

int main(int, char** arguments) {
  try {
    insonify::Scene scene;
    scene.instances.emplace_back();
    scene.instances[0].name = "sphere";
    scene.instances[0].mesh = std::make_shared<insonify::Mesh>(insonify::make_sphere(0.5));
    scene.instances[0].world_from_mesh.position = {6, 0, 0};
    insonify::assign_materials(scene, {});

    insonify::Scenario scenario;
    scenario.receiver.noise = false;
    scenario.sonars.emplace_back();
    scenario.sonars[0].beam_count = 31;
    scenario.sonars[0].bin_count = 100;
    scenario.sonars[0].min_range = 0;
    scenario.sonars[0].max_range = 10;

    insonify::Simulator simulator(scenario, scene);
    const insonify::Ping ping = simulator.make_ping(0, 0);
    insonify::Recording recording(arguments[1], simulator.scenario(), simulator.scene(), simulator.sonar(0),
                                  {.replace = true});
    recording.add(ping);
    recording.close();
    if (insonify::RecordedPings(arguments[1]).ping_count() != 1) {  // Read by insonify-read, installed too.
      return 1;
    }

    // The near side of the sphere lies at 5.5 m before the middle beam: at the edge between bins 54 and 55 of 0.1 m
    // each.
    const int middle = 15;
    int bin = 0;
    while (bin < ping.bin_count - 1 && ping.intensity[ping.index(bin, middle)] == 0) {
      ++bin;
    }
    const insonify::Preset preset = insonify::load_preset("tritech-micron-dst");
    std::printf("insonify %s: first echo in bin %d, preset from %s\n", insonify::kVersion, bin, preset.file.c_str());
    return bin == 54 || bin == 55 ? 0 : 1;
  } catch (const insonify::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
