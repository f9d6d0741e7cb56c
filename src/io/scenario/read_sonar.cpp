// read_sonar.cpp -- applies the preset, then the entry's keys, then computes derived settings.

#include "io/scenario/read_sonar.h"

#include <fmt/format.h>

#include <optional>

#include "base/log_line.h"
#include "insonify/files.h"
#include "io/scenario/file_choices.h"
#include "io/scenario/preset_file.h"

namespace insonify {
namespace {

// Calls a check whose messages begin with the value, and adds the key and its place.
template <typename Check>
void check_choice(const YamlValue& given, const std::string& object, std::string_view key, const Check& check) {
  try {
    check();
  } catch (const Error& error) {
    throw Error(object, key, fmt::format(" = {}", error.what())).at(given.place);
  }
}

std::optional<Preset> preset_of(const YamlValue& value, const std::string& object, Places& places) {
  PresetChoice choice;
  const YamlValue* given_name = value.find("preset");
  const YamlValue* given_mode = value.find("mode");
  if (given_name == nullptr) {
    if (given_mode != nullptr) {
      throw Error(object, "mode", " belongs to a preset, and none is named").at(given_mode->place);
    }
    return std::nullopt;
  }
  read_fields(value, object, choice, places);
  check_choice(*given_name, object, "preset", [&] { check_preset_name(choice.preset); });
  if (given_mode != nullptr) {
    check_choice(*given_mode, object, "mode", [&] { check_preset_mode(choice.preset, choice.mode); });
  }
  return load_preset(choice.preset, choice.mode);
}

// Derives beam_count and, for two beams or more, azimuth_aperture from a table of beam_azimuths.
void fit_to_beam_azimuths(const YamlValue& value, const std::string& object, SonarConfig& sonar) {
  if (sonar.beam_azimuths.empty()) {
    if (const YamlValue* given = value.find("beam_azimuths_deg")) {
      throw Error(object, "beam_azimuths_deg", " must have at least one angle").at(given->place);
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
    throw Error(object, "azimuth_aperture_deg", " follows from beam_azimuths_deg; leave it out").at(given->place);
  }
  if (static_cast<int>(sonar.beam_azimuths.size()) == sonar.beam_count) {
    const double extent = sonar.bearings().extent();
    sonar.azimuth_aperture = extent > 0 ? extent : sonar.azimuth_aperture;  // validate() refuses others later.
  }
}

std::string_view owner_of(SonarType only) {
  switch (only) {
    case SonarType::kSideScan:
      return "a side-scan sonar (type: sss)";
    case SonarType::kMultibeam:
      return "a multibeam (type: mbes)";
    default:
      return "a scanning sonar";
  }
}

// Keys of one type of sonar have no effect on others.
void refuse_keys_of_other_types(const YamlValue& value, const std::string& object, const SonarConfig& sonar) {
  for (const FieldEntry& field : table_of<SonarConfig>().fields) {
    const std::optional<SonarType> only = SonarConfig::only_type(field.name);
    if (!only || *only == sonar.type) {
      continue;
    }
    if (const YamlValue* given = value.find(file_name_of(field))) {
      throw Error(object, file_name_of(field),
                  fmt::format(" belongs to {}; this one's type is {}", owner_of(*only), word_of(sonar.type)))
          .at(given->place);
    }
  }
}

// Derives bin_count, ping_period and pulse_duration from the range window unless they are given.
void fit_to_range(const YamlValue& value, const Preset& preset, const Scenario& scenario, SonarConfig& sonar) {
  SonarConfig fitted = sonar;
  preset.fit_to_range(fitted, sonar.assumed_sound_speed.value_or(scenario.water_at(sonar).true_sound_speed()));
  if (value.find("bin_count") == nullptr) {
    sonar.bin_count = fitted.bin_count;
  }
  if (value.find("ping_period") == nullptr) {
    sonar.ping_period = fitted.ping_period;
  }
  if (value.find("pulse_duration") == nullptr) {
    sonar.pulse_duration = fitted.pulse_duration;
  }
}

}  // namespace

SonarConfig read_sonar(const YamlValue& value, const std::string& object, const Scenario& scenario, Places& places,
                       const Log& log) {
  require_map(value, object, "a map of keys such as preset and max_range");
  places[object] = value.place;
  check_keys(value, object, sonar_keys(), part_keys());
  const std::optional<Preset> preset = preset_of(value, object, places);
  SonarConfig sonar = preset ? preset->sonar : SonarConfig();
  read_fields(value, object, sonar, places);
  if (value.find("receiver") != nullptr) {
    sonar.receiver = scenario.receiver;  // Defaults of the sonar's own.
  }
  read_parts(value, object, sonar, places);
  fit_to_beam_azimuths(value, object, sonar);
  if (sonar.is_side_scan() && value.find("beam_count") == nullptr) {
    sonar.beam_count = sonar.aperture_count();
  }
  refuse_keys_of_other_types(value, object, sonar);
  if (preset) {
    fit_to_range(value, *preset, scenario, sonar);
    for (const Preset::Excess& excess : preset->exceeded_by(sonar)) {
      const auto given = places.find(member_name(object, excess.field));
      const Place& place = given != places.end() ? given->second : value.place;
      log_line(log, Severity::kWarning, place.text() + member_name(object, excess.field) + excess.text);
    }
  }
  return sonar;
}

}  // namespace insonify
