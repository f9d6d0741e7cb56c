// yaml_read.h -- fills configurations from YAML by their field lists.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "insonify/error.h"
#include "insonify/field.h"
#include "insonify/geometry.h"
#include "insonify/words.h"
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

/// Names of a configuration's fields as files spell them, without its parts.
template <typename Config>
[[nodiscard]] std::vector<std::string> field_keys_of() {
  std::vector<std::string> keys;
  const Config config{};
  Config::visit_fields(config, [&](const Field& field, const auto&) {
    keys.push_back(file_name_of(field));
    if (is_orientation(field)) {
      keys.push_back(quaternion_name_of(field));
    }
  });
  return keys;
}

/// Names of a configuration's fields and parts as files spell them.
template <typename Config>
[[nodiscard]] std::vector<std::string> keys_of() {
  std::vector<std::string> keys = field_keys_of<Config>();
  if constexpr (HasParts<Config>) {
    const Config config{};
    Config::visit_parts(config, [&](const Part& part, const auto&) { keys.emplace_back(part.name); });
  }
  return keys;
}

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

/// Index in `words` of the word that the value is.
[[nodiscard]] std::size_t read_word(const YamlValue& value, std::string_view object, const Field& field,
                                    std::span<const std::string> words);

template <typename Enum>
requires std::is_enum_v<Enum>
void read_member(const YamlValue& value, std::string_view object, const Field& field, Enum& member) {
  std::vector<std::string> words;
  for (const auto& [word, meaning] : words_of<Enum>()) {
    words.emplace_back(word);
  }
  member = words_of<Enum>()[read_word(value, object, field, words)].second;
}

/// Reads a quaternion [w, x, y, z], of a norm within 1 % of 1, as roll, pitch and yaw.
/// @param twice  Whether the map gives the angles as well, which is an error.
void read_quaternion(const YamlValue& value, std::string_view object, const Field& field, bool twice, Vec3& rpy);

/// Fills those fields of a configuration that a map gives; keys it does not know are left to check_keys().
template <typename Config>
void read_fields(const YamlValue& map, std::string_view object, Config& config, Places& places) {
  Config::visit_fields(config, [&](const Field& field, auto& member) {
    const std::string key = file_name_of(field);
    if (const YamlValue* value = map.find(key)) {
      places[member_name(object, key)] = value->place;
      read_member(*value, object, field, member);
    }
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member)>, Vec3>) {
      const YamlValue* quaternion = is_orientation(field) ? map.find(quaternion_name_of(field)) : nullptr;
      if (quaternion != nullptr) {
        read_quaternion(*quaternion, object, field, map.find(key) != nullptr, member);
      }
    }
  });
}

/// Fills a configuration's fields and parts from a map without other keys. Configurations that files may
/// write otherwise have an overload of their own.
template <typename Config>
void read_section(const YamlValue& value, std::string_view object, Config& config, Places& places);

// Reads one part: a struct, an optional struct, a list or a map of structs. Null resets an optional and empties a list.
template <typename Config>
void read_part(const YamlValue& value, const std::string& name, const Part& /*part*/, Config& config, Places& places) {
  read_section(value, name, config, places);
}
template <typename Config>
void read_part(const YamlValue& value, const std::string& name, const Part& /*part*/, std::optional<Config>& config,
               Places& places) {
  if (value.kind == YamlValue::Kind::kNothing) {
    config.reset();
    return;
  }
  config = config.value_or(Config{});
  read_section(value, name, *config, places);
}
template <typename Config>
void read_part(const YamlValue& value, const std::string& name, const Part& part, std::vector<Config>& configs,
               Places& places) {
  configs.clear();
  if (value.kind == YamlValue::Kind::kNothing) {
    return;
  }
  require_list(value, name, "a " + std::string(part.kind));
  for (const YamlValue& item : value.items) {
    const std::string object = name + "[" + std::to_string(configs.size()) + "]";
    read_section(item, object, configs.emplace_back(), places);
  }
}
template <typename Config>
void read_part(const YamlValue& value, const std::string& name, const Part& part,
               std::map<std::string, Config>& configs, Places& places) {
  require_map(value, name, "a " + std::string(part.kind));
  for (const auto& [key, entry] : value.entries) {
    if (key.empty()) {
      throw Error("", name, " has an entry without a name").at(entry.place);
    }
    read_section(entry, member_name(name, key), configs[key], places);
  }
}

/// Fills those parts of a configuration that a map gives.
/// @param takes  Whether a part is to be read, by its name.
template <typename Config, typename Takes>
void read_parts(const YamlValue& map, std::string_view object, Config& config, Places& places, Takes&& takes) {
  Config::visit_parts(config, [&](const Part& part, auto& member) {
    const YamlValue* value = map.find(part.name);
    if (value != nullptr && takes(part.name)) {
      const std::string name = member_name(object, part.name);
      places[name] = value->place;
      read_part(*value, name, part, member, places);
    }
  });
}

template <typename Config>
void read_section(const YamlValue& value, std::string_view object, Config& config, Places& places) {
  const std::vector<std::string> keys = keys_of<Config>();
  require_map(value, object, "a map of keys such as " + keys.front());
  places[std::string(object)] = value.place;
  check_keys(value, object, keys);
  read_fields(value, object, config, places);
  if constexpr (HasParts<Config>) {
    read_parts(value, object, config, places, [](std::string_view) { return true; });
  }
}

}  // namespace insonify
