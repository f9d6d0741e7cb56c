// change_simulator.cpp -- changes sonars and objects of a simulator between pings.

#include <algorithm>

#include "insonify/error.h"
#include "simulator/checks.h"
#include "simulator/scene_changes.h"
#include "simulator/simulator_state.h"

namespace insonify {

PreparedSonar::PreparedSonar() = default;
PreparedSonar::~PreparedSonar() = default;
PreparedSonar::PreparedSonar(PreparedSonar&&) noexcept = default;
PreparedSonar& PreparedSonar::operator=(PreparedSonar&&) noexcept = default;

void Simulator::State::set(int index, SimulatedSonar sonar, const Scenario& changed) {
  sonars[index] = std::move(sonar);
  start_runner();  // Its grids have the shape of the earlier sonar.
  scenario.sonars[index] = changed.sonars[index];
  set_senders();
  if (sea && sea->fit(changed, scene)) {
    scene_changed = true;
  }
}

void Simulator::set_sonar(int index, const SonarConfig& config) {
  State& state = *state_;
  Scenario changed = state.scenario;
  (void)state.sonar(index);
  const std::string name = changed.sonars[index].name;
  changed.sonars[index] = config;
  changed.sonars[index].name = name;
  changed.validate();
  state.set(index, state.simulated(changed, changed.sonars[index]), changed);
}

PreparedSonar Simulator::prepare_sonar(const Scenario& scenario, int sonar, const Scene& scene) {
  const SonarConfig& config = scenario.sonars[sonar_index(sonar, scenario.sonars.size())];
  PreparedSonar prepared;
  prepared.config_ = config;
  prepared.materials_ = scene.materials;
  prepared.made_ = std::make_unique<SimulatedSonar>(scenario, config, materials_at(config.frequency, scenario, scene));
  return prepared;
}

void Simulator::set_sonar(int index, PreparedSonar prepared) {
  State& state = *state_;
  (void)state.sonar(index);
  const bool fits = prepared.made_ && prepared.materials_ == state.scene.materials &&
                    prepared.config_.name == state.scenario.sonars[index].name;
  if (!fits) {  // Objects have brought materials since.
    set_sonar(index, prepared.config_);
    return;
  }
  Scenario changed = state.scenario;
  changed.sonars[index] = prepared.config_;
  changed.validate();
  state.set(index, std::move(*prepared.made_), changed);
}

int Simulator::add_objects(const Scene& objects, std::span<const MovableObject> movable) {
  State& state = *state_;
  Scene& scene = state.scene;
  const std::size_t instances = scene.instances.size(), first = free_index(scene, objects.instances.size()),
                    last = first + objects.instances.size();
  const std::vector<Instance> removed(scene.instances.begin() + static_cast<std::ptrdiff_t>(std::min(first, instances)),
                                      scene.instances.begin() + static_cast<std::ptrdiff_t>(std::min(last, instances)));
  const std::vector<Material> materials = scene.materials;
  state.scene_changed = true;  // Also on failure: instances may have been reallocated.
  add_to_scene(objects, first, scene);
  try {
    MovableObjects moving = state.objects;
    moving.add(movable, scene, first, last);
    moving.add_marked(scene, first, last);
    state.objects = std::move(moving);
  } catch (const Error&) {
    scene.instances.resize(instances);
    std::ranges::copy(removed, scene.instances.begin() + static_cast<std::ptrdiff_t>(first));
    scene.materials = materials;
    throw;
  }
  if (scene.materials != materials) {  // Plans and receivers have tables of all materials.
    for (std::size_t i = 0; i < state.sonars.size(); ++i) {
      state.sonars[i] = state.simulated(state.scenario, state.scenario.sonars[i]);
    }
  }
  return static_cast<int>(first);
}

void Simulator::remove_object(std::string_view name) {
  state_->scene_changed = true;
  remove_from_scene(name, state_->scene);
  state_->objects.forget_removed(state_->scene);
}

}  // namespace insonify
