// read_settings.cpp -- fills whole configurations from YAML by their tables of fields and parts.

#include <fmt/format.h>

#include "base/utf8.h"
#include "insonify/files.h"
#include "insonify/sound_speed_files.h"
#include "io/file/input_file.h"
#include "io/scenario/file_choices.h"
#include "io/scenario/yaml_read.h"

namespace insonify {
namespace {

using Kind = YamlValue::Kind;

// Which columns of a file of waypoints are which numbers: `{z: {name: depth, sign: -1}, x: north}`.
TrajectoryColumns read_columns(const YamlValue& value, const std::string& name, Places& places) {
  require_map(value, name, "a map of numbers of a waypoint, such as {z: {name: depth, sign: -1}}");
  TrajectoryColumns columns;
  for (const auto& [key, entry] : value.entries) {
    ColumnChoice choice;
    if (entry.kind == Kind::kScalar) {
      choice.name = entry.scalar;
    } else {
      read_section(entry, member_name(name, key), choice, places);
    }
    if (choice.sign != 1 && choice.sign != -1) {
      throw Error(member_name(name, key), "sign", fmt::format(" = {} must be 1 or -1", choice.sign)).at(entry.place);
    }
    columns[key] = {choice.name, choice.unit, static_cast<double>(choice.sign)};
  }
  return columns;
}

// A path that begins in the scenario's folder.
std::filesystem::path beside_scenario(const std::filesystem::path& path, Places& places) {
  const std::filesystem::path scenario = places[""].file;
  return (is_stream(scenario) ? std::filesystem::path() : scenario.parent_path()) / path;
}

// The scalar or map that names a file of waypoints, instead of their list.
bool read_track(const YamlValue& value, const std::string& name, const PartEntry& part, void* config, Places& places,
                const Log& log) {
  const bool is_file = value.find("file") != nullptr || value.find("start") != nullptr;
  if (part.table != &table_of<Waypoint>() || (value.kind != Kind::kScalar && !is_file)) {
    return false;
  }
  TrackChoice choice;
  TrajectoryColumns columns;
  if (value.kind == Kind::kScalar) {
    read_member(value, "", Field{name, "", {}, ""}, choice.file);
  } else {
    YamlValue rest = value;
    std::erase_if(rest.entries, [](const YamlValue::Entry& entry) { return entry.key == "columns"; });
    read_section(rest, name, choice, places);
    if (const YamlValue* given = value.find("columns")) {
      columns = read_columns(*given, member_name(name, "columns"), places);
    }
    if (choice.file.empty()) {
      throw Error(name, "file", " is missing: a CSV or TUM file of waypoints").at(value.place);
    }
  }
  Trajectory track;
  with_place(value.place, [&] { track = load_trajectory(beside_scenario(choice.file, places), columns, log); });
  part.clear(config);
  for (Waypoint& waypoint : track.waypoints) {
    waypoint.time -= choice.start;
    *static_cast<Waypoint*>(part.add(config).config) = waypoint;
  }
  return true;
}

// The scalar or map that names a file of a sound-speed profile, instead of the list of its points.
bool read_cast(const YamlValue& value, const std::string& name, const PartEntry& part, void* config, Places& places,
               const Log& log) {
  const YamlValue* file = value.find("file");
  if (part.table != &table_of<ProfilePoint>() || (value.kind != Kind::kScalar && file == nullptr)) {
    return false;
  }
  CastChoice choice;
  if (file == nullptr) {
    read_member(value, "", Field{name, "", {}, ""}, choice.file);
  } else {
    read_section(value, name, choice, places);
  }
  std::vector<ProfilePoint> points;
  with_place(value.place, [&] { points = load_sound_speed_profile(beside_scenario(choice.file, places), log); });
  part.clear(config);
  for (const ProfilePoint& point : points) {
    *static_cast<ProfilePoint*>(part.add(config).config) = point;
  }
  return true;
}

// A material as a map, or as the name of another, `hull: steel` for `hull: {like: steel}`.
void read_material(const YamlValue& value, std::string_view object, Settings settings, Places& places) {
  const bool is_name = value.kind == Kind::kScalar;
  const YamlValue* like = is_name ? &value : value.find("like");
  if (!is_name) {
    read_section(value, object, settings, places);
  }
  places[std::string(object)] = value.place;
  if (like != nullptr) {
    static_cast<MaterialOverride*>(settings.config)->like =
        material_name(*like, is_name ? std::string(object) : member_name(object, "like"));
  }
}

void read_map(const YamlValue& value, const std::string& name, const PartEntry& part, void* config, Places& places,
              const Log& log) {
  require_map(value, name, "a " + std::string(part.kind));
  const bool is_material = part.table == &table_of<MaterialOverride>();
  for (const auto& [key, entry] : value.entries) {
    if (key.empty()) {
      throw Error("", name, " has an entry without a name").at(entry.place);
    }
    const std::string valid = as_utf8(key);
    if (is_material) {
      read_material(entry, member_name(name, valid), part.add(config, valid), places);
    } else {
      read_section(entry, member_name(name, valid), part.add(config, valid), places, log);
    }
  }
}

void read_part(const YamlValue& value, const std::string& name, const PartEntry& part, void* config, Places& places,
               const Log& log) {
  if (part.shape == PartShape::kMap) {
    read_map(value, name, part, config, places, log);
  } else if (read_track(value, name, part, config, places, log) || read_cast(value, name, part, config, places, log)) {
    return;
  } else if (value.kind == Kind::kNothing && part.shape != PartShape::kStruct) {
    part.clear(config);
  } else if (part.shape == PartShape::kList) {
    part.clear(config);
    require_list(value, name, "a " + std::string(part.kind));
    for (std::size_t i = 0; i < value.items.size(); ++i) {
      read_section(value.items[i], fmt::format("{}[{}]", name, i), part.add(config), places, log);
    }
  } else {
    read_section(value, name, part.add(config), places, log);
  }
}

}  // namespace

std::vector<std::string> keys_of(const SettingsTable& table, bool with_parts) {
  std::vector<std::string> keys;
  for (const FieldEntry& field : table.fields) {
    keys.push_back(file_name_of(field));
    if (is_orientation(field)) {
      keys.push_back(quaternion_name_of(field));
    }
  }
  for (const PartEntry& part : table.parts) {
    if (with_parts) {
      keys.emplace_back(part.name);
    }
  }
  return keys;
}

std::vector<std::string> scenario_keys() {
  return keys_of(table_of<Scenario>());
}

std::vector<std::string> sonar_keys() {
  std::vector<std::string> keys = keys_of(table_of<PresetChoice>());
  const std::vector<std::string> own = keys_of(table_of<SonarConfig>());
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

std::vector<std::string> part_keys(const std::string& sonar) {
  std::vector<std::string> paths;
  const auto add_paths = [&](const std::string& object, const SettingsTable& table) {
    for (const PartEntry& part : table.parts) {
      if (part.shape == PartShape::kStruct || part.shape == PartShape::kOptional) {
        for (const std::string& key : keys_of(*part.table)) {
          paths.push_back(member_name(member_name(object, part.name), key));
        }
      }
    }
  };
  add_paths("", table_of<Scenario>());
  add_paths(sonar, table_of<SonarConfig>());
  return paths;
}

void read_fields(const YamlValue& map, std::string_view object, Settings settings, Places& places) {
  for (const FieldEntry& field : settings.table->fields) {
    const std::string key = file_name_of(field);
    const YamlValue* value = map.find(key);
    if (value != nullptr) {
      places[member_name(object, key)] = value->place;
      field.change(settings.config, [&](auto& member) { read_member(*value, object, field, member); });
    }
    if (const YamlValue* quaternion = is_orientation(field) ? map.find(quaternion_name_of(field)) : nullptr) {
      places[member_name(object, quaternion_name_of(field))] = quaternion->place;
      field.change(settings.config, [&]<typename Member>(Member& member) {
        if constexpr (std::is_same_v<Member, Vec3>) {
          read_quaternion(*quaternion, object, field, value != nullptr, member);
        }
      });
    }
  }
}

void read_parts(const YamlValue& map, std::string_view object, Settings settings, Places& places, const Log& log,
                std::string_view except) {
  for (const PartEntry& part : settings.table->parts) {
    const YamlValue* value = map.find(part.name);
    if (value != nullptr && part.name != except) {
      const std::string name = member_name(object, part.name);
      places[name] = value->place;
      read_part(*value, name, part, settings.config, places, log);
    }
  }
}

void read_section(const YamlValue& value, std::string_view object, Settings settings, Places& places, const Log& log) {
  const std::vector<std::string> keys = keys_of(*settings.table);
  require_map(value, object, "a map of keys such as " + keys.front());
  places[std::string(object)] = value.place;
  check_keys(value, object, keys);
  read_fields(value, object, settings, places);
  read_parts(value, object, settings, places, log);
}

std::string material_name(const YamlValue& value, std::string_view object) {
  if (value.scalar.empty()) {
    throw Error("", object, " must name a material").at(value.place);
  }
  return value.scalar;
}

}  // namespace insonify
