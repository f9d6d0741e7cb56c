// yaml_read.h -- fills configurations from YAML by their tables of fields and parts.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "insonify/error.h"
#include "insonify/geometry.h"
#include "insonify/log.h"
#include "insonify/settings_table.h"
#include "io/scenario/yaml_value.h"

namespace insonify {

/// @throws Error unless the value is of that type. `expected` completes "must be ...".
void require_map(const YamlValue& value, std::string_view object, std::string_view expected);
void require_list(const YamlValue& value, std::string_view object, std::string_view expected);

/// @throws Error for the first unknown key, with the nearest known one.
/// @param elsewhere  Keys of other parts, as paths such as "water.depth": suggested for an unknown key "depth".
void check_keys(const YamlValue& map, std::string_view object, std::span<const std::string> known,
                std::span<const std::string> elsewhere = {});

/// The end of the message for an unknown key: "; did you mean water.depth?", or "".
[[nodiscard]] std::string key_suggestion(std::string_view key, std::span<const std::string> known,
                                         std::span<const std::string> elsewhere);

/// Calls a function and adds a place to its Error.
template <typename Function>
void with_place(const Place& place, Function&& function) {
  try {
    function();
  } catch (const Error& error) {
    throw error.at(place);
  }
}

/// Whether a field is an orientation as roll, pitch and yaw, which files may also write as a quaternion.
[[nodiscard]] inline bool is_orientation(const Field& field) {
  return field.name == "orientation" && field.unit == "rad";
}
/// The key of such a quaternion: "orientation_wxyz".
[[nodiscard]] inline std::string quaternion_name_of(const Field& field) {
  return std::string(field.name) + "_wxyz";
}

/// Names of a configuration's fields as files spell them.
/// @param with_parts  Whether those of its parts follow.
[[nodiscard]] std::vector<std::string> keys_of(const SettingsTable& table, bool with_parts = true);

/// Keys of a scenario file.
[[nodiscard]] std::vector<std::string> scenario_keys();

/// Keys of one entry of `sonars`.
[[nodiscard]] std::vector<std::string> sonar_keys();

/// Keys of the single parts of both, as paths: "water.depth", "receiver.noise", "sampling.rows". Keys within lists have
/// no fixed path.
/// @param sonar  Prefix of paths in a sonar's parts: "sonars[0]"; "" if they all refer to a sonar.
[[nodiscard]] std::vector<std::string> part_keys(const std::string& sonar = "");

// One value into one member; `object` is what the field belongs to. Each throws Error with the value's place.
void read_member(const YamlValue& value, std::string_view object, const Field& field, double& member);
void read_member(const YamlValue& value, std::string_view object, const Field& field, int& member);
void read_member(const YamlValue& value, std::string_view object, const Field& field, std::uint64_t& member);
void read_member(const YamlValue& value, std::string_view object, const Field& field, bool& member);
void read_member(const YamlValue& value, std::string_view object, const Field& field, std::string& member);
void read_member(const YamlValue& value, std::string_view object, const Field& field, std::filesystem::path& member);
void read_member(const YamlValue& value, std::string_view object, const Field& field, Vec3& member);
void read_member(const YamlValue& value, std::string_view object, const Field& field, std::vector<double>& member);
void read_member(const YamlValue& value, std::string_view object, const Field& field, std::vector<int>& member);
void read_member(const YamlValue& value, std::string_view object, const Field& field, std::vector<std::string>& member);

void read_member(const YamlValue& value, std::string_view object, const Field& field, EnumWord& member);

/// `none` and null reset the member.
template <typename T>
void read_member(const YamlValue& value, std::string_view object, const Field& field, std::optional<T>& member) {
  if (value.scalar == "none" || value.kind == YamlValue::Kind::kNothing) {
    member.reset();
    return;
  }
  T found{};
  read_member(value, object, field, found);
  member = found;
}

/// Reads a quaternion [w, x, y, z], of a norm within 1 % of 1, as roll, pitch and yaw.
/// @param twice  Whether the map gives the angles as well, which is an error.
void read_quaternion(const YamlValue& value, std::string_view object, const Field& field, bool twice, Vec3& rpy);

/// Fills those fields of a configuration that a map gives; keys it does not know are left to check_keys().
void read_fields(const YamlValue& map, std::string_view object, Settings settings, Places& places);

/// Fills those parts of a configuration that a map gives, but for the part named `except`. Null resets an optional and
/// empties a list. A trajectory may be a file, a material just the name of another.
/// @param places  With the place of "", the scenario's file, whose folder is the base of file names.
/// @param log     Receives warnings about files of waypoints.
void read_parts(const YamlValue& map, std::string_view object, Settings settings, Places& places, const Log& log = {},
                std::string_view except = {});

/// Fills a configuration's fields and parts from a map without other keys.
void read_section(const YamlValue& value, std::string_view object, Settings settings, Places& places,
                  const Log& log = {});

/// The name of a material.
/// @throws Error if it is empty.
[[nodiscard]] std::string material_name(const YamlValue& value, std::string_view object);

/// Turns a scenario's `arguments: {px: 8}` into the list ["px=8"].
/// @throws Error for values that are not texts or numbers, and entries of a list that are not "name=value".
void list_arguments(YamlValue& scenario);

/// The list of arguments that a scenario will have once the settings are applied.
[[nodiscard]] std::vector<std::string> arguments_with(const YamlValue& scenario, std::span<const std::string> settings);

/// Applies one setting: "pings=3", "water.depth=4", "sonars[0].max_range=30", "sonars.fls.max_range=30", or a sonar's
/// field alone, which means every sonar's. Messages on its value begin with `--set key=value: `.
/// @throws Error "--set key=value: ..." for a key that names nothing; for an unknown one with the nearest known
/// key.
void apply_setting(YamlValue& scenario, const std::string& setting);

}  // namespace insonify
