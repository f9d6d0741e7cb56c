// live_change.cpp -- applies requests to a scenario, and builds simulators for the result.

#include "live/live_change.h"

#include <fmt/format.h>

#include <algorithm>

#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/printable.h"

namespace insonify {

LiveStart start_after(LiveWay way, const Pose& place, const Scenario& scenario, const LiveStanding& standing) {
  if (way == LiveWay::kGoesOn && standing.start.follows) {
    const bool shifts = scenario.motions.empty();
    return {.follows = true, .world_from_vehicle = {}, .time = shifts ? standing.start.time + standing.next_time : 0};
  }
  if (way == LiveWay::kFromStart) {
    return {};
  }
  return {.follows = false, .world_from_vehicle = way == LiveWay::kPlaced ? place : standing.next_pose};
}

Scene LiveBuilder::scene_of(const Scenario& scenario, const LiveObjectList& objects, const Log& log) {
  if (!scenario.world.empty() && (scenario.world != world_path_ || world_options(scenario) != options_)) {
    world_ = load_scene(scenario.world, world_options(scenario), log);
    world_path_ = scenario.world;
    options_ = world_options(scenario);
  }
  Scene scene = scenario.world.empty() ? Scene() : world_;
  for (const LiveObject& object : objects) {
    scene.instances.push_back(object.instance);
  }
  return scene;
}

Scenario LiveBuilder::scenario_of(const LiveSettings& settings, const LiveObjectList& objects, const Log& log) {
  Scenario scenario = settings.scenario(log);
  return scenario.pattern ? flown(scenario, scene_of(scenario, objects, log)) : scenario;
}

std::unique_ptr<Simulator> LiveBuilder::build(const Scenario& scenario, const LiveStart& start,
                                              const LiveObjectList& objects, const Log& log) {
  Scene scene = scene_of(scenario, objects, log);
  assign_scenario_materials(scene, scenario, log);
  return std::make_unique<Simulator>(scenario_from(scenario, start), std::move(scene), threads_,
                                     std::span<const MovableObject>(), log);
}

LivePrepared LiveBuilder::prepare(std::span<const LiveChange> changes, const LiveSettings& settings,
                                  const Scenario& scenario, const LiveStanding& standing, const LiveObjectList& objects,
                                  const Scene& scene, const Log& log) {
  LivePrepared next{.settings = settings, .scenario = scenario};
  bool text_changes = false, materials_change = false;
  for (const LiveChange& change : changes) {
    next.settings.add(change.settings);
    text_changes = text_changes || !change.settings.empty();
    if (change.material) {
      next.settings.materials[change.material->first] = change.material->second;
      materials_change = true;
    }
    if (change.way != LiveWay::kGoesOn) {
      next.way = change.way;
      next.place = change.place;
    }
    if (!change.recording.empty()) {
      next.recording = change.recording;
      next.replace = change.replace;
    }
  }
  if (text_changes || materials_change) {
    next.scenario = scenario_of(next.settings, objects, log);
  }
  // Under a surface the sound speed follows from the vehicle's initial depth.
  const bool by_depth = next.scenario.surface.has_value();
  if (by_depth || ((text_changes || materials_change) && !differ_in_sonars_only(scenario, next.scenario))) {
    const LiveStart start = start_after(next.way, next.place, next.scenario, standing);
    next.simulator = build(next.scenario, start, objects, log);
    next.objects = objects;
    if (by_depth) {
      next.start = start;
    }
  } else if (text_changes) {
    for (std::size_t i = 0; i < next.scenario.sonars.size(); ++i) {
      next.sonars.push_back(Simulator::prepare_sonar(next.scenario, static_cast<int>(i), scene));
    }
  }
  return next;
}

}  // namespace insonify
