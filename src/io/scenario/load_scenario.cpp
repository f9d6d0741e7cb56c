// load_scenario.cpp -- reads a scenario from its YAML file and the settings of the command line.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "base/log_line.h"
#include "base/utf8.h"
#include "insonify/files.h"
#include "insonify/scenario_requests.h"
#include "insonify/scene_files.h"
#include "io/file/input_file.h"
#include "io/file/xml_file.h"
#include "io/scenario/check_effects.h"
#include "io/scenario/read_sonar.h"
#include "io/scenario/world_sonars.h"
#include "io/scenario/yaml_read.h"

namespace insonify {
namespace {

using Kind = YamlValue::Kind;

// Explains how to make a scenario of a mesh or a grid, for users who pass it itself.
void refuse_worlds(const std::filesystem::path& path) {
  constexpr std::array meshes = {".obj", ".stl", ".dae", ".ply", ".gltf", ".glb"};
  constexpr std::array grids = {".asc", ".bag", ".png"};
  const std::string ending = ending_of(path);
  const auto is_one_of = [&](const auto& endings) { return std::ranges::find(endings, ending) != endings.end(); };
  const char* kind = is_one_of(meshes) ? "a mesh" : is_one_of(grids) ? "a height grid" : nullptr;
  if (kind != nullptr) {
    throw Error(fmt::format("{}: is {}, not a scenario; write a YAML file that says world: {} and lists sonars",
                            path.string(), kind, path.filename().string()));
  }
}

// Converts the YAML tree to a scenario and records the place of each setting.
class ScenarioReader {
 public:
  ScenarioReader(const YamlValue& tree, const std::filesystem::path& path, const Log& log)
      : tree_(tree), path_(path), log_(log) {}

  Scenario read() {
    require_map(tree_, path_.filename().string(), "a map of keys such as world and sonars");
    refuse_misplaced_keys();
    refuse_second_length();
    check_keys(tree_, "", scenario_keys(), part_keys("sonars[0]"));
    scenario_.file = path_;
    scenario_.places[""] = tree_.place;
    read_fields(tree_, "", scenario_, scenario_.places);
    read_world();
    read_default_material();
    // Sonars last: a preset's ping period follows from the speed of sound at their depth.
    read_parts(tree_, "", scenario_, scenario_.places, log_, "sonars");
    read_sonars();
    if (scenario_.sonars.empty()) {
      refuse_missing_world();
    }
    validate();
    refuse_missing_world();  // After checking values: a sonar may be tried out in a text without a world.
    return std::move(scenario_);
  }

 private:
  // Whether there are echoes without a world: points or a surface.
  [[nodiscard]] bool open_water() const {
    const YamlValue *points = tree_.find("points"), *surface = tree_.find("surface");
    return (points != nullptr && !points->items.empty()) || (surface != nullptr && surface->kind != Kind::kNothing);
  }

  void refuse_misplaced_keys() const {
    const std::vector<std::string> of_scenario = scenario_keys();
    const std::vector<std::string> of_sonar = sonar_keys();
    for (const auto& [key, value] : tree_.entries) {
      if (std::ranges::find(of_scenario, key) == of_scenario.end() &&
          std::ranges::find(of_sonar, key) != of_sonar.end()) {
        throw Error("", key, " is a key of a sonar, not of the scenario; write it under sonars").at(value.place);
      }
    }
  }

  // In a file even `pings: 1` is a choice.
  void refuse_second_length() const {
    const YamlValue* pings = tree_.find("pings");
    for (const char* key : {"duration", "turns"}) {
      const YamlValue* given = tree_.find(key);
      if (pings != nullptr && given != nullptr && given->kind != Kind::kNothing) {
        throw Error("", key, fmt::format(" says when pings end, as pings = {} does; leave one out", pings->shown()))
            .at(given->place);
      }
    }
  }

  void read_world() {
    const YamlValue* given = tree_.find("world");
    if (given == nullptr) {
      return;
    }
    if (scenario_.world == "none" && !given->quoted) {
      scenario_.world.clear();
      return;
    }
    const std::filesystem::path folder = is_stream(path_) ? std::filesystem::path() : path_.parent_path();
    scenario_.world = std::filesystem::absolute(folder / scenario_.world).lexically_normal();
    std::error_code ignored;
    if (!std::filesystem::exists(scenario_.world, ignored)) {
      throw Error("", "world",
                  fmt::format(" = {} does not exist: no file {}", given->shown(), scenario_.world.string()))
          .at(given->place);
    }
  }

  void refuse_missing_world() const {
    if (tree_.find("world") == nullptr && !open_water()) {
      throw Error("", "world", " is missing: the SDF file or mesh to insonify").at(tree_.place);
    }
  }

  void read_default_material() {
    if (const YamlValue* given = tree_.find("default_material")) {
      (void)material_name(*given, "default_material");
    }
  }

  void read_sonars() {
    const YamlValue* given = tree_.find("sonars");
    if (given == nullptr) {
      return;
    }
    require_list(*given, "sonars", "a list of sonars");
    scenario_.places["sonars"] = given->place;
    for (std::size_t i = 0; i < given->items.size(); ++i) {
      scenario_.sonars.push_back(
          read_sonar(given->items[i], fmt::format("sonars[{}]", i), scenario_, scenario_.places, log_));
    }
  }

  void validate() const {
    try {
      scenario_.validate();
      if (!scenario_.pattern) {
        (void)ScenarioRequests(scenario_);
      }
      refuse_idle_keys(scenario_);
    } catch (const Error& error) {
      throw error.located(scenario_.places);
    }
  }

  const YamlValue& tree_;
  const std::filesystem::path& path_;
  const Log& log_;
  Scenario scenario_;
};

// @param path  Its folder is the base of relative paths.
// @param name  Name of the text in messages.
Scenario read_scenario(const std::string& text, const std::filesystem::path& path, const std::string& name,
                       std::span<const std::string> settings, const Log& log) {
  YamlValue tree = parse_yaml(text, name);
  if (tree.kind == Kind::kNothing) {
    throw Error("the file is empty; a scenario names a world and its sonars").at(tree.place);
  }
  const bool has_stonefish_sonars = add_stonefish_sonars(tree, path, settings, log);
  const bool has_world_sonars = has_stonefish_sonars || add_sdf_sonars(tree, path, settings, log);
  for (const std::string& setting : settings) {
    apply_setting(tree, setting);
  }
  list_arguments(tree);
  if (has_stonefish_sonars) {
    remove_idle_stonefish_gains(tree);
  }
  Scenario scenario = ScenarioReader(tree, path, log).read();
  for (const std::string& line : odd_settings(scenario)) {
    log_line(log, Severity::kWarning, line);
  }
  const auto model = scenario.places.find("model");
  if (model != scenario.places.end() && model->second.line == 0) {
    if (const std::vector<std::string> idle = idle_keys(scenario); !idle.empty()) {
      log_line(
          log, Severity::kWarning,
          fmt::format("{} of the file {} no effect with model = {}: {}{}",
                      idle.size() == 1 ? "a key" : fmt::format("{} keys", idle.size()),
                      idle.size() == 1 ? "has" : "have", scenario.model == EchoModel::kPaper ? "paper" : "calibrated",
                      idle.front(), idle.size() == 1 ? "" : " ..."));
    }
    scenario.text = to_yaml(scenario);  // The file's keys of its own model would be refused beside the other model.
  } else {
    scenario.text = as_utf8(settings.empty() && !has_world_sonars ? text : write_yaml(tree));
  }
  return scenario;
}

}  // namespace

Scenario load_scenario(const std::filesystem::path& given, std::span<const std::string> settings, const Log& log) {
  const std::filesystem::path path = scenario_file(given);
  refuse_worlds(path);  // Before it is read: worlds may be large.
  return load_scenario_text(read_text_or_pipe(path), path, settings, log);
}

Scenario load_scenario_text(const std::string& text, const std::filesystem::path& path,
                            std::span<const std::string> settings, const Log& log) {
  refuse_worlds(path);
  // A program that has read a world with sonars passes its text, or the text of the scenario that was made of it.
  const bool is_xml = text.starts_with(kByteOrderMark) || without_outer_space(text).starts_with('<');
  const bool is_world = (is_stonefish_file(path) || is_sdf_file(path)) && is_xml;
  return read_scenario(is_world ? world_as_scenario(path) : text, path, path.string(), settings, log);
}

Scenario parse_scenario(const std::string& text, const std::filesystem::path& folder,
                        std::span<const std::string> settings, const Log& log) {
  const std::filesystem::path path = folder / "scenario";
  Scenario scenario = read_scenario(text, path, path.string(), settings, log);
  scenario.file.clear();
  return scenario;
}

}  // namespace insonify
