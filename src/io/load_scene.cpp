// load_scene.cpp -- reads a scenario's world by its ending: SDF, Stonefish, a mesh or a height grid.

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <set>

#include "base/log_line.h"
#include "base/utf8.h"
#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/printable.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/file/reader_process.h"
#include "io/file/scene_folders.h"
#include "io/grid/height_grid_file.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/relief_file.h"
#include "io/odd_world.h"
#include "io/stonefish/stonefish_scene.h"
#include "io/world/sdf_reader.h"

namespace insonify {
namespace {

void add_instance(const std::filesystem::path& path, const std::string& name, Mesh mesh, Scene& scene) {
  Instance instance;
  instance.name = name;
  instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
  check_reach(instance, path.string());
  scene.instances.push_back(std::move(instance));
}

Scene scene_of(const std::filesystem::path& path, Mesh mesh) {
  Scene scene;
  add_instance(path, as_utf8(path.stem().string()), std::move(mesh), scene);
  return scene;
}

Scene scene_of_parts(const std::filesystem::path& path, const Log& log) {
  Scene scene;
  for (Mesh& part : load_mesh_parts(path, log)) {
    const std::string name = fmt::format("{}::{}", as_utf8(path.stem().string()), part.name);
    add_instance(path, name, std::move(part), scene);
  }
  return scene;
}

// COLLADA says which axis is up; like Gazebo we do not turn it. Of a part of a world its SDF file says so.
void warn_of_up_axis(const std::filesystem::path& path, const Log& log) {
  if (ending_of(path) != ".dae" || is_stream(path)) {
    return;
  }
  constexpr std::string_view kKey = "<up_axis>";
  std::string start(65536, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  const std::size_t key = start.find(kKey);
  const std::string_view axis = key == std::string::npos ? "" : std::string_view(start).substr(key + kKey.size(), 4);
  if (axis == "Y_UP" || axis == "X_UP") {
    log_line(log, Severity::kWarning,
             fmt::format("{}: says {}, which is not applied, as in Gazebo: z is up", path.string(), axis));
  }
}

}  // namespace

WorldOptions world_options(const Scenario& scenario) {
  return {scenario.collisions, scenario.strict,    scenario.ignore,
          scenario.keep_water, scenario.arguments, scenario.parts};
}

namespace {

Scene load_any(const std::filesystem::path& path, const WorldOptions& options, const Log& log) {
  static const std::set<std::string> kSdf = {".sdf", ".world", ".xml"};
  static const std::set<std::string> kMeshesToConvert = {".osgb", ".osg", ".osgt", ".ive"};
  const std::string ending = ending_of(path);
  if (kSdf.contains(ending)) {
    return sdf_reader(path).load_scene(path, options, log);
  }
  if (ending == ".scn") {
    return load_stonefish_scene(path, options, log);
  }
  if (is_height_grid_file(path)) {
    return scene_of(path, height_field_of(load_height_grid(path, log)));
  }
  if (is_mesh_file(path) || kMeshesToConvert.contains(ending)) {
    warn_of_up_axis(path, log);
    if (options.parts) {
      return scene_of_parts(path, log);
    }
    return scene_of(path, load_mesh(path, log));
  }
  throw Error(
      fmt::format("{}: is not a world: SDF ends in .sdf, .world or .xml, a Stonefish scenario in .scn, a mesh in {}, "
                  "heights in {}",
                  path.string(), mesh_file_endings(), height_grid_file_endings()));
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, const WorldOptions& options, const Log& log) {
  const SharedReader reader;
  const SceneFolders folders(path);
  Scene scene = load_any(path, options, log);
  check_budget(Budget::kInstances, static_cast<double>(scene.instances.size()), path.string());
  check_budget(Budget::kTriangles, static_cast<double>(scene.triangle_count()), path.string());
  return scene;
}

void assign_scenario_materials(Scene& world, const Scenario& scenario, const Log& log) {
  MaterialRules rules = scenario.materials;
  const std::filesystem::path folder = is_stream(scenario.file) ? std::filesystem::path() : scenario.file.parent_path();
  for (auto& [name, change] : rules.overrides) {
    try {
      if (std::shared_ptr<const Relief> relief = load_relief(change.relief_config, folder)) {
        change.relief = std::move(relief);
      }
    } catch (const Error& error) {
      throw Error("materials." + name, "", fmt::format(": {}", error.what())).located(scenario.places);
    }
  }
  try {
    assign_materials(world, rules, log);
  } catch (const Error& error) {
    throw error.located(scenario.places);
  }
}

Scene load_scene(const Scenario& scenario, const Log& log) {
  Scene scene;
  if (!scenario.world.empty()) {
    std::optional<SceneFolders> folders;
    if (!scenario.file.empty() && !is_stream(scenario.file)) {
      folders.emplace(scenario.file);
    }
    scene = load_scene(scenario.world, world_options(scenario), log);
    for (const std::string& line : odd_places(scenario, scene)) {
      log_line(log, Severity::kWarning, line);
    }
  }
  assign_scenario_materials(scene, scenario, log);
  return scene;
}

}  // namespace insonify
