// simulator.cpp -- public functions of Simulator.

#include "insonify/simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "echo/engine.h"
#include "insonify/error.h"
#include "insonify/scenario_requests.h"
#include "simulator/scene_changes.h"
#include "simulator/simulator_state.h"

namespace insonify {

Simulator::Simulator(Scenario scenario, Scene scene, int threads, std::span<const MovableObject> movable,
                     const Log& log, std::uint64_t pings) {
  scenario.validate();
  check_scene(scene);
  if (scenario.pattern) {
    scenario = flown(std::move(scenario), scene);
    scenario.validate();
  }
  state_ = std::make_unique<State>(std::move(scenario), std::move(scene), threads, movable, log, pings);
}

Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

const Scenario& Simulator::scenario() const {
  return state_->scenario;
}
const std::string& Simulator::engine_choice() const {
  return state_->engine_choice;
}
std::span<const std::string> Simulator::too_many_thin_parts() const {
  const std::shared_ptr<const ThinParts>& parts = state_->targets.thin_parts;
  return parts ? std::span<const std::string>(parts->left_out) : std::span<const std::string>();
}

std::size_t Simulator::edges_left_out() const {
  return state_->targets.edges ? state_->targets.edges->left_out : 0;
}

const Scene& Simulator::scene() const {
  return state_->scene;
}
const SonarConfig& Simulator::sonar(int sonar) const {
  return state_->sonar(sonar).config;
}
Engine& Simulator::engine() {
  state_->load_scene();
  return *state_->engine;
}

void Simulator::stop_when(const std::atomic<bool>* asked) {
  state_->workers.stop_when(asked);
}

RayCounts Simulator::ray_counts() const {
  return state_->ray_counts;
}

std::vector<StepTime> Simulator::step_times() const {
  return state_->step_times;
}

EngineMemory Simulator::engine_memory() const {
  return state_->engine->memory();
}

std::vector<double> Simulator::time_traversal(int index, const Pose& world_from_sonar, int repetitions) {
  state_->load_scene();
  std::vector<double> seconds;
  for (const Aperture& aperture : state_->sonar(index).apertures) {
    const PingView view{.plan = aperture.plan.get(),
                        .world_from_sonar = world_from_sonar * aperture.housing_from_aperture};
    const std::vector<double> more = state_->engine->time_traversal(view, repetitions);
    seconds.resize(more.size());
    std::ranges::transform(seconds, more, seconds.begin(), std::plus());
  }
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
  state_->place(sonar, request);
}

void Simulator::ping(std::span<const PingOrder> orders) {
  state_->make(orders);
}

void Simulator::ping(int sonar, const PingRequest& request, Ping& made) {
  const PingOrder order{sonar, &request, &made};
  ping({&order, 1});
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
  (void)state_->sonar(sonar);
  std::vector<PingOrder> orders(requests.size());
  for (std::size_t i = 0; i < requests.size(); ++i) {
    orders[i] = {sonar, &requests[i], &pings[i]};
  }
  ping(orders);
}

Ping Simulator::make_ping(int sonar, std::uint64_t number) {
  return ping(sonar, ScenarioRequests(state_->scenario).at(sonar, number));
}

}  // namespace insonify
