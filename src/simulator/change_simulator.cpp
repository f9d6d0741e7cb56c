// change_simulator.cpp -- changes sonars and objects of a simulator between pings.

#include "insonify/error.h"
#include "simulator/scene_changes.h"
#include "simulator/simulator_state.h"

namespace insonify {

void Simulator::set_sonar(int index, const SonarConfig& config) {
  State& state = *state_;
  Scenario changed = state.scenario;
  (void)state.sonar(index);
  const std::string name = changed.sonars[index].name;
  changed.sonars[index] = config;
  changed.sonars[index].name = name;
  changed.validate();
  state.sonars[index] = state.simulated(changed, changed.sonars[index]);
  state.lanes.clear();
  state.scenario.sonars[index] = changed.sonars[index];
  if (state.sea && state.sea->fit(changed, state.scene)) {
    state.scene_changed = true;
  }
}

int Simulator::add_objects(const Scene& objects, std::span<const MovableObject> movable) {
  State& state = *state_;
  Scene& scene = state.scene;
  const std::size_t instances = scene.instances.size(), materials = scene.materials.size();
  state.scene_changed = true;  // Also on failure: instances may have been reallocated.
  add_to_scene(objects, scene);
  try {
    MovableObjects moving = state.objects;
    moving.add(movable, scene, instances);
    moving.add_marked(scene, instances);
    state.objects = std::move(moving);
  } catch (const Error&) {
    scene.instances.resize(instances);
    scene.materials.resize(materials);
    throw;
  }
  state.lanes.clear();
  if (scene.materials.size() > materials) {  // Plans and receivers have tables of all materials.
    for (std::size_t i = 0; i < state.sonars.size(); ++i) {
      state.sonars[i] = state.simulated(state.scenario, state.scenario.sonars[i]);
    }
  }
  return static_cast<int>(instances);
}

void Simulator::remove_object(std::string_view name) {
  state_->scene_changed = true;
  remove_from_scene(name, state_->scene);
}

}  // namespace insonify
