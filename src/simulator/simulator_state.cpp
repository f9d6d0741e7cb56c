// simulator_state.cpp -- sets up a simulator, and loads its scene.

#include "simulator/simulator_state.h"

#include "insonify/error.h"
#include "simulator/checks.h"

namespace insonify {

Simulator::State::State(Scenario the_scenario, Scene the_scene, int threads, std::span<const MovableObject> movable)
    : scenario(std::move(the_scenario)),
      scene(std::move(the_scene)),
      workers(threads),
      engine(make_engine(scenario.engine, workers, scenario.device)) {
  if (scenario.model == EchoModel::kPaper) {
    engine->expect_paper();
  }
  try {
    objects.add(scenario.motions, scene);
  } catch (const Error& error) {
    throw error.located(scenario.places);
  }
  objects.add(movable, scene, 0, scene.instances.size());
  objects.add_marked(scene, 0, scene.instances.size());
  if (scenario.surface) {
    sea.emplace(scenario, scene);
  }
  for (const SonarConfig& sonar : scenario.sonars) {
    sonars.push_back(simulated(scenario, sonar));
  }
  set_senders();
  load_scene();
}

void Simulator::State::set_senders() {
  senders.clear();
  for (std::size_t i = 0; scenario.mutual_interference && i < sonars.size(); ++i) {
    senders.emplace_back(sonars[i], scenario.receiver_of(sonars[i].config));
  }
  for (SimulatedSonar& sonar : sonars) {
    sonar.sources.clear();  // They refer to the senders.
  }
}

SimulatedSonar Simulator::State::simulated(const Scenario& in, const SonarConfig& sonar) const {
  return {in, sonar, materials_at(sonar.frequency, in, scene)};
}

SimulatedSonar& Simulator::State::sonar(int index) {
  return sonars[sonar_index(index, sonars.size())];
}

void Simulator::State::load_scene() {
  if (!scene_changed) {
    return;
  }
  engine->set_scene(scene);
  runner.emplace(*engine, workers);
  at_home.clear();
  for (const Instance& instance : scene.instances) {
    at_home.push_back(instance.world_from_mesh);
  }
  if (scenario.model == EchoModel::kCalibrated) {
    std::optional<WaterMirror> water;
    if (sea) {
      water = WaterMirror{.level = scenario.surface->level, .surface = sea->label()};
    }
    const bool corners = scenario.secondary != SecondaryEchoes::kNone && scenario.max_surfaces >= 3;
    const WantedTargets wanted{.mirrors = !scenario.points.empty(), .corners = corners};
    targets = find_targets(scene, water, wanted, *engine, workers);
  }
  for (SimulatedSonar& sonar : sonars) {
    sonar.sources.clear();
  }
  scene_changed = false;
}

}  // namespace insonify
