// make_pings.cpp -- makes one ping, stage by stage, or many pings on all threads.

#include "insonify/error.h"
#include "receiver/paper_receiver.h"
#include "simulator/find_thrusters.h"
#include "simulator/simulator_state.h"

namespace insonify {

void Simulator::State::make(const PingRequest& request, SimulatedSonar& sonar, const Parts& parts, Ping& ping) {
  // Poses of vehicle, sonar and head.
  ping.number = request.number;
  ping.time = request.time;
  ping.head_angle = sonar.head_angle(request);
  ping.world_from_sonar = request.world_from_vehicle * sonar.vehicle_from_housing;
  const Pose head = housing_from_head(ping.head_angle), world_from_sonar = ping.world_from_sonar * head;

  // Echoes sorted by beam and range, then the receiver.
  EchoGrid& grid = sonar.grid;
  const PingPlan& plan = *sonar.plan;
  if (scenario.model == EchoModel::kCalibrated) {
    parts.engine.insonify(plan, world_from_sonar, grid);
    parts.thin.add(plan, world_from_sonar, poses, parts.engine, grid);
    if (sonar.walks) {
      sonar.walks->add(plan, world_from_sonar, request.number,
                       {.corners = parts.corners.act(plan), .water = sea ? sea->label() : kNoSurface}, parts.engine,
                       grid);
    }
    grid.discrete_echoes().clear();
    parts.corners.add(plan, world_from_sonar, poses, parts.engine, grid);
    parts.points.add(plan, world_from_sonar, parts.engine, grid);
    parts.glints.add(plan, world_from_sonar, poses, parts.engine, grid);
    parts.edges.add(plan, world_from_sonar, poses, parts.glints.shown(), parts.engine, grid);
    parts.ghosts.add(plan, world_from_sonar, request.number, scenario.receiver_of(sonar.config).speckle, parts.engine,
                     grid);
    const ReceiverConfig receiver = scenario.receiver_of(sonar.config);
    parts.interference.add(plan, world_from_sonar, request.time, receiver.azimuth_pattern != BeamPattern::kTopHat,
                           parts.engine, grid);
    if (!senders.empty()) {
      add_mutual_interference(senders, sonar, receiver, request, world_from_sonar, parts.engine, grid);
    }
    if (!scenario.thrusters.empty()) {
      find_thrusters(scenario.thrusters, sonar.vehicle_from_housing * head, request.world_from_vehicle, parts.engine,
                     sonar.thrusters);
    }
    const PingMotion motion = scenario.motion_in_ping
                                  ? sonar.motion_while_listening(request, sonar.vehicle_from_housing * head)
                                  : PingMotion{};
    sonar.receiver->receive(grid, objects.displaced(), world_from_sonar, motion, sonar.thrusters,
                            parts.engine.workers(), ping);
  } else {
    PaperReceiver receiver(
        grid, sonar.config,
        {.model = scenario.paper, .noise = scenario.receiver_of(sonar.config).noise, .seed = scenario.seed}, ping);
    parts.engine.insonify(plan, world_from_sonar, grid);
    receiver.receive(parts.engine.workers());
  }
}

std::size_t Simulator::State::count_together(int index, std::span<const PingRequest> requests) const {
  const std::size_t threads = engine->workers().count();
  // Where there are few, a thread that waits for the last of them would cost more than is gained.
  constexpr std::size_t kFewest = 2;
  if (threads < 2 || requests.size() <= kFewest * threads || sea) {  // The sea's plane goes with the sonar.
    return 0;
  }
  const SimulatedSonar& sonar = sonars[index];
  std::size_t count = 0;
  try {
    while (count + 2 < requests.size() && requests[count].moved.empty() && requests[count + 1].moved.empty()) {
      requests[count + 1].validate();
      sonar.check(requests[count + 1], scenario.motion_in_ping);
      ++count;
    }
  } catch (const Error&) {  // ping() will throw it again, after the pings before it.
  }
  return count / threads * threads;
}

void Simulator::State::make_together(int index, std::span<const PingRequest> requests, std::span<Ping> pings) {
  if (requests.empty()) {
    return;
  }
  Workers& workers = engine->workers();
  lanes.resize(sonars.size());
  std::vector<std::unique_ptr<Lane>>& own = lanes[index];
  while (own.size() < static_cast<std::size_t>(workers.count())) {
    std::unique_ptr<Engine> sharing = engine->share_scene();
    if (sharing == nullptr) {  // An engine that cannot.
      for (std::size_t i = 0; i < requests.size(); ++i) {
        make(requests[i], sonars[index], parts(), pings[i]);
      }
      return;
    }
    own.push_back(std::unique_ptr<Lane>(
        new Lane{std::move(sharing), PointEchoes(scenario.points), Interference(scenario.interferers),
                 ThinEchoes(thin_parts), FaceGlints(glinting_faces), EdgeEchoes(straight_edges), CornerEchoes(corners),
                 ghosts_of_points(), simulated(scenario, scenario.sonars[index])}));
  }
  for (const auto& lane : own) {
    lane->own_engine->stop_when(stop_asked);
  }
  workers.for_each(static_cast<int>(requests.size()), [&](int ping, int worker) {
    Lane& lane = *own[worker];
    make(requests[ping], lane.sonar, lane.parts(), pings[ping]);
  });
}

}  // namespace insonify
