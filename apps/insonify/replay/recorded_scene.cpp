// recorded_scene.cpp -- finds the files of a recorded scenario, and compares the scene with the recording.

#include "replay/recorded_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "insonify/files.h"

namespace insonify {
namespace {

Scene scene_of_names(std::span<const std::string> instances, std::span<const std::string> materials) {
  Scene scene;
  const auto nothing = std::make_shared<const Mesh>();
  for (const std::string& name : instances) {
    scene.instances.push_back({.name = name, .mesh = nothing});
  }
  for (const std::string& name : materials) {
    scene.materials.push_back({.name = name});
  }
  return scene;
}

// A world that has changed since would give labels wrong names.
bool is_named(const Scene& scene, std::span<const std::string> instances) {
  return instances.empty() || std::ranges::equal(scene.instances, instances, {}, &Instance::name);
}

RecordedScene read(const std::string& text, const std::filesystem::path& folder) {
  RecordedScene found;
  Scenario scenario = parse_scenario(text, folder);
  Scene world = load_scene(scenario);
  found.simulator.emplace(scenario, std::move(world));
  found.scene = found.simulator->scene();
  if (scenario.motions.empty()) {
    found.simulator.reset();
  }
  found.scenario = std::move(scenario);
  return found;
}

}  // namespace

std::vector<std::filesystem::path> folders_of(std::span<const std::filesystem::path> recordings,
                                              const std::filesystem::path& folder) {
  if (!folder.empty()) {
    return {folder};
  }
  std::vector<std::filesystem::path> folders;
  const auto add = [&](const std::filesystem::path& one) {
    if (std::ranges::find(folders, one) == folders.end()) {
      folders.push_back(one);
    }
  };
  for (const std::filesystem::path& recording : recordings) {
    const std::filesystem::path beside = std::filesystem::absolute(recording).lexically_normal().parent_path();
    add(beside);
    add(beside.parent_path());
  }
  add(std::filesystem::current_path());
  return folders;
}

RecordedScene recorded_scene(const std::string& scenario, std::span<const std::string> instances,
                             std::span<const std::string> materials, std::span<const std::filesystem::path> folders,
                             const Log& log) {
  std::string why;
  for (const std::filesystem::path& folder : folders) {
    try {
      RecordedScene found = read(scenario, folder);
      if (is_named(found.scene, instances)) {
        return found;
      }
      why = fmt::format("the world in {} has other objects than the recording", folder.string());
      break;
    } catch (const Error& error) {
      why = why.empty() ? error.what() : why;
    }
  }
  log(Severity::kWarning,
      fmt::format("the scene is shown without its objects: {} (--folder DIR names the scenario's folder)", why));
  return {scene_of_names(instances, materials)};
}

std::vector<MovedInstance> moved_instances(Simulator& simulator, const ScenarioRequests& requests, int sonar,
                                           const Ping& ping) {
  const Scene scene = simulator.scene_at(requests.at(sonar, ping.number, ping.time));
  std::vector<MovedInstance> moved;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (scene.instances[i].moving && !scene.instances[i].endless) {
      moved.push_back({static_cast<int>(i), scene.instances[i].world_from_mesh});
    }
  }
  return moved;
}

}  // namespace insonify
