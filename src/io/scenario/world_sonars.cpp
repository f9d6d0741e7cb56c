// world_sonars.cpp -- shared code of the readers of worlds that contain sonars.

#include "io/scenario/world_sonars.h"

#include <string_view>
#include <utility>

namespace insonify {
namespace {

namespace fs = std::filesystem;
using Kind = YamlValue::Kind;

}  // namespace

std::string world_as_scenario(const fs::path& path) {
  YamlValue world;
  world.kind = Kind::kScalar;
  world.scalar = path.filename().string();
  world.quoted = true;
  YamlValue scenario;
  scenario.kind = Kind::kMap;
  scenario.entries.push_back({"world", std::move(world)});
  return write_yaml(scenario);
}

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

void set_place(YamlValue& value, const Place& place) {
  value.place = place;
  for (YamlValue& item : value.items) {
    set_place(item, place);
  }
  for (YamlValue::Entry& entry : value.entries) {
    set_place(entry.value, place);
  }
}

bool is_given(const YamlValue& scenario, const char* key) {
  const YamlValue* value = scenario.find(key);
  return value != nullptr && value->kind != Kind::kNothing;
}

}  // namespace insonify
