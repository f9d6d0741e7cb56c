// read_sonar.cpp -- a preset first, where one is named, then what the entry says itself, then what follows from both.

#include "io/scenario/read_sonar.h"

#include <fmt/format.h>

#include <optional>

#include "base/log_line.h"
#include "insonify/files.h"
#include "io/scenario/preset_choice.h"
#include "io/scenario/preset_file.h"
#include "io/scenario/scenario_keys.h"

namespace insonify {
namespace {

std::optional<Preset> preset_of(const YamlValue& value, const std::string& object, Places& places) {
  PresetChoice choice;
  const YamlValue* given_name = value.find("preset");
  const YamlValue* given_mode = value.find("mode");
  if (given_name == nullptr) {
    if (given_mode != nullptr) {
      throw Error(fmt::format("{}{}.mode belongs to a preset, and none is named", given_mode->where, object));
    }
    return std::nullopt;
  }
  read_fields(value, object, choice, places);
  with_place(fmt::format("{}{}.preset = ", given_name->where, object), [&] { check_preset_name(choice.preset); });
  if (given_mode != nullptr) {
    with_place(fmt::format("{}{}.mode = ", given_mode->where, object),
               [&] { check_preset_mode(choice.preset, choice.mode); });
  }
  return load_preset(choice.preset, choice.mode);
}

// A table of beams says how many there are and, from two on, how wide the fan is.
void fit_to_beam_azimuths(const YamlValue& value, const std::string& object, SonarConfig& sonar) {
  if (sonar.beam_azimuths.empty()) {
    if (const YamlValue* given = value.find("beam_azimuths_deg")) {
      throw Error(fmt::format("{}{}.beam_azimuths_deg must have at least one angle", given->where, object));
    }
    return;
  }
  if (value.find("beam_count") == nullptr) {
    sonar.beam_count = static_cast<int>(sonar.beam_azimuths.size());
  }
  if (sonar.beam_azimuths.size() < 2) {
    return;
  }
  if (const YamlValue* given = value.find("azimuth_aperture_deg")) {
    throw Error(
        fmt::format("{}{}.azimuth_aperture_deg follows from beam_azimuths_deg; leave it out", given->where, object));
  }
  if (static_cast<int>(sonar.beam_azimuths.size()) == sonar.beam_count) {
    const std::vector<double> edges = sonar.beam_edges();
    // Of a table that is in order; others are refused later, with the reason.
    sonar.azimuth_aperture = edges.front() > edges.back() ? edges.front() - edges.back() : sonar.azimuth_aperture;
  }
}

// A key that would have no effect is a mistake.
void refuse_head_keys(const YamlValue& value, const std::string& object, const SonarConfig& sonar) {
  if (sonar.type == SonarType::kMechanicallyScanned) {
    return;
  }
  for (const char* key : {"step_deg", "sector_center_deg", "sector_width_deg", "mounting"}) {
    if (const YamlValue* given = value.find(key)) {
      throw Error(
          fmt::format("{}{}.{} belongs to a scanning sonar; this one's type is fls", given->where, object, key));
    }
  }
}

// Bins and period follow the range window unless they are given.
void fit_to_range(const YamlValue& value, const Preset& preset, const Scenario& scenario, SonarConfig& sonar) {
  SonarConfig fitted = sonar;
  preset.fit_to_range(fitted, sonar.assumed_sound_speed.value_or(scenario.water_at(sonar).true_sound_speed()));
  if (value.find("bin_count") == nullptr) {
    sonar.bin_count = fitted.bin_count;
  }
  if (value.find("ping_period") == nullptr) {
    sonar.ping_period = fitted.ping_period;
  }
}

}  // namespace

SonarConfig read_sonar(const YamlValue& value, const std::string& object, const Scenario& scenario, Places& places,
                       const Log& log) {
  require_map(value, object, "a map of keys such as preset and max_range");
  places[object] = value.where;
  check_keys(value, object, sonar_keys(), part_keys());
  const std::optional<Preset> preset = preset_of(value, object, places);
  SonarConfig sonar = preset ? preset->sonar : SonarConfig();
  read_fields(value, object, sonar, places);
  read_parts(value, object, sonar, places, [](std::string_view) { return true; });
  fit_to_beam_azimuths(value, object, sonar);
  refuse_head_keys(value, object, sonar);
  if (preset) {
    fit_to_range(value, *preset, scenario, sonar);
    for (const std::string& text : preset->exceeded_by(sonar)) {
      log_line(log, Severity::kWarning, value.where + object + "." + text);
    }
  }
  return sonar;
}

}  // namespace insonify
