// sdf_world.cpp -- writes the sonars of an SDF file into the tree of a scenario.

#include "io/scenario/sdf_world.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "base/log_line.h"
#include "insonify/files.h"
#include "insonify/geometry.h"
#include "insonify/printable.h"
#include "insonify/world_parts.h"
#include "io/file/input_file.h"
#include "io/scenario/world_sonars.h"
#include "io/world/sdf_reader.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;
using Kind = YamlValue::Kind;

YamlValue scalar(std::string text, const Place& place, bool quoted = false) {
  YamlValue value;
  value.kind = Kind::kScalar;
  value.place = place;
  value.scalar = std::move(text);
  value.quoted = quoted;
  return value;
}

YamlValue list_of(const Vec3& vector, const Place& place) {
  YamlValue list;
  list.kind = Kind::kList;
  list.place = place;
  for (const double number : {vector.x(), vector.y(), vector.z()}) {
    list.items.push_back(scalar(fmt::format("{}", number), place));
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

YamlValue entry_of(const SdfSonar& sonar, const Pose& world_from_vehicle) {
  YamlValue entry;
  entry.kind = Kind::kMap;
  entry.place = sonar.place;
  if (!sonar.name.empty()) {
    entry.entries.push_back({"name", scalar(sonar.name, sonar.place, true)});
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
    std::erase_if(scenario.entries, [](const YamlValue::Entry& entry) { return entry.key == "ignore"; });
    YamlValue list;
    list.kind = Kind::kList;
    scenario.entries.push_back({"ignore", std::move(list)});
  }
  YamlValue& ignored = *scenario.find("ignore");
  if (ignored.kind != Kind::kList) {
    return;  // The reader refuses it.
  }
  std::set<std::string> names;
  for (const SdfSonar& sonar : sonars) {
    if (names.insert(sonar.carrier).second) {
      ignored.items.push_back(scalar(sonar.carrier, sonar.place, true));
    }
  }
}

void add_trajectory(YamlValue& scenario, const SdfSonar& first) {
  if (is_given(scenario, "trajectory")) {
    return;
  }
  YamlValue waypoint;
  waypoint.kind = Kind::kMap;
  waypoint.place = first.place;
  waypoint.entries.push_back({"time", scalar("0", first.place)});
  add_pose(waypoint, first.world_from_carrier, first.place);
  YamlValue trajectory;
  trajectory.kind = Kind::kList;
  trajectory.place = first.place;
  trajectory.items.push_back(std::move(waypoint));
  std::erase_if(scenario.entries, [](const YamlValue::Entry& entry) { return entry.key == "trajectory"; });
  scenario.entries.push_back({"trajectory", std::move(trajectory)});
}

}  // namespace

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
  const std::vector<SdfSonar> found = sdf_reader(file).load_sonars(file, {});
  if (found.empty() && is_sdf_file(path)) {
    throw Error(
        fmt::format("{}: is an SDF world, not a scenario; write a YAML file that says world: {} and lists "
                    "sonars, or put <insonify:sonar> into a link",
                    path.string(), path.filename().string()));
  }
  if (found.empty()) {
    return false;
  }
  YamlValue sonars;
  sonars.kind = Kind::kList;
  sonars.place = found.front().place;
  std::vector<std::string> names;
  for (const SdfSonar& sonar : found) {
    sonars.items.push_back(entry_of(sonar, found.front().world_from_carrier));
    names.push_back(fmt::format("{} on {}", printable(sonar.name), printable(sonar.carrier)));
  }
  std::erase_if(scenario.entries, [](const YamlValue::Entry& entry) { return entry.key == "sonars"; });
  scenario.entries.push_back({"sonars", std::move(sonars)});
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
  const std::vector<SdfSonar> found = sdf_reader(scenario.world).load_sonars(scenario.world, {});
  for (const SdfSonar& sonar : found) {
    const std::string name = sonar.name.empty() ? SonarConfig().name : sonar.name;
    if (std::ranges::find(scenario.sonars, name, &SonarConfig::name) != scenario.sonars.end()) {
      carriers.push_back({name, sonar.carrier, sonar.world_from_carrier.inverse() * found.front().world_from_carrier});
    }
  }
  return carriers;
}

}  // namespace insonify
