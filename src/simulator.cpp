// simulator.cpp -- public functions of Simulator. ping() calls the modules in the order of the data.

#include "insonify/simulator.h"

#include <fmt/format.h>

#include "echo/engine.h"
#include "insonify/error.h"
#include "insonify/scenario_requests.h"
#include "receiver/paper_receiver.h"
#include "simulator/scene_changes.h"
#include "simulator/simulator_state.h"

namespace insonify {

Simulator::Simulator(Scenario scenario, Scene scene, int threads, std::span<const MovableObject> movable) {
  scenario.validate();
  check_scene(scene);
  state_ = std::make_unique<State>(std::move(scenario), std::move(scene), threads, movable);
}

Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

const Scenario& Simulator::scenario() const {
  return state_->scenario;
}
const Scene& Simulator::scene() const {
  return state_->scene;
}
const SonarConfig& Simulator::sonar(int sonar) const {
  return state_->sonar(sonar).config;
}
Engine& Simulator::engine() {
  state_->take_in_scene();
  return *state_->engine;
}

void Simulator::stop_when(const std::atomic<bool>* asked) {
  state_->engine->stop_when(asked);
}

RayCounts Simulator::ray_counts() const {
  return state_->engine->ray_counts();
}

EngineMemory Simulator::engine_memory() const {
  return state_->engine->memory();
}

std::vector<double> Simulator::time_traversal(int index, const Pose& world_from_sonar, int repetitions) {
  state_->take_in_scene();
  const PingPlan& plan = *state_->sonar(index).plan;
  std::vector<double> seconds = state_->engine->time_traversal(plan, world_from_sonar, repetitions);
  if (seconds.empty()) {
    throw Error(fmt::format("engine \"{}\" traces its rays itself: there is no bare traversal to time",
                            state_->scenario.engine));
  }
  return seconds;
}

Pose Simulator::world_from_housing(int index, const PingRequest& request) const {
  return request.world_from_vehicle * state_->sonar(index).vehicle_from_housing;
}

Pose Simulator::world_from_head(int index, const PingRequest& request) const {
  return world_from_housing(index, request) * housing_from_head(state_->sonar(index).head_angle(request));
}

Scene Simulator::scene_at(const PingRequest& request) {
  request.validate();
  return state_->objects.placed(request.moved, state_->scene);
}

void Simulator::place(int sonar, const PingRequest& request) {
  state_->place(state_->sonar(sonar), request);
}

void Simulator::ping(int index, const PingRequest& request, Ping& ping) {
  State& state = *state_;
  const Scenario& scenario = state.scenario;
  SimulatedSonar& sonar = state.sonar(index);

  // Poses of moved objects, vehicle, sonar and head.
  state.place(sonar, request);
  ping.number = request.number;
  ping.time = request.time;
  ping.head_angle = sonar.head_angle(request);
  ping.world_from_sonar = request.world_from_vehicle * sonar.vehicle_from_housing;
  const Pose head = housing_from_head(ping.head_angle), world_from_sonar = ping.world_from_sonar * head;

  // Echoes sorted by beam and range, then the receiver.
  EchoGrid& grid = sonar.grid;
  const PingPlan& plan = *sonar.plan;
  if (scenario.model == EchoModel::kCalibrated) {
    state.engine->insonify(plan, world_from_sonar, grid);
    grid.discrete_echoes().clear();
    state.points.add(plan, world_from_sonar, *state.engine, grid);
    if (state.ghosts) {
      state.ghosts->add(plan, world_from_sonar, request.number, scenario.receiver_of(sonar.config).speckle,
                        *state.engine, grid);
    }
    state.interference.add(plan, world_from_sonar, request.time, *state.engine, grid);
    const PingMotion motion = scenario.motion_in_ping
                                  ? sonar.motion_while_listening(request, sonar.vehicle_from_housing * head)
                                  : PingMotion{};
    sonar.receiver->receive(grid, world_from_sonar, motion, state.workers, ping);
  } else {
    PaperReceiver receiver(
        grid, sonar.config,
        {.model = scenario.paper, .noise = scenario.receiver_of(sonar.config).noise, .seed = scenario.seed}, ping);
    state.engine->insonify(plan, world_from_sonar, grid);
    receiver.receive(state.workers);
  }
}

Ping Simulator::ping(int sonar, const PingRequest& request) {
  Ping made;
  ping(sonar, request, made);
  return made;
}

void Simulator::ping(int sonar, std::span<const PingRequest> requests, std::span<Ping> pings) {
  if (requests.size() != pings.size()) {
    throw Error(fmt::format("{} requests must have as many pings to fill, not {}", requests.size(), pings.size()));
  }
  for (std::size_t i = 0; i < requests.size(); ++i) {
    ping(sonar, requests[i], pings[i]);
  }
}

Ping Simulator::make_ping(int sonar, std::uint64_t number) {
  return ping(sonar, ScenarioRequests(state_->scenario).at(sonar, number));
}

}  // namespace insonify
