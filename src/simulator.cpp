// simulator.cpp -- the whole simulator on one page: every step is a call into one module, in the order of the data.

#include "insonify/simulator.h"

#include <fmt/format.h>

#include "base/parallel.h"
#include "echo/targets/interference.h"
#include "echo/targets/point_echoes.h"
#include "echo/targets/surface_ghosts.h"
#include "insonify/error.h"
#include "receiver/calibrated_receiver.h"
#include "receiver/line_array.h"
#include "receiver/paper_receiver.h"
#include "simulator/motion.h"
#include "simulator/sea_level.h"

namespace insonify {

struct Simulator::State {
  State(Scenario the_scenario, Scene the_scene, int threads)
      : scenario(std::move(the_scenario)),
        scene(std::move(the_scene)),
        engine(make_engine(scenario.engine, threads)),
        workers(threads),
        points(scenario.points),
        interference(scenario.interferers) {}

  Scenario scenario;
  Scene scene;
  std::vector<MovingPart> moving;
  std::unique_ptr<Engine> engine;
  Workers workers;  // Of what comes after the engine.
  PointEchoes points;
  std::optional<SurfaceGhosts> ghosts;
  Interference interference;

  // Of each sonar, kept between pings so that a ping allocates nothing.
  std::vector<std::shared_ptr<const PingPlan>> plans;
  std::vector<EchoGrid> grids;
  std::vector<CalibratedReceiver> receivers;  // None in the paper model.
};

namespace {

// The paper model's beams are top hats.
ReceiverConfig receiver_of(const Scenario& scenario) {
  ReceiverConfig receiver = scenario.receiver;
  if (scenario.model == EchoModel::kPaper) {
    receiver.azimuth_pattern = receiver.elevation_pattern = BeamPattern::kTopHat;
    receiver.beam_shape = BeamShape::kWedge;
    receiver.speckle = false;
  }
  return receiver;
}

std::optional<ArraySettings> elevation_array(const ReceiverConfig& receiver, const SonarConfig& sonar) {
  if (receiver.elevation_pattern == BeamPattern::kTopHat) {
    return {};
  }
  return line_array(receiver.elevation_pattern, receiver.side_lobe_db, sonar.elevation_aperture);
}

std::vector<float> cell_angles(const PingPlan& plan) {
  std::vector<float> angles;
  angles.reserve(plan.sonar.beam_count);
  for (int cell = 0; cell < plan.sonar.beam_count; ++cell) {
    angles.push_back(static_cast<float>(plan.lattice.beam_angle(cell)));
  }
  return angles;
}

// Of the echoes that there may be.
int order_count(const Scenario& scenario) {
  const int most = scenario.model == EchoModel::kPaper ? 2 : kPathOrders;
  return scenario.secondary == SecondaryEchoes::kNone ? 1 : std::min(most, scenario.max_surfaces);
}

// Of the transducer, from transmission until the last echo is back: steady, on the straight way between both ends.
PingMotion motion_while_listening(const Scenario& scenario, const SonarConfig& sonar, const Ping& ping) {
  if (!scenario.motion_in_ping) {
    return {};
  }
  const double time = 2 * sonar.max_range / *sonar.assumed_sound_speed;
  const Pose mounting = sonar.vehicle_from_sonar();
  const Pose head{Vec3::Zero(), orientation_from_rpy(0, 0, ping.head_angle)};
  const auto pose_at = [&](double when) { return scenario.trajectory.at(when) * mounting * head; };
  return motion_between(pose_at(ping.time), pose_at(ping.time + time), time);
}

}  // namespace

Simulator::Simulator(Scenario scenario, Scene scene, int threads) {
  scenario.validate();
  for (const Instance& instance : scene.instances) {
    check_reach(instance, instance.name);
  }
  if (scenario.surface) {
    add_sea_surface(scenario, scene);
  }
  state_ = std::make_unique<State>(std::move(scenario), std::move(scene), threads);
  state_->moving = find_moving_parts(state_->scenario, state_->scene);
  for (SonarConfig& sonar : state_->scenario.sonars) {
    const Water water = state_->scenario.water_at(sonar);
    sonar.assumed_sound_speed = sonar.assumed_sound_speed.value_or(water.true_sound_speed());
    sonar.ping_period = sonar.ping_period.value_or(sonar.shortest_ping_period(*sonar.assumed_sound_speed));
    const ReceiverConfig receiver = receiver_of(state_->scenario);
    const BearingCells cells(sonar, receiver);
    state_->plans.push_back(make_ping_plan({.sonar = cells.sonar,
                                            .water = water,
                                            .model = state_->scenario.model,
                                            .paper = state_->scenario.paper,
                                            .materials = state_->scene.materials,
                                            .beam_shape = receiver.beam_shape,
                                            .elevation_array = elevation_array(receiver, sonar),
                                            .primary = state_->scenario.primary,
                                            .secondary = state_->scenario.secondary,
                                            .max_surfaces = state_->scenario.max_surfaces,
                                            .rough_mirrors = state_->scenario.rough_mirrors,
                                            .seed = state_->scenario.seed}));
    state_->grids.emplace_back(cells.sonar.beam_count, sonar.bin_count, order_count(state_->scenario),
                               state_->scenario.ground_truth, receiver.speckle);
    if (state_->scenario.model == EchoModel::kCalibrated) {
      const std::vector<float> angles = cell_angles(*state_->plans.back());
      state_->receivers.emplace_back(CalibratedReceiver::Settings{.sonar = sonar,
                                                                  .cells = cells,
                                                                  .cell_angles = angles,
                                                                  .water = water,
                                                                  .receiver = state_->scenario.receiver,
                                                                  .materials = state_->scene.materials,
                                                                  .moves = state_->scenario.motion_in_ping,
                                                                  .seed = state_->scenario.seed});
    }
  }
  if (const std::optional<SeaSurface>& surface = state_->scenario.surface) {
    const auto label = surface_label(static_cast<std::uint16_t>(state_->scene.instances.size() - 1),
                                     static_cast<std::uint16_t>(state_->scene.materials.size() - 1));
    state_->ghosts.emplace(
        state_->scenario.points,
        SurfaceGhosts::Surface{surface->level, label, surface->wind_speed > 0 && state_->scenario.receiver.speckle});
  }
  state_->engine->set_scene(state_->scene);
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
  return state_->scenario.sonars.at(sonar);
}
Engine& Simulator::engine() {
  return *state_->engine;
}

Pose Simulator::world_from_housing(int index, std::uint64_t number) const {
  const SonarConfig& config = sonar(index);
  const double time = static_cast<double>(number) * *config.ping_period;
  return state_->scenario.trajectory.at(time) * config.vehicle_from_sonar();
}

Pose Simulator::world_from_head(int index, std::uint64_t number) const {
  const Pose head{Vec3::Zero(), orientation_from_rpy(0, 0, sonar(index).head_angle(number))};
  return world_from_housing(index, number) * head;
}

void Simulator::make_ping(int index, std::uint64_t number, Ping& ping) {
  State& state = *state_;
  const SonarConfig& config = sonar(index);

  // When and where: the vehicle on its trajectory, the head on its step, and what moves in the world.
  ping.number = number;
  ping.time = static_cast<double>(number) * *config.ping_period;
  ping.world_from_sonar = state.scenario.trajectory.at(ping.time) * config.vehicle_from_sonar();
  ping.head_angle = config.head_angle(number);
  for (const MovingPart& part : state.moving) {
    state.engine->move_instance(part.instance, part.world_from_mesh(state.scenario, ping.time));
  }

  // What comes back, sorted by beam and range, and what the receiver makes of it.
  EchoGrid& grid = state.grids[index];
  const PingPlan& plan = *state.plans[index];
  const Pose world_from_sonar = world_from_head(index, number);
  if (state.scenario.model == EchoModel::kCalibrated) {
    state.engine->insonify(plan, world_from_sonar, number, grid, nullptr);
    grid.discrete_echoes().clear();
    state.points.add(plan, world_from_sonar, *state.engine, grid);
    if (state.ghosts) {
      state.ghosts->add(plan, world_from_sonar, number, *state.engine, grid);
    }
    state.interference.add(plan, world_from_sonar, ping.time, *state.engine, grid);
    state.receivers[index].receive(grid, world_from_sonar, motion_while_listening(state.scenario, config, ping),
                                   state.workers, ping);
  } else {
    PaperReceiver receiver(
        grid, config,
        {.model = state.scenario.paper, .noise = state.scenario.receiver.noise, .seed = state.scenario.seed}, ping);
    state.engine->insonify(plan, world_from_sonar, number, grid, &receiver);
  }
}

Ping Simulator::make_ping(int sonar, std::uint64_t number) {
  Ping ping;
  make_ping(sonar, number, ping);
  return ping;
}

}  // namespace insonify
