// world_sonars.cpp -- writes the sonars of a world into the tree of a scenario.

#include "io/scenario/world_sonars.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "base/log_line.h"
#include "insonify/files.h"
#include "insonify/geometry.h"
#include "insonify/printable.h"
#include "insonify/world_parts.h"
#include "io/file/input_file.h"
#include "io/file/scene_folders.h"
#include "io/scenario/yaml_read.h"
#include "io/stonefish/stonefish_sonars.h"
#include "io/world/sdf_reader.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;
using Kind = YamlValue::Kind;

YamlValue scalar_at(const Place& place, std::string text, bool quoted = false) {
  return {.kind = Kind::kScalar, .place = place, .scalar = std::move(text), .quoted = quoted};
}

YamlValue list_of(const Vec3& vector, const Place& place) {
  YamlValue list{.kind = Kind::kList, .place = place};
  for (const double number : vector) {
    list.items.push_back(scalar_at(place, fmt::format("{}", number)));
  }
  return list;
}

// Adds the keys `position` and `orientation_deg`.
void add_pose(YamlValue& map, const Pose& pose, const Place& place) {
  Vec3 angles = rpy_from_orientation(pose.orientation);
  for (double& angle : angles) {
    angle = degrees_from_radians(angle);
  }
  map.entries.push_back({"position", list_of(pose.position, place)});
  map.entries.push_back({"orientation_deg", list_of(angles, place)});
}

// A scenario's world after the settings, as the user wrote it; "" if there is none.
std::string world_of_scenario(const YamlValue& scenario, std::span<const std::string> settings) {
  const YamlValue* given = scenario.find("world");
  std::string world = given != nullptr && given->kind == Kind::kScalar ? given->scalar : "";
  for (std::string_view setting : settings) {
    setting.remove_prefix(setting.starts_with("--") ? 2 : 0);
    if (setting.starts_with("world=")) {
      world = parse_yaml_setting(std::string(setting.substr(6)), {}).scalar;
    }
  }
  return world;
}

// Sets the place of a value and everything in it.
void set_place(YamlValue& value, const Place& place) {
  value.place = place;
  for (YamlValue& item : value.items) {
    set_place(item, place);
  }
  for (YamlValue::Entry& entry : value.entries) {
    set_place(entry.value, place);
  }
}

// Whether a scenario has a key with a value.
bool is_given(const YamlValue& scenario, const char* key) {
  const YamlValue* value = scenario.find(key);
  return value != nullptr && value->kind != Kind::kNothing;
}

// Sets a key of a map, which moves to its end.
void put(YamlValue& map, const std::string& key, YamlValue value) {
  std::erase_if(map.entries, [&](const YamlValue::Entry& entry) { return entry.key == key; });
  map.entries.push_back({key, std::move(value)});
}

YamlValue entry_of(const SdfSonar& sonar, const Pose& world_from_vehicle) {
  YamlValue entry{.kind = Kind::kMap, .place = sonar.place};
  if (!sonar.name.empty()) {
    entry.entries.push_back({"name", scalar_at(sonar.place, sonar.name, true)});
  }
  for (const auto& [key, text] : sonar.settings) {
    YamlValue value = parse_yaml_setting(text, sonar.place);
    set_place(value, sonar.place);
    if (entry.find(key) != nullptr) {
      throw Error(fmt::format("sonar {}: <{}> appears twice", printable(sonar.name), printable(key))).at(sonar.place);
    }
    entry.entries.push_back({key, std::move(value)});
  }
  add_pose(entry, world_from_vehicle.inverse() * sonar.world_from_carrier * sonar.carrier_from_sonar, sonar.place);
  return entry;
}

// The carrier of sonars must not block their view.
void ignore_carriers(YamlValue& scenario, const std::vector<SdfSonar>& sonars) {
  if (!is_given(scenario, "ignore")) {
    put(scenario, "ignore", {.kind = Kind::kList});
  }
  YamlValue& ignored = *scenario.find("ignore");
  if (ignored.kind != Kind::kList) {
    return;  // The reader refuses it.
  }
  std::set<std::string> names;
  for (const SdfSonar& sonar : sonars) {
    if (names.insert(sonar.carrier).second) {
      ignored.items.push_back(scalar_at(sonar.place, sonar.carrier, true));
    }
  }
}

void add_trajectory(YamlValue& scenario, const SdfSonar& first) {
  if (is_given(scenario, "trajectory")) {
    return;
  }
  YamlValue waypoint{.kind = Kind::kMap, .place = first.place};
  waypoint.entries.push_back({"time", scalar_at(first.place, "0")});
  add_pose(waypoint, first.world_from_carrier, first.place);
  put(scenario, "trajectory", {.kind = Kind::kList, .place = first.place, .items = {std::move(waypoint)}});
}

// One sonar as an entry of `sonars`, all of it at the place of its sensor.
YamlValue entry_of(const StonefishSonar& from) {
  Scenario only;
  only.model = EchoModel::kPaper;  // So that the gain is written.
  only.sonars = {from.sonar};
  const YamlValue tree = parse_yaml(to_yaml(only), from.place.file);
  YamlValue entry = tree.find("sonars")->items.front();
  set_place(entry, from.place);
  return entry;
}

}  // namespace

std::string world_as_scenario(const fs::path& path) {
  return write_yaml({.kind = Kind::kMap, .entries = {{"world", scalar(path.filename().string(), true)}}});
}

bool is_sdf_file(const fs::path& path) {
  constexpr std::array kEndings = {".sdf", ".world", ".xml"};
  return std::ranges::find(kEndings, ending_of(path)) != kEndings.end();
}

bool add_sdf_sonars(YamlValue& scenario, const fs::path& path, std::span<const std::string> settings, const Log& log) {
  const std::string world = world_of_scenario(scenario, settings);
  if (scenario.kind != Kind::kMap || !is_sdf_file(world) || is_given(scenario, "sonars")) {
    return false;
  }
  const fs::path file = (is_stream(path) ? fs::path() : path.parent_path()) / world;
  const SceneFolders folders(is_stream(path) ? file : path);
  const std::vector<SdfSonar> found = sdf_reader(file).load_sonars(file, {});
  if (found.empty() && is_sdf_file(path)) {
    throw Error(
        fmt::format("{}: is an SDF world, not a scenario; write a YAML file that says world: {} and lists sonars, or "
                    "put <insonify:sonar> into a link",
                    path.string(), path.filename().string()));
  }
  if (found.empty()) {
    return false;
  }
  YamlValue sonars{.kind = Kind::kList, .place = found.front().place};
  std::vector<std::string> names;
  for (const SdfSonar& sonar : found) {
    sonars.items.push_back(entry_of(sonar, found.front().world_from_carrier));
    names.push_back(fmt::format("{} on {}", printable(sonar.name), printable(sonar.carrier)));
  }
  put(scenario, "sonars", std::move(sonars));
  ignore_carriers(scenario, found);
  add_trajectory(scenario, found.front());
  log_line(
      log, Severity::kInfo,
      fmt::format("{}: sonars in it: {}; their carriers are not insonified", file.string(), fmt::join(names, ", ")));
  return true;
}

std::vector<SonarCarrier> load_sonar_carriers(const Scenario& scenario) {
  std::vector<SonarCarrier> carriers;
  if (!is_sdf_file(scenario.world)) {
    return carriers;
  }
  const SceneFolders folders(scenario.file.empty() ? scenario.world : scenario.file);
  const std::vector<SdfSonar> found = sdf_reader(scenario.world).load_sonars(scenario.world, {});
  for (const SdfSonar& sonar : found) {
    const std::string name = sonar.name.empty() ? SonarConfig().name : sonar.name;
    if (std::ranges::find(scenario.sonars, name, &SonarConfig::name) != scenario.sonars.end()) {
      carriers.push_back({name, sonar.carrier, sonar.world_from_carrier.inverse() * found.front().world_from_carrier});
    }
  }
  return carriers;
}

bool is_stonefish_file(const fs::path& path) {
  return ending_of(path) == ".scn";
}

bool add_stonefish_sonars(YamlValue& scenario, const fs::path& path, std::span<const std::string> settings,
                          const Log& log) {
  const std::string world = world_of_scenario(scenario, settings);
  if (scenario.kind != Kind::kMap || !is_stonefish_file(world) || is_given(scenario, "sonars")) {
    return false;
  }
  const fs::path file = (is_stream(path) ? fs::path() : path.parent_path()) / world;
  const SceneFolders folders(is_stream(path) ? file : path);
  const StonefishSonars found =
      load_stonefish_sonars(file, is_given(scenario, "trajectory"), arguments_with(scenario, settings));
  if (found.sonars.empty()) {
    throw Error(fmt::format("{}: has no sensor of a sonar; list sonars in a scenario that says world: {}{}",
                            file.string(), printable(world, kLongestName),
                            found.missing.empty() ? "" : "; missing parts may be the cause: " + found.missing));
  }
  YamlValue sonars{.kind = Kind::kList, .place = found.sonars.front().place};
  std::vector<std::string> names;
  for (const StonefishSonar& sonar : found.sonars) {
    sonars.items.push_back(entry_of(sonar));
    names.push_back(printable(sonar.sonar.name));
  }
  put(scenario, "sonars", std::move(sonars));
  log_line(log, Severity::kInfo,
           fmt::format("{}: sonars after its sensors: {}; insonify's own receiver makes their noise", file.string(),
                       fmt::join(names, ", ")));
  return true;
}

void remove_idle_stonefish_gains(YamlValue& scenario) {
  const YamlValue* model = scenario.find("model");
  YamlValue* sonars = scenario.find("sonars");
  if (sonars == nullptr || (model != nullptr && model->scalar == "paper")) {
    return;
  }
  for (YamlValue& sonar : sonars->items) {
    std::erase_if(sonar.entries, [](const YamlValue::Entry& entry) {
      return entry.key == "gain" && is_stonefish_file(entry.value.place.file);
    });
  }
}

}  // namespace insonify
