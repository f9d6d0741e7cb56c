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
      workers(threads),
      points(scenario.points),
      interference(scenario.interferers) {
  try {
    objects.add(scenario.motions, scene);
  } catch (const Error& error) {
    throw error.located(scenario.places);
  }
  objects.add(movable, scene);
  objects.add_marked(scene);
  if (const std::optional<SeaSurface>& surface = scenario.surface) {
    sea.emplace(scenario, scene);
    const auto label = surface_label(static_cast<std::uint16_t>(sea->instance()), sea->material());
    ghosts.emplace(scenario.points, SurfaceGhosts::Surface{surface->level, label, surface->wind_speed > 0});
  }
  for (const SonarConfig& sonar : scenario.sonars) {
    sonars.push_back(simulated(scenario, sonar));
  }
  take_in_scene();
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
    scene_changed = false;
  }
}

void Simulator::State::find_object_echoes() {
  if (scenario.model != EchoModel::kCalibrated) {
    return;
  }
  ThinParts found;
  if (engine->kind().brute_force) {
    const std::unique_ptr<Engine> faster = make_engine("cpu", workers.count());
    faster->set_scene(scene);
    found = find_thin_parts(scene, *faster);
  } else {
    found = find_thin_parts(scene, *engine);
  }
  LeftOut left_out = found.triangles ? *found.triangles : LeftOut{};
  GlintingFaces faces = find_glinting_faces(scene, left_out);
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
