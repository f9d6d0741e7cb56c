// simulator_state.cpp -- sets up a simulator, and moves objects before a ping.

#include "simulator/simulator_state.h"

#include <fmt/format.h>

#include "insonify/error.h"
#include "simulator/sonar_index.h"

namespace insonify {

Simulator::State::State(Scenario the_scenario, Scene the_scene, int threads, std::span<const MovableObject> movable)
    : scenario(std::move(the_scenario)),
      scene(std::move(the_scene)),
      engine(make_engine(scenario.engine, threads)),
      points(scenario.points),
      interference(scenario.interferers) {
  try {
    objects.add(scenario.motions, scene);
  } catch (const Error& error) {
    throw error.located(scenario.places);
  }
  objects.add(movable, scene);
  objects.add_marked(scene);
  if (scenario.surface) {
    sea.emplace(scenario, scene);
  }
  for (const SonarConfig& sonar : scenario.sonars) {
    sonars.push_back(simulated(scenario, sonar));
  }
  set_senders();
  take_in_scene();
}

void Simulator::State::set_senders() {
  senders.clear();
  for (std::size_t i = 0; scenario.mutual_interference && i < sonars.size(); ++i) {
    senders.emplace_back(sonars[i], scenario.receiver_of(sonars[i].config));
  }
}

SimulatedSonar Simulator::State::simulated(const Scenario& in, const SonarConfig& sonar) const {
  return {in, sonar, materials_at(sonar.frequency, in, scene)};
}

SimulatedSonar& Simulator::State::sonar(int index) {
  return sonars[sonar_index(index, sonars.size())];
}

void Simulator::State::take_in_scene() {
  if (scene_changed) {
    engine->set_scene(scene);
    objects.reset(scene);
    if (sea) {
      sea->reset();
    }
    find_object_echoes();
    find_mirrors();
    scene_changed = false;
  }
}

void Simulator::State::find_object_echoes() {
  if (scenario.model != EchoModel::kCalibrated) {
    return;
  }
  std::unique_ptr<Engine> faster;
  if (engine->kind().brute_force) {
    faster = make_engine("cpu", engine->workers().count());
    faster->set_scene(scene);
  }
  Engine& probe = faster ? *faster : *engine;
  ThinParts found = find_thin_parts(scene, probe);
  LeftOut left_out = found.triangles ? *found.triangles : LeftOut{};
  GlintingFaces faces = find_glinting_faces(scene, left_out);
  straight_edges = std::make_shared<const StraightEdges>(find_straight_edges(scene, faces, probe));
  edge_echoes = EdgeEchoes(straight_edges);
  const bool any = found.triangles || faces.any();
  engine->leave_out(any ? std::make_shared<const LeftOut>(std::move(left_out)) : nullptr);
  glinting_faces = std::make_shared<const GlintingFaces>(std::move(faces));
  glints = FaceGlints(glinting_faces);
  thin_parts = std::make_shared<const ThinParts>(std::move(found));
  thin = ThinEchoes(thin_parts);
  lanes.clear();
  poses.clear();
  for (const Instance& instance : scene.instances) {
    poses.push_back(instance.world_from_mesh);
  }
}

void Simulator::State::find_mirrors() {
  if (scenario.model != EchoModel::kCalibrated) {
    return;
  }
  std::optional<WaterMirror> water;
  if (sea) {
    water = WaterMirror{.level = scenario.surface->level, .surface = sea->label()};
  }
  mirrors = std::make_shared<const std::vector<PlaneMirror>>(find_plane_mirrors(scene, -1));
  corners = std::make_shared<const std::vector<Corner>>(find_corners(scene, *mirrors, water));
  corner_echoes = CornerEchoes(corners);
  ghosts = ghosts_of_points();
}

PointGhosts Simulator::State::ghosts_of_points() const {
  std::optional<PointGhosts::Surface> water;
  if (sea) {
    water = PointGhosts::Surface{
        .level = scenario.surface->level, .label = sea->label(), .waves = scenario.surface->wind_speed > 0};
  }
  return {scenario.points, water, mirrors};
}

void Simulator::State::place(const SimulatedSonar& sonar, const PingRequest& request) {
  try {
    request.validate();
    sonar.check(request, scenario.motion_in_ping);
    const Vec3 position = request.world_from_vehicle * sonar.config.position;
    if (sea) {
      sea->check(position);
    }
    take_in_scene();
    objects.place(request.moved, scene, *engine);
    objects.store(poses);
    if (sea) {
      sea->place(position, *engine);
    }
  } catch (const Error& error) {
    throw Error(fmt::format("ping {} of {}: {}", request.number, sonar.config.name, error.what()));
  }
}

}  // namespace insonify
