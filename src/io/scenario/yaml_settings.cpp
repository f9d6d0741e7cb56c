// yaml_settings.cpp -- finds or makes the place in a scenario's tree that a setting's key names.

#include "io/scenario/yaml_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/scenario/yaml_read.h"

namespace insonify {
namespace {

using Kind = YamlValue::Kind;

// One step of a key: a name, or a place in a list.
struct Step {
  std::string name;
  int index = -1;

  bool is_index() const { return index >= 0; }
};

struct Setting {
  std::string where;
  std::vector<Step> steps;
  YamlValue value;
};

// "sonars[0].max_range" gives sonars, 0, max_range; nothing when it is not of that form.
std::vector<Step> steps_of(std::string_view key) {
  std::vector<Step> steps;
  while (!key.empty()) {
    const std::size_t end = std::min(key.find_first_of(".["), key.size());
    if (end == 0) {
      return {};
    }
    steps.push_back({std::string(key.substr(0, end))});
    key.remove_prefix(end);
    while (key.starts_with('[')) {
      int index = -1;
      const auto [stop, error] = std::from_chars(key.data() + 1, key.data() + key.size(), index);
      if (error != std::errc() || index < 0 || stop == key.data() + key.size() || *stop != ']') {
        return {};
      }
      steps.push_back({"", index});
      key.remove_prefix(static_cast<std::size_t>(stop - key.data()) + 1);
    }
    if (key.starts_with('.') && key.size() > 1) {
      key.remove_prefix(1);
    } else if (!key.empty()) {
      return {};
    }
  }
  return steps;
}

Setting parse_setting(const std::string& text) {
  const std::string where = fmt::format("--set {}: ", printable(text, kLongestName));
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Error(where + "must be key=value, such as pings=3");
  }
  Setting setting{where, steps_of(std::string_view(text).substr(0, equals)), {}};
  if (setting.steps.empty()) {
    throw Error(fmt::format("{}{} is not a key such as water.depth or sonars[0].max_range", where,
                            quoted_text(text.substr(0, equals))));
  }
  setting.value = parse_yaml_setting(text.substr(equals + 1), where);
  return setting;
}

// The entry of a list that a step names: by its place, or by the `name` inside it.
YamlValue& item_of(YamlValue& list, const Step& step, const std::string& name, const std::string& where) {
  if (step.is_index()) {
    if (step.index >= static_cast<int>(list.items.size())) {
      throw Error(fmt::format("{0}there is no {1}[{2}]; {1} has {3}", where, name, step.index, list.items.size()));
    }
    return list.items[step.index];
  }
  std::vector<std::string> names;
  for (YamlValue& item : list.items) {
    const YamlValue* own_name = item.find("name");
    const std::string own = own_name != nullptr ? own_name->scalar : "sonar";
    if (own == step.name) {
      return item;
    }
    names.push_back(printable(own));
  }
  throw Error(
      fmt::format("{}{} has no entry called {}; it has {}", where, name, printable(step.name), fmt::join(names, ", ")));
}

// Follows the steps from `place`, makes maps where there is nothing yet, and puts the value at the end.
void put(YamlValue& place, std::span<const Step> steps, std::string name, const YamlValue& value,
         const std::string& where) {
  if (steps.empty()) {
    place = value;
    place.where = where;
    return;
  }
  const Step& step = steps.front();
  if (place.kind == Kind::kList) {
    put(item_of(place, step, name, where), steps.subspan(1),
        step.is_index() ? fmt::format("{}[{}]", name, step.index) : fmt::format("{}.{}", name, step.name), value,
        where);
    return;
  }
  if (place.kind == Kind::kScalar || step.is_index()) {
    throw Error(fmt::format("{}{} is not {}", where, name, step.is_index() ? "a list" : "a map of keys"));
  }
  place.kind = Kind::kMap;
  if (place.where.empty()) {
    place.where = where;
  }
  YamlValue* next = place.find(step.name);
  if (next == nullptr) {
    place.entries.push_back({step.name, {}});
    next = &place.entries.back().value;
  }
  put(*next, steps.subspan(1), name.empty() ? step.name : fmt::format("{}.{}", name, step.name), value, where);
}

bool contains(std::span<const std::string> keys, const std::string& key) {
  return std::ranges::find(keys, key) != keys.end();
}

// Of the keys that say when pings end only one can be there: a new one takes the place of the others.
void remove_other_lengths(YamlValue& scenario, const std::string& key) {
  const std::vector<std::string> lengths = {"pings", "duration", "turns"};
  if (contains(lengths, key)) {
    std::erase_if(scenario.entries,
                  [&](const auto& entry) { return entry.key != key && contains(lengths, entry.key); });
  }
}

}  // namespace

void apply_setting(YamlValue& scenario, const std::string& text, std::span<const std::string> scenario_keys,
                   std::span<const std::string> sonar_keys, std::span<const std::string> part_keys) {
  const Setting setting = parse_setting(text);
  const std::string& first = setting.steps.front().name;
  if (contains(scenario_keys, first)) {
    if (setting.value.kind != Kind::kNothing) {
      remove_other_lengths(scenario, first);
    }
    put(scenario, setting.steps, "", setting.value, setting.where);
    return;
  }
  if (!contains(sonar_keys, first)) {
    std::vector<std::string> keys(scenario_keys.begin(), scenario_keys.end());
    keys.insert(keys.end(), sonar_keys.begin(), sonar_keys.end());
    const bool angle = contains(keys, first + "_deg");
    throw Error(
        angle ? fmt::format("{}{} must be written {}_deg, in degrees", setting.where, first, first)
              : fmt::format("{}{} is not a known key{}", setting.where, first, key_suggestion(first, keys, part_keys)));
  }
  YamlValue* sonars = scenario.find("sonars");
  if (sonars == nullptr || sonars->kind != Kind::kList) {
    throw Error(fmt::format("{}{} is a key of sonars, and the scenario has none", setting.where, first));
  }
  for (std::size_t i = 0; i < sonars->items.size(); ++i) {
    put(sonars->items[i], setting.steps, fmt::format("sonars[{}]", i), setting.value, setting.where);
  }
}

}  // namespace insonify
