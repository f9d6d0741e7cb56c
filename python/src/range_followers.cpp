// range_followers.cpp -- refits a sonar's bins, ping period, pulse and rows to its range.

#include "range_followers.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace insonify::python {
namespace {

bool is_near(double one, double other) {
  constexpr double kRounding = 1e-6;  // Relative error of settings that were written to a file as text.
  return std::abs(one - other) <= kRounding * std::abs(other);
}

// Presets of that title, in all modes.
const std::vector<Preset>& presets_of(const std::string& title) {
  static std::map<std::pair<std::string, std::string>, std::vector<Preset>> known;  // By their folders and title.
  const char* folders = std::getenv("INSONIFY_PRESETS");
  const auto [entry, is_new] = known.try_emplace({folders == nullptr ? "" : folders, title});
  if (is_new) {
    for (const std::string& name : preset_names()) {
      if (const Preset preset = load_preset(name); preset.title == title) {
        for (const std::string& mode : preset.modes) {
          entry->second.push_back(load_preset(name, mode));
        }
      }
    }
  }
  return entry->second;
}

// The preset, in the mode that a sonar has.
const Preset* preset_of(const SonarConfig& sonar) {
  if (sonar.model.empty()) {
    return nullptr;
  }
  const std::vector<Preset>& modes = presets_of(sonar.model);
  const auto differing = [&](const Preset& preset) {
    const SonarConfig& own = preset.sonar;
    return !is_near(sonar.frequency, own.frequency) + !is_near(sonar.azimuth_aperture, own.azimuth_aperture) +
           !is_near(sonar.elevation_aperture, own.elevation_aperture) + (sonar.beam_count != own.beam_count);
  };
  const auto nearest = std::ranges::min_element(modes, {}, differing);
  return nearest == modes.end() ? nullptr : &*nearest;
}

// What a sonar has where nothing but its range is given.
struct Fitted {
  int bin_count = 0;
  double pulse_duration = 0;
  std::optional<double> ping_period;  // Absent: the shortest.
  double shortest_period = 0;

  Fitted(SonarConfig sonar, const Preset* preset) {
    const double speed = sonar.assumed_sound_speed.value_or(Water().true_sound_speed());
    if (preset != nullptr) {
      preset->fit_to_range(sonar, speed);
      ping_period = sonar.ping_period;
    }
    bin_count = sonar.bin_count;
    pulse_duration = sonar.pulse_duration;
    shortest_period = sonar.shortest_ping_period(speed);
  }
};

std::optional<int> rows_by_rule(SonarConfig sonar) {
  sonar.sampling.rows.reset();
  return sonar.sampling_by_rule().rows;
}

}  // namespace

bool is_of_range(std::string_view field) {
  return field == "min_range" || field == "max_range" || field == "assumed_sound_speed";
}

void change_range(Held<SonarConfig>& held, const std::function<void()>& change) {
  const SonarConfig before = unwrap<SonarConfig>(py::cast(&held), "self");
  const Preset* preset = preset_of(before);
  const Fitted was(before, preset);
  change();
  SonarConfig& sonar = held.value;
  const Fitted is(sonar, preset);
  if (before.bin_count == was.bin_count) {
    sonar.bin_count = is.bin_count;
  }
  if (is_near(before.pulse_duration, was.pulse_duration)) {
    sonar.pulse_duration = is.pulse_duration;
  }
  if (!before.ping_period) {
    sonar.ping_period = is.ping_period;
  } else if (is_near(*before.ping_period, was.ping_period.value_or(was.shortest_period))) {
    // By the sound speed of a water that is not known here, the shortest is left to the simulator.
    sonar.ping_period =
        is.ping_period || !sonar.assumed_sound_speed ? is.ping_period : std::optional(is.shortest_period);
  }
  if (before.sampling.rows && before.sampling.rows == rows_by_rule(before)) {
    py::setattr(held.parts.at("sampling"), "rows", to_python(rows_by_rule(sonar), 1));
  }
}

}  // namespace insonify::python
