// load_scenario.cpp -- a scenario from its YAML file and the settings of the command line.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "insonify/files.h"
#include "insonify/scenario_requests.h"
#include "io/file/input_file.h"
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
  ScenarioReader(const YamlValue& tree, const std::filesystem::path& path) : tree_(tree), path_(path) {}

  Scenario read() {
    require_map(tree_, path_.filename().string(), "a map of keys such as world and sonars");
    refuse_misplaced_keys();
    check_keys(tree_, "", scenario_keys(), part_keys("sonars[0].sampling"));
    scenario_.file = path_;
    read_fields(tree_, "", scenario_, places_);
    read_fields(tree_, "", scenario_.materials, places_);
    if_given("default_material", [&](const YamlValue& value) { (void)material_name(value, "default_material"); });
    scenario_.materials.default_where = place_of("default_material ");
    read_world();
    if_given("water", [&](const YamlValue& part) { read_section(part, "water", scenario_.water, places_); });
    if_given("paper", [&](const YamlValue& part) { read_section(part, "paper", scenario_.paper, places_); });
    if_given("receiver", [&](const YamlValue& part) { read_section(part, "receiver", scenario_.receiver, places_); });
    if_given("materials", [&](const YamlValue& part) { read_materials(part); });
    unless_null("surface",
                [&](const YamlValue& part) { read_section(part, "surface", scenario_.surface.emplace(), places_); });
    unless_null("trajectory",
                [&](const YamlValue& part) { read_trajectory(part, "trajectory", scenario_.trajectory); });
    // After what says how deep they are: a preset's ping period follows from the speed of sound there.
    if_given("sonars", [&](const YamlValue& part) { read_sonars(part); });
    unless_null("points", [&](const YamlValue& part) { read_points(part); });
    unless_null("interferers", [&](const YamlValue& part) { read_interferers(part); });
    unless_null("motions", [&](const YamlValue& part) { read_motions(part); });
    unless_null("view", [&](const YamlValue& part) { read_section(part, "view", scenario_.view.emplace(), places_); });
    validate();
    return std::move(scenario_);
  }

 private:
  template <typename Read>
  void if_given(const std::string& key, Read&& read) {
    if (const YamlValue* part = tree_.find(key)) {
      places_[key] = part->where;
      read(*part);
    }
  }

  // What `--set KEY=null` takes away.
  template <typename Read>
  void unless_null(const std::string& key, Read&& read) {
    if_given(key, [&](const YamlValue& part) {
      if (part.kind != Kind::kNothing) {
        read(part);
      }
    });
  }

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

  void read_world() {
    const YamlValue* given = tree_.find("world");
    if (given == nullptr) {
      if (!open_water()) {
        throw Error(tree_.where + "world is missing: the SDF file or mesh to insonify");
      }
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

  static std::string material_name(const YamlValue& value, const std::string& object) {
    if (value.scalar.empty()) {
      throw Error(fmt::format("{}{} must name a material", value.where, object));
    }
    return value.scalar;
  }

  void read_materials(const YamlValue& part) {
    require_map(part, "materials", "a map of material or visual names");
    for (const auto& [name, value] : part.entries) {
      const std::string object = member_name("materials", name);
      if (name.empty()) {
        throw Error(value.where + "materials has an entry without a name");
      }
      MaterialOverride& changes = scenario_.materials.overrides[name];
      if (value.kind == Kind::kScalar) {
        places_[object] = value.where;
        changes.like = material_name(value, object);
      } else {
        read_section(value, object, changes, places_);
        if (const YamlValue* like = value.find("like")) {
          changes.like = material_name(*like, object + ".like");
          changes.like_where = like->where;
        }
      }
      changes.where = value.where;
    }
  }

  void read_sonars(const YamlValue& part) {
    require_list(part, "sonars", "a list of sonars");
    for (std::size_t i = 0; i < part.items.size(); ++i) {
      scenario_.sonars.push_back(read_sonar(part.items[i], fmt::format("sonars[{}]", i), scenario_, places_));
    }
  }

  void read_trajectory(const YamlValue& part, const std::string& object, Trajectory& trajectory) {
    require_list(part, object, "a list of waypoints");
    for (std::size_t i = 0; i < part.items.size(); ++i) {
      read_section(part.items[i], fmt::format("{}[{}]", object, i), trajectory.waypoints.emplace_back(), places_);
    }
  }

  void read_interferers(const YamlValue& part) {
    require_list(part, "interferers", "a list of other sonars");
    for (std::size_t i = 0; i < part.items.size(); ++i) {
      read_section(part.items[i], fmt::format("interferers[{}]", i), scenario_.interferers.emplace_back(), places_);
    }
  }

  void read_points(const YamlValue& part) {
    require_list(part, "points", "a list of point targets");
    for (std::size_t i = 0; i < part.items.size(); ++i) {
      read_section(part.items[i], fmt::format("points[{}]", i), scenario_.points.emplace_back(), places_);
    }
  }

  void read_motions(const YamlValue& part) {
    require_list(part, "motions", "a list of motions");
    for (std::size_t i = 0; i < part.items.size(); ++i) {
      const std::string object = fmt::format("motions[{}]", i);
      const YamlValue& value = part.items[i];
      require_map(value, object, "a map of the keys object and trajectory");
      check_keys(value, object, std::vector<std::string>{"object", "trajectory"});
      places_[object] = value.where;
      Motion motion;
      motion.where = value.where;
      read_fields(value, object, motion, places_);
      if (const YamlValue* trajectory = value.find("trajectory")) {
        places_[object + ".trajectory"] = trajectory->where;
        read_trajectory(*trajectory, object + ".trajectory", motion.trajectory);
      }
      scenario_.motions.push_back(std::move(motion));
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
  Scenario scenario_;
  Places places_;
};

}  // namespace

Scenario load_scenario(const std::filesystem::path& path, std::span<const std::string> settings) {
  refuse_worlds(path);
  const std::string text = read_text(path);
  YamlValue tree = parse_yaml(text, path.string());
  if (tree.kind == Kind::kNothing) {
    throw Error(tree.where + "the file is empty; a scenario names a world and its sonars");
  }
  for (const std::string& setting : settings) {
    apply_setting(tree, setting, scenario_keys(), sonar_keys(), part_keys());
  }
  Scenario scenario = ScenarioReader(tree, path).read();
  scenario.text = settings.empty() ? text : write_yaml(tree);
  return scenario;
}

}  // namespace insonify
