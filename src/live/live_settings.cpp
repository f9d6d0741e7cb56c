// live_settings.cpp -- applies changes to a scenario's text and compares scenarios.

#include "live/live_settings.h"

#include <algorithm>

#include "insonify/files.h"
#include "io/scenario/yaml_read.h"

namespace insonify {
namespace {

std::string key_of(const std::string& setting) {
  return setting.substr(0, setting.find('='));
}

std::string with_settings(const std::string& text, const std::filesystem::path& path,
                          std::span<const std::string> settings) {
  YamlValue tree = parse_yaml(text, path.string());
  for (const std::string& setting : settings) {
    apply_setting(tree, setting);
  }
  return write_yaml(tree);
}

}  // namespace

void LiveSettings::add(std::span<const std::string> changes) {
  constexpr std::string_view kModel = "model";
  if (std::ranges::find(changes, kModel, key_of) != changes.end()) {
    std::erase_if(settings, [&](const std::string& setting) { return key_of(setting) == kModel; });
    text = with_settings(text, path, settings);
    settings.clear();
  }
  for (const std::string& change : changes) {
    std::erase_if(settings, [&](const std::string& setting) { return key_of(setting) == key_of(change); });
    settings.push_back(change);
  }
}

Scenario LiveSettings::scenario(const Log& log) const {
  Scenario scenario = load_scenario_text(text, path, settings, log);
  for (const auto& [object, material] : materials) {
    scenario.materials.overrides[object] = MaterialOverride{.like = material};
    scenario.text.clear();
  }
  if (followed) {
    scenario.world.clear();
    scenario.materials.for_more = true;
  }
  return scenario;
}

bool differ_in_sonars_only(const Scenario& a, const Scenario& b) {
  if (!std::ranges::equal(a.sonars, b.sonars, {}, &SonarConfig::name, &SonarConfig::name)) {
    return false;
  }
  Scenario with_other_sonars = a;
  with_other_sonars.sonars = b.sonars;
  return to_yaml(with_other_sonars) == to_yaml(b);
}

}  // namespace insonify
