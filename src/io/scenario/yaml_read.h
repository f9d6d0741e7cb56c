// yaml_read.h -- fills configurations from YAML by the list of fields that each gives of itself.

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
#include "io/file/yaml_words.h"
#include "io/scenario/yaml_value.h"

namespace insonify {

/// Where each thing that was read stands ("path:line:column: "), by the name that messages use: "sonars[0].max_range".
using Places = std::map<std::string, std::string>;

/// "sonars[0]" and "max_range" give "sonars[0].max_range"; an object without a name gives the key alone.
[[nodiscard]] std::string member_name(std::string_view object, std::string_view key);

/// @throws Error unless the value is of that kind. `expected` completes "must be ...".
void require_map(const YamlValue& value, std::string_view object, std::string_view expected);
void require_list(const YamlValue& value, std::string_view object, std::string_view expected);

/// @throws Error for the first key that is not known; it names the nearest one that is.
/// @param elsewhere  Keys of other parts, as paths such as "water.depth": named to who wrote just the last word.
void check_keys(const YamlValue& map, std::string_view object, std::span<const std::string> known,
                std::span<const std::string> elsewhere = {});

/// The end of a message on an unknown key: "; did you mean water.depth?", or nothing.
[[nodiscard]] std::string key_suggestion(std::string_view key, std::span<const std::string> known,
                                         std::span<const std::string> elsewhere);

/// Calls a function and puts `where` before the message of an Error it throws.
template <typename Function>
void with_place(const std::string& where, Function&& function) {
  try {
    function();
  } catch (const Error& error) {
    throw Error(where + error.what());
  }
}

/// Names of a configuration's fields as files spell them, without its parts.
template <typename Config>
[[nodiscard]] std::vector<std::string> field_keys_of() {
  std::vector<std::string> keys;
  const Config config{};
  Config::visit_fields(config, [&](const Field& field, const auto&) { keys.push_back(file_name_of(field)); });
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

/// `none`, and null, are as if the key were not there.
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

/// The place in `words` of the word that the value is.
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

/// Fills those fields of a configuration that a map gives; keys it does not know are left to check_keys().
template <typename Config>
void read_fields(const YamlValue& map, std::string_view object, Config& config, Places& places) {
  Config::visit_fields(config, [&](const Field& field, auto& member) {
    const std::string key = file_name_of(field);
    if (const YamlValue* value = map.find(key)) {
      places[member_name(object, key)] = value->where;
      read_member(*value, object, field, member);
    }
  });
}

/// Fills a configuration from a map that holds nothing else: its fields and its parts. Configurations that files may
/// write otherwise have an overload of their own.
template <typename Config>
void read_section(const YamlValue& value, std::string_view object, Config& config, Places& places);

// One part, by what it is: a struct, an optional one, a list of them. Null takes away what is optional, and lists.
template <typename Config>
void read_part(const YamlValue& value, const std::string& name, const Part& /*part*/, Config& config, Places& places) {
  read_section(value, name, config, places);
}
template <typename Config>
void read_part(const YamlValue& value, const std::string& name, const Part& /*part*/, std::optional<Config>& config,
               Places& places) {
  config.reset();
  if (value.kind != YamlValue::Kind::kNothing) {
    read_section(value, name, config.emplace(), places);
  }
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
      throw Error(entry.where + name + " has an entry without a name");
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
      places[name] = value->where;
      read_part(*value, name, part, member, places);
    }
  });
}

template <typename Config>
void read_section(const YamlValue& value, std::string_view object, Config& config, Places& places) {
  const std::vector<std::string> keys = keys_of<Config>();
  require_map(value, object, "a map of keys such as " + keys.front());
  places[std::string(object)] = value.where;
  check_keys(value, object, keys);
  read_fields(value, object, config, places);
  if constexpr (HasParts<Config>) {
    read_parts(value, object, config, places, [](std::string_view) { return true; });
  }
}

}  // namespace insonify
