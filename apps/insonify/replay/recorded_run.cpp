// recorded_run.cpp -- opens the recordings of a run, finds the files of its scenario, and reads the pings.

#include "replay/recorded_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "insonify/files.h"
#include "insonify/recording_info.h"
#include "pictures/recorded_folders.h"

namespace insonify {
namespace {

// All values of a table with one number per ping.
std::vector<double> numbers_of(const StoredTables& tables, const std::string& name, const std::filesystem::path& file) {
  const StoredTable* const table = tables.find(name);
  if (table == nullptr || table->type != NumberType::kFloat64 || table->shape.size() != 1) {
    throw Error(fmt::format("{}: it has no {} of its pings", file.string(), name));
  }
  std::vector<double> numbers(table->shape[0]);
  const TableSlice all[] = {{.start = 0, .count = numbers.size()}};
  tables.read(*table, all, std::as_writable_bytes(std::span(numbers)));
  return numbers;
}

// One ping's part of a ground-truth table; unchanged if the recording does not have it.
template <typename Value>
void read_layer(const StoredTables& tables, const char* name, NumberType type, std::uint64_t number, const Ping& ping,
                std::vector<Value>& values) {
  const StoredTable* const table = tables.find(name);
  const auto bins = static_cast<std::uint64_t>(ping.bin_count), beams = static_cast<std::uint64_t>(ping.beam_count);
  if (table == nullptr || table->type != type || table->shape.size() != 3 || table->shape[1] != bins ||
      table->shape[2] != beams) {
    return;
  }
  values.resize(bins * beams);
  const TableSlice slices[] = {
      {.start = number, .count = 1}, {.start = 0, .count = bins}, {.start = 0, .count = beams}};
  tables.read(*table, slices, std::as_writable_bytes(std::span(values)));
}

void check_run(const RecordingInfo& first, const std::filesystem::path& first_file, const RecordingInfo& other,
               const std::filesystem::path& file) {
  const char* const what = first.scenario != other.scenario ? "scenarios"
                           : first.model != other.model     ? "models"
                           : first.seed != other.seed       ? "seeds"
                                                            : nullptr;
  if (what != nullptr) {
    throw Error(
        fmt::format("{} and {} are of different runs: their {} differ", first_file.string(), file.string(), what));
  }
}

// The scene, as far as it was found.
struct RecordedScene {
  Scene scene;                              // With the recording's names; without meshes if the world was not found.
  std::optional<Scenario> scenario = {};    // Absent if the world was not found.
  std::optional<Simulator> simulator = {};  // Present if something moves in that scenario.
};

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
  scenario = flown(std::move(scenario), world);
  found.simulator.emplace(scenario, std::move(world));
  found.scene = found.simulator->scene();
  if (scenario.motions.empty()) {
    found.simulator.reset();
  }
  found.scenario = std::move(scenario);
  return found;
}

// Reads the world of a scenario. The log gets one warning if the world was not found or has changed.
// @param scenario   Its text.
// @param instances  Names of the scene's instances in the recording; empty if it has none. Materials likewise.
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

// Poses of moving objects at a ping.
// @param sonar  Index into the sonars of `requests`, which are those of the simulator's scenario.
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

}  // namespace

RecordedRun::RecordedRun(const RecordedRunOptions& options, const Log& log) {
  auto world = std::make_shared<LiveWorld>();
  open(options, *world, log);
  std::ranges::stable_sort(moments_, {}, &RecordedMoment::time);
  find_scene(options, *world, log);
  world_ = std::move(world);
}

void RecordedRun::open(const RecordedRunOptions& options, LiveWorld& world, const Log& log) {
  std::optional<RecordingInfo> first;
  std::map<std::string, std::filesystem::path> seen;
  for (const std::filesystem::path& file : options.files) {
    const RecordingInfo info = recording_info(file);
    if (const std::string text = unfinished_text(file, info); !text.empty()) {
      log(Severity::kWarning, text);
    }
    if (first) {
      check_run(*first, options.files.front(), info, file);
    } else {
      first = info;
    }
    for (const RecordedSonar& sonar : info.sonars) {
      const std::string& name = sonar.config.name;
      if (!options.sonar.empty() && name != options.sonar) {
        continue;
      }
      if (const auto [other, is_new] = seen.emplace(name, file); !is_new) {
        throw Error(
            fmt::format("{} and {} are both of a sonar called {}", other->second.string(), file.string(), name));
      }
      if (sonar.pings == 0) {
        log(Severity::kWarning, fmt::format("{}: {} has no pings and is skipped", file.string(), name));
        continue;
      }
      tracks_.push_back({RecordedPings(file, name), StoredTables(file, name)});
      world.sonars.push_back(sonar.config);
      world.sonars.back().receiver = tracks_.back().pings.receiver_config();
    }
  }
  if (tracks_.empty()) {
    throw Error(options.sonar.empty() || !seen.empty()
                    ? fmt::format("{}: there is no ping in it", options.files.front().string())
                    : fmt::format("{}: there is no sonar {} in it", options.files.front().string(), options.sonar));
  }
  world.scenario.model = first->model == "paper" ? EchoModel::kPaper : EchoModel::kCalibrated;
  world.scenario.text = first->scenario;
  world.scenario.sonars = world.sonars;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const std::filesystem::path& file = seen.at(world.sonars[i].name);
    const std::vector<double> times = numbers_of(tracks_[i].tables, "time", file);
    for (std::uint64_t ping = 0; ping < std::min<std::uint64_t>(times.size(), tracks_[i].pings.ping_count()); ++ping) {
      if (!std::isfinite(times[ping])) {
        throw Error(fmt::format("{}: the time of ping {} is not a number", file.string(), ping));
      }
      moments_.push_back({times[ping], static_cast<int>(i), ping});
    }
  }
}

void RecordedRun::find_scene(const RecordedRunOptions& options, LiveWorld& world, const Log& log) {
  const StoredTables& tables = tracks_.front().tables;
  RecordedScene scene =
      recorded_scene(world.scenario.text, tables.texts("instance_names"), tables.texts("material_names"),
                     recorded_folders(options.files, options.folder), log);
  world.scene = std::move(scene.scene);
  if (!scene.scenario) {
    return;
  }
  std::vector<SonarConfig> sonars = std::move(world.scenario.sonars);
  for (const SonarConfig& sonar : sonars) {
    const auto& all = scene.scenario->sonars;
    const auto found = std::ranges::find(all, sonar.name, &SonarConfig::name);
    scenario_sonars_.push_back(found == all.end() ? -1 : static_cast<int>(found - all.begin()));
  }
  if (scene.simulator) {
    simulator_ = std::move(scene.simulator);
    requests_.emplace(*scene.scenario);
  }
  world.trajectory = scene.scenario->trajectory;
  world.scenario = std::move(*scene.scenario);
  world.scenario.sonars = std::move(sonars);
}

std::shared_ptr<const LivePing> RecordedRun::ping(const RecordedMoment& moment) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto sonar = static_cast<std::size_t>(moment.sonar);
  const Track& track = tracks_[sonar];
  auto live = std::make_shared<LivePing>();
  live->world = world_;
  live->sonar = moment.sonar;
  live->ping = track.pings.ping(moment.ping);
  Ping& ping = live->ping;
  read_layer(track.tables, "instance", NumberType::kUint16, moment.ping, ping, ping.instance);
  read_layer(track.tables, "material", NumberType::kUint16, moment.ping, ping, ping.material);
  read_layer(track.tables, "elevation", NumberType::kFloat32, moment.ping, ping, ping.elevation);
  read_layer(track.tables, "shadow", NumberType::kFloat32, moment.ping, ping, ping.shadow);
  read_layer(track.tables, "path_order", NumberType::kUint8, moment.ping, ping, ping.path_order);
  live->world_from_vehicle = ping.world_from_sonar * world_->sonars[sonar].vehicle_from_sonar().inverse();
  if (simulator_ && scenario_sonars_[sonar] >= 0) {
    live->moved = moved_instances(*simulator_, *requests_, scenario_sonars_[sonar], ping);
  }
  live->computing_time = std::chrono::duration<double>(Clock::now() - start).count();
  live->made_at = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  return live;
}

}  // namespace insonify
