// yaml_settings.cpp -- finds or creates the value in a scenario's tree that a setting's key names.

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

// One step of a key: a name, or an index of a list.
struct Step {
  std::string name;
  int index = -1;

  bool is_index() const { return index >= 0; }
};

struct Setting {
  Place place;
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

Setting parse_setting(std::string text) {
  constexpr std::string_view kOption = "--";
  const bool is_option = text.starts_with(kOption);
  const Place place{fmt::format("{}{}", is_option ? "" : "--set ", printable(text, kLongestName))};
  text.erase(0, is_option ? kOption.size() : 0);
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Error("must be key=value, such as pings=3").at(place);
  }
  Setting setting{place, steps_of(std::string_view(text).substr(0, equals)), {}};
  if (setting.steps.empty()) {
    throw Error(
        fmt::format("{} is not a key such as water.depth or sonars[0].max_range", quoted_text(text.substr(0, equals))))
        .at(place);
  }
  setting.value = parse_yaml_setting(text.substr(equals + 1), place);
  return setting;
}

// The entry of a list that a step names: by index, or by its own `name`.
YamlValue& item_of(YamlValue& list, const Step& step, const std::string& name, const Place& place) {
  if (step.is_index()) {
    if (step.index >= static_cast<int>(list.items.size())) {
      throw Error(fmt::format("there is no {0}[{1}]; {0} has {2}", name, step.index, list.items.size())).at(place);
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
  throw Error(fmt::format("{} has no entry called {}; it has {}", name, printable(step.name), fmt::join(names, ", ")))
      .at(place);
}

bool contains(std::span<const std::string> keys, const std::string& key) {
  return std::ranges::find(keys, key) != keys.end();
}

// Keys of which a map can have only one.
const std::vector<std::vector<std::string>> kAlternatives = {{"pings", "duration", "turns"},
                                                             {"orientation_deg", "orientation_wxyz"}};

// A key given by --set replaces its alternatives in the file.
void remove_alternatives(YamlValue& map, const std::string& key, const Place& place) {
  for (const std::vector<std::string>& keys : kAlternatives) {
    if (!contains(keys, key)) {
      continue;
    }
    const auto is_other = [&](const auto& entry) { return entry.key != key && contains(keys, entry.key); };
    for (const auto& entry : map.entries) {
      if (is_other(entry) && entry.value.place.line == 0) {
        throw Error(fmt::format("cannot be set together with {}; leave one out", entry.value.place.file)).at(place);
      }
    }
    std::erase_if(map.entries, is_other);
  }
}

// Follows the steps from `tree`, makes maps where there is nothing yet, and puts the value at the end.
void put(YamlValue& tree, std::span<const Step> steps, std::string name, const YamlValue& value, const Place& place) {
  if (steps.empty()) {
    tree = value;
    tree.place = place;
    return;
  }
  const Step& step = steps.front();
  if (tree.kind == Kind::kList) {
    put(item_of(tree, step, name, place), steps.subspan(1),
        step.is_index() ? fmt::format("{}[{}]", name, step.index) : fmt::format("{}.{}", name, step.name), value,
        place);
    return;
  }
  if (tree.kind == Kind::kScalar || step.is_index()) {
    throw Error(fmt::format("{} is not {}", name, step.is_index() ? "a list" : "a map of keys")).at(place);
  }
  tree.kind = Kind::kMap;
  if (tree.place.file.empty()) {
    tree.place = place;
  }
  if (value.kind != Kind::kNothing) {
    remove_alternatives(tree, step.name, place);
  }
  YamlValue* next = tree.find(step.name);
  if (next == nullptr) {
    tree.entries.push_back({step.name, {}});
    next = &tree.entries.back().value;
  }
  put(*next, steps.subspan(1), name.empty() ? step.name : fmt::format("{}.{}", name, step.name), value, place);
}

}  // namespace

void apply_setting(YamlValue& scenario, const std::string& text) {
  const Setting setting = parse_setting(text);
  const std::string& first = setting.steps.front().name;
  std::vector<std::string> keys = scenario_keys();
  if (contains(keys, first)) {
    put(scenario, setting.steps, "", setting.value, setting.place);
    return;
  }
  const std::vector<std::string> of_sonar = sonar_keys();
  if (!contains(of_sonar, first)) {
    keys.insert(keys.end(), of_sonar.begin(), of_sonar.end());
    const bool angle = contains(keys, first + "_deg");
    throw Error(angle ? fmt::format("{0} must be written {0}_deg, in degrees", first)
                      : fmt::format("{} is not a known key{}", first, key_suggestion(first, keys, part_keys())))
        .at(setting.place);
  }
  YamlValue* sonars = scenario.find("sonars");
  if (sonars == nullptr || sonars->kind != Kind::kList) {
    throw Error(fmt::format("{} is a key of sonars, and the scenario has none", first)).at(setting.place);
  }
  for (std::size_t i = 0; i < sonars->items.size(); ++i) {
    put(sonars->items[i], setting.steps, fmt::format("sonars[{}]", i), setting.value, setting.place);
  }
}

void list_arguments(YamlValue& scenario) {
  YamlValue* given = scenario.find("arguments");
  if (given == nullptr) {
    return;
  }
  if (given->kind == Kind::kMap) {
    for (const auto& [name, value] : given->entries) {
      if (value.kind != Kind::kScalar) {
        throw Error("arguments", printable(name), fmt::format(" = {} must be a text or a number", value.shown()))
            .at(value.place);
      }
      given->items.push_back(scalar(fmt::format("{}={}", name, value.scalar), true));
      given->items.back().place = value.place;
    }
    given->entries.clear();
    given->kind = Kind::kList;
  }
  for (std::size_t i = 0; i < given->items.size(); ++i) {
    const YamlValue& item = given->items[i];
    if (item.kind != Kind::kScalar || item.scalar.find('=') == std::string::npos || item.scalar.starts_with('=')) {
      throw Error("", fmt::format("arguments[{}]", i), fmt::format(" = {} must be name=value", item.shown()))
          .at(item.place);
    }
  }
}

std::vector<std::string> arguments_with(const YamlValue& scenario, std::span<const std::string> settings) {
  YamlValue only{.kind = Kind::kMap};
  if (const YamlValue* given = scenario.find("arguments")) {
    only.entries.push_back({"arguments", *given});
  }
  for (const std::string& setting : settings) {
    const std::string_view key = std::string_view(setting).substr(setting.starts_with("--") ? 2 : 0);
    if (key.starts_with("arguments.") || key.starts_with("arguments=")) {
      apply_setting(only, setting);
    }
  }
  list_arguments(only);
  std::vector<std::string> arguments;
  if (const YamlValue* list = only.find("arguments")) {
    for (const YamlValue& item : list->items) {
      arguments.push_back(item.scalar);
    }
  }
  return arguments;
}

}  // namespace insonify
