// oculus_sonar.cpp -- the frequency modes of an Oculus, and the sonar that its settings make of one.

#include "insonify/wire/oculus_sonar.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "insonify/acoustics/sound_speed.h"

namespace insonify {
namespace {

constexpr int kFewBeams = 256;  // Without the flag for 512.
constexpr int kMostRows = 65535;

struct PartNumber {
  std::string_view title;
  std::uint16_t number;
};
constexpr std::array<PartNumber, 4> kPartNumbers = {{{"Blueprint Oculus M370s", 1041},
                                                     {"Blueprint Oculus M750d", 1032},
                                                     {"Blueprint Oculus M1200d", 1042},
                                                     {"Blueprint Oculus M3000d", 2203}}};

// The preset of a sonar in the mode that it was made in, which is the one with its frequency, else the default.
std::optional<Preset> preset_of(const SonarConfig& sonar) {
  for (const std::string& name : preset_names()) {
    Preset preset = load_preset(name);
    if (sonar.model.empty() || preset.title != sonar.model) {
      continue;
    }
    for (const std::string& mode : preset.modes) {
      Preset other = load_preset(name, mode);
      if (other.sonar.frequency == sonar.frequency) {
        return other;
      }
    }
    return preset;
  }
  return {};
}

bool has_mode(const Preset& preset, std::string_view mode) {
  return std::ranges::find(preset.modes, mode) != preset.modes.end();
}

// A sonar made from the preset `from`, in the mode `to`: what the scenario has changed stays.
SonarConfig in_mode(const SonarConfig& sonar, const SonarConfig& from, const SonarConfig& to) {
  SonarConfig changed = sonar;
  for (const FieldEntry& field : table_of<SonarConfig>().fields) {
    if (field.equal(&changed, &from)) {
      field.copy(&to, &changed);
    }
  }
  return changed;
}

// The shortest period that the scenario itself asks for; a preset's own belongs to one range.
std::optional<double> period_of(const Scenario& scenario, const SonarConfig& sonar, const Preset* preset) {
  if (preset != nullptr) {
    SonarConfig fitted = sonar;
    preset->fit_to_range(fitted, *scenario.filled_in(sonar).assumed_sound_speed);
    if (fitted.ping_period == sonar.ping_period) {
      return {};
    }
  }
  return sonar.ping_period;
}

double sound_speed_of(const Scenario& scenario, const SonarConfig& sonar, const OculusFire& fire) {
  if (fire.sound_speed != 0) {
    return fire.sound_speed;
  }
  const double own = *scenario.filled_in(sonar).assumed_sound_speed;
  if (fire.salinity == 0) {
    return own;
  }
  const Water water = scenario.water_at(sonar);
  const auto in_salinity = [&](double salinity) {
    return chen_millero_sound_speed(water.temperature_c, salinity, water.depth);
  };
  return own * in_salinity(fire.salinity) / in_salinity(water.salinity);
}

int rows_over(double range, const OculusMode& mode, double sound_speed) {
  if (!mode.preset) {
    return std::min(mode.sonar.bin_count, kMostRows);
  }
  SonarConfig fitted = mode.sonar;
  fitted.min_range = 0;
  fitted.max_range = range;
  mode.preset->fit_to_range(fitted, sound_speed);
  return std::min(fitted.bin_count, kMostRows);
}

}  // namespace

OculusModes oculus_modes(const Scenario& scenario, const SonarConfig& sonar, const SonarConfig* high) {
  const auto mode_of = [&](const SonarConfig& config, const std::optional<Preset>& preset) {
    return OculusMode{
        .sonar = config, .preset = preset, .ping_period = period_of(scenario, config, preset ? &*preset : nullptr)};
  };
  const std::optional<Preset> made_from = preset_of(sonar);
  OculusModes modes{.low = mode_of(sonar, made_from)};
  if (made_from) {
    const auto* part = std::ranges::find(kPartNumbers, made_from->title, &PartNumber::title);
    modes.part_number = part == kPartNumbers.end() ? 0 : part->number;
    // Longest range and period are the instrument's.
    const auto mode = [&](const char* name) {
      const Preset preset = load_preset(made_from->name, name);
      OculusMode result{.sonar = in_mode(sonar, made_from->sonar, preset.sonar),
                        .preset = preset,
                        .ping_period = modes.low.ping_period};
      result.sonar.max_range = preset.sonar.max_range;
      return result;
    };
    if (has_mode(*made_from, "low") && has_mode(*made_from, "high")) {
      modes.high = mode("high");
      modes.low = mode("low");
    } else {
      modes.low.sonar.max_range = made_from->sonar.max_range;
    }
  }
  if (high != nullptr) {
    modes.high = mode_of(*high, preset_of(*high));
    modes.high->sonar.name = sonar.name;
    if (modes.high->preset) {
      modes.high->sonar.max_range = modes.high->preset->sonar.max_range;
    }
  }
  return modes;
}

OculusPlan oculus_plan(const OculusMode& mode, const Scenario& scenario, const OculusFire& fire) {
  constexpr double kPercent = 0.01;
  OculusPlan plan{.fire = fire};
  const double longest = mode.sonar.max_range;
  plan.range = std::min(longest, fire.has(kOculusRangeInMetres) ? fire.range : kPercent * fire.range * longest);
  if (fire.has(kOculusRangeInMetres)) {
    plan.fire.range = plan.range;
  }
  if (fire.mode == 2) {
    plan.fire.gain = 40 + 0.6 * fire.gain;
  }
  plan.gain_db = kOculusGainSpan * (plan.fire.gain - 50) / 50;

  const double sound_speed = sound_speed_of(scenario, mode.sonar, fire);
  plan.rows = rows_over(plan.range, mode, sound_speed);
  plan.row_length = plan.range / plan.rows;
  constexpr double kRounding = 1e-9;  // A min_range of whole rows blanks just these.
  plan.blank_rows = static_cast<int>(
      std::clamp(std::ceil(mode.sonar.min_range / plan.row_length - kRounding), 0.0, static_cast<double>(plan.rows)));
  if (const double rate = oculus_ping_rate(fire.ping_rate); rate > 0) {
    plan.period = std::max({1 / rate, mode.ping_period.value_or(0), 2 * plan.range / sound_speed});
  }
  if (plan.blank_rows == plan.rows) {
    return plan;
  }

  SonarConfig& sonar = plan.sonar.emplace(mode.sonar);
  sonar.min_range = plan.blank_rows * plan.row_length;
  sonar.max_range = plan.range;
  sonar.bin_count = plan.rows - plan.blank_rows;
  sonar.assumed_sound_speed = sound_speed;
  sonar.ping_period.reset();
  if (!fire.has(kOculus512Beams) && sonar.beam_azimuths.empty()) {
    sonar.beam_count = std::min(sonar.beam_count, kFewBeams);
  }
  return plan;
}

std::vector<std::int16_t> oculus_bearings(const SonarConfig& sonar) {
  std::vector<std::int16_t> bearings;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const double hundredths = -100 * degrees_from_radians(sonar.beam_azimuth(beam));
    bearings.push_back(static_cast<std::int16_t>(std::lround(hundredths)));
  }
  return bearings;
}

}  // namespace insonify
