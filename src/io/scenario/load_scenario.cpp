// load_scenario.cpp -- a scenario from its YAML file and the settings of the command line.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "insonify/files.h"
#include "insonify/scenario_requests.h"
#include "io/file/input_file.h"
#include "io/scenario/read_material.h"
#include "io/scenario/read_sonar.h"
#include "io/scenario/scenario_keys.h"
#include "io/scenario/yaml_read.h"
#include "io/scenario/yaml_settings.h"

namespace insonify {
namespace {

using Kind = YamlValue::Kind;

// What someone probably wants who gives us a world where a scenario is due.
void refuse_worlds(const std::filesystem::path& path) {
  constexpr std::array meshes = {".obj", ".stl", ".dae", ".ply", ".gltf", ".glb"};
  constexpr std::array worlds = {".sdf", ".world", ".xml"};
  constexpr std::array grids = {".asc", ".bag", ".png"};
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto is_one_of = [&](const auto& endings) { return std::ranges::find(endings, ending) != endings.end(); };
  const char* kind = is_one_of(meshes)   ? "a mesh"
                     : is_one_of(worlds) ? "an SDF world"
                     : is_one_of(grids)  ? "a height grid"
                                         : nullptr;
  if (kind != nullptr) {
    throw Error(fmt::format("{}: is {}, not a scenario; write a YAML file that says world: {} and lists sonars",
                            path.string(), kind, path.filename().string()));
  }
}

// Reads the tree into a scenario and keeps where everything stood.
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
    read_fields(tree_, "", scenario_, places_);
    read_world();
    read_default_material();
    // Sonars last: a preset's ping period follows from the speed of sound at their depth.
    read_parts(tree_, "", scenario_, places_, [](std::string_view part) { return part != "sonars"; });
    read_sonars();
    for (std::size_t i = 0; i < scenario_.motions.size(); ++i) {
      scenario_.motions[i].where = places_[fmt::format("motions[{}]", i)];
    }
    validate();
    return std::move(scenario_);
  }

 private:
  // Points or a surface: else a sonar would have nothing to hear.
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
        throw Error(
            fmt::format("{}{} is a key of a sonar, not of the scenario; write it under sonars", value.where, key));
      }
    }
  }

  // In a file even `pings: 1` says something.
  void refuse_second_length() const {
    const YamlValue* pings = tree_.find("pings");
    for (const char* key : {"duration", "turns"}) {
      const YamlValue* given = tree_.find(key);
      if (pings != nullptr && given != nullptr && given->kind != Kind::kNothing) {
        throw Error(fmt::format("{}{} says when pings end, as pings = {} does; leave one out", given->where, key,
                                pings->shown()));
      }
    }
  }

  void read_world() {
    const YamlValue* given = tree_.find("world");
    if (given == nullptr) {
      if (!open_water()) {
        throw Error(tree_.where + "world is missing: the SDF file or mesh to insonify");
      }
      return;
    }
    if (scenario_.world == "none" && !given->quoted) {
      scenario_.world.clear();
      return;
    }
    scenario_.world_where = given->where;
    const std::filesystem::path folder = is_stream(path_) ? std::filesystem::path() : path_.parent_path();
    scenario_.world = std::filesystem::absolute(folder / scenario_.world).lexically_normal();
    std::error_code ignored;
    if (!std::filesystem::exists(scenario_.world, ignored)) {
      throw Error(
          fmt::format("{}world = {} is not there: no file {}", given->where, given->shown(), scenario_.world.string()));
    }
  }

  void read_default_material() {
    if (const YamlValue* given = tree_.find("default_material")) {
      (void)material_name(*given, "default_material");
      scenario_.materials.default_where = given->where;
    }
  }

  void read_sonars() {
    const YamlValue* given = tree_.find("sonars");
    if (given == nullptr) {
      return;
    }
    require_list(*given, "sonars", "a list of sonars");
    places_["sonars"] = given->where;
    for (std::size_t i = 0; i < given->items.size(); ++i) {
      scenario_.sonars.push_back(read_sonar(given->items[i], fmt::format("sonars[{}]", i), scenario_, places_, log_));
    }
  }

  // Messages begin with the name of what is wrong. Its place goes before it; where it has none, being a default, the
  // place of another key of the same object that the message names; else that of the object.
  std::string place_of(std::string_view message) const {
    std::string_view name = message.substr(0, message.find(' '));
    if (const auto place = places_.find(std::string(name)); place != places_.end()) {
      return place->second;
    }
    const std::string_view object = name.substr(0, std::min(name.rfind('.'), name.size()));
    std::istringstream words{std::string(message)};
    for (std::string word; words >> word;) {
      if (const auto place = places_.find(member_name(object, word)); place != places_.end()) {
        return place->second;
      }
    }
    while (!name.empty()) {
      if (const auto place = places_.find(std::string(name)); place != places_.end()) {
        return place->second;
      }
      const std::size_t end = name.find_last_of(".[");
      name = name.substr(0, end == std::string_view::npos ? 0 : end);
    }
    return tree_.where;
  }

  void validate() const {
    try {
      scenario_.validate();
      (void)ScenarioRequests(scenario_);
    } catch (const Error& error) {
      throw Error(place_of(error.what()) + error.what());
    }
  }

  const YamlValue& tree_;
  const std::filesystem::path& path_;
  const Log& log_;
  Scenario scenario_;
  Places places_;
};

}  // namespace

Scenario load_scenario(const std::filesystem::path& path, std::span<const std::string> settings, const Log& log) {
  refuse_worlds(path);
  const std::string text = read_text(path);
  YamlValue tree = parse_yaml(text, path.string());
  if (tree.kind == Kind::kNothing) {
    throw Error(tree.where + "the file is empty; a scenario names a world and its sonars");
  }
  for (const std::string& setting : settings) {
    apply_setting(tree, setting, scenario_keys(), sonar_keys(), part_keys());
  }
  Scenario scenario = ScenarioReader(tree, path, log).read();
  scenario.text = settings.empty() ? text : write_yaml(tree);
  return scenario;
}

}  // namespace insonify
