// odd_settings.cpp -- conditions under which keys act, and checks of levels and times that are valid but unlikely.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <span>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/scenario/check_effects.h"
#include "pattern/swath.h"

namespace insonify {
namespace {

// A sonar and its receiver.
struct Received {
  const SonarConfig& sonar;
  const ReceiverConfig& receiver;
  PulseSettings pulse = sonar.transmitted(receiver);
};

// A key that acts only beside another setting.
struct Condition {
  const char* key;
  bool (*acts)(const Received& with);
  const char* text;  // Completes "has no effect unless ...".
};
bool has_set_side_lobes(BeamPattern pattern) {
  return pattern == BeamPattern::kTaylor || pattern == BeamPattern::kDolphChebyshev;
}
bool has_array_across(const Received& with) {
  return with.sonar.elevation_pattern_beside(with.receiver) != BeamPattern::kTopHat ||
         with.sonar.sent_elevation_pattern(with.receiver) != BeamPattern::kTopHat;
}
constexpr const char* kNeedsArrayAcross = "an elevation pattern is that of an array";
bool has_array(const Received& with) {
  return with.receiver.azimuth_pattern != BeamPattern::kTopHat;
}
constexpr const char* kNeedsArray = "azimuth_pattern is that of an array";
constexpr std::array<Condition, 16> kOfReceiver = {
    {{"elements", has_array, kNeedsArray},
     {"element_error_db", has_array, kNeedsArray},
     {"element_error_deg", has_array, kNeedsArray},
     {"pulse_duration",
      [](const Received& r) { return r.receiver.pulse == PulseKind::kCw || r.receiver.pulse == PulseKind::kLfm; },
      "pulse is cw or lfm"},
     {"pulse_bandwidth", [](const Received& r) { return r.receiver.pulse == PulseKind::kLfm; }, "pulse is lfm"},
     {"pulse_window", [](const Received& r) { return r.receiver.pulse == PulseKind::kLfm; }, "pulse is lfm"},
     {"pulse_side_lobe_db",
      [](const Received& r) { return r.pulse.kind == PulseKind::kLfm && r.pulse.window == PulseWindow::kTaylor; },
      "the pulse is lfm and its window taylor"},
     {"decimation", [](const Received& r) { return r.pulse.kind != PulseKind::kNone; }, "the pulse is cw or lfm"},
     {"ambient_noise_db", [](const Received& r) { return r.receiver.noise; }, "noise is true"},
     {"wind_noise", [](const Received& r) { return r.receiver.noise; }, "noise is true"},
     {"rain_noise", [](const Received& r) { return r.receiver.noise; }, "noise is true"},
     {"ship_noise", [](const Received& r) { return r.receiver.noise; }, "noise is true"},
     {"surface_noise",
      [](const Received& r) {
        return r.receiver.noise && (r.receiver.wind_noise || r.receiver.rain_noise.value_or(0) > 0);
      },
      "noise is true and there is wind_noise or rain_noise"},
     {"full_scale_share", [](const Received& r) { return r.receiver.counts; }, "counts is true"},
     {"full_scale_db", [](const Received& r) { return r.receiver.counts; }, "counts is true"},
     {"side_lobe_db",
      [](const Received& r) {
        return has_set_side_lobes(r.receiver.azimuth_pattern) ||
               has_set_side_lobes(r.sonar.elevation_pattern_beside(r.receiver));
      },
      "a pattern is taylor or dolph_chebyshev"}}};
// A lens and a head that turns do not steer by delays, and a line array does not reach beyond 90 degrees.
bool steers_by_delays(const Received& with) {
  return (with.sonar.type == SonarType::kForwardLooking || with.sonar.is_multibeam()) &&
         with.sonar.azimuth_aperture <= std::numbers::pi;
}
constexpr std::array<Condition, 21> kOfSonar = {
    {{"bits", [](const Received& r) { return r.receiver.counts; }, "receiver.counts is true"},
     {"mapping", [](const Received& r) { return r.receiver.counts; }, "receiver.counts is true"},
     {"mapping_range_db",
      [](const Received& r) { return r.receiver.counts && r.sonar.mapping == Mapping::kLogarithmic; },
      "receiver.counts is true and mapping is logarithmic"},
     {"mapping_exponent", [](const Received& r) { return r.receiver.counts && r.sonar.mapping == Mapping::kGamma; },
      "receiver.counts is true and mapping is gamma"},
     {"crosstalk_db", [](const Received& r) { return r.sonar.beam_count > 1; }, "there are several beams"},
     {"elevation_pattern", [](const Received& r) { return r.receiver.elevation_pattern == BeamPattern::kInstrument; },
      "receiver.elevation_pattern is instrument"},
     {"elevation_element_error_db", has_array_across, kNeedsArrayAcross},
     {"elevation_element_error_deg", has_array_across, kNeedsArrayAcross},
     {"self_noise_db", [](const Received& r) { return r.receiver.noise; }, "receiver.noise is true"},
     {"two_way_array", has_array, "receiver.azimuth_pattern is that of an array"},
     {"azimuth_resolution_deg", [](const Received& r) { return r.receiver.azimuth_pattern != BeamPattern::kTopHat; },
      "receiver.azimuth_pattern is that of an array"},
     {"element_width_deg", [](const Received& r) { return r.receiver.azimuth_pattern != BeamPattern::kTopHat; },
      "receiver.azimuth_pattern is that of an array"},
     {"focus_range", [](const Received& r) { return r.receiver.azimuth_pattern != BeamPattern::kTopHat; },
      "receiver.azimuth_pattern is that of an array"},
     {"pulse", [](const Received& r) { return r.receiver.pulse == PulseKind::kInstrument; },
      "receiver.pulse is instrument"},
     {"pulse_duration", [](const Received& r) { return r.sonar.pulse != PulseKind::kNone; }, "pulse is cw or lfm"},
     {"pulse_bandwidth", [](const Received& r) { return r.sonar.pulse == PulseKind::kLfm; }, "pulse is lfm"},
     {"pulse_window", [](const Received& r) { return r.sonar.pulse == PulseKind::kLfm; }, "pulse is lfm"},
     {"ring_down", [](const Received& r) { return r.sonar.leak_db.has_value(); }, "leak_db is given"},
     {"leak_spread_db", [](const Received& r) { return r.sonar.leak_db.has_value(); }, "leak_db is given"},
     {"bandwidth", [](const Received& r) { return r.receiver.noise && r.pulse.kind == PulseKind::kNone; },
      "noise is true and the pulse is none"},
     {"steering", steers_by_delays, "type is fls or mbes and its fan at most 180 deg wide"}}};

constexpr std::array<Condition, 3> kOfMaterial = {
    {{"clutter_shape", [](const Received& r) { return r.receiver.speckle; }, "receiver.speckle is true"},
     {"clutter_length", [](const Received& r) { return r.receiver.speckle; }, "receiver.speckle is true"},
     {"scatterer_density", [](const Received& r) { return r.receiver.speckle; }, "receiver.speckle is true"}}};

constexpr std::array<Condition, 1> kOfScenario = {
    {{"thrusters", [](const Received& r) { return r.receiver.noise; }, "receiver.noise is true"}}};

// Adds a line for each given key of `object` that acts in none of the sonars.
void add_idle_keys(const Places& places, const std::string& object, std::span<const Condition> conditions,
                   std::span<const Received> having_it, std::vector<std::string>& lines) {
  for (const Condition& condition : conditions) {
    const std::string name = member_name(object, condition.key);
    const auto given = places.find(name);
    if (given != places.end() &&
        std::ranges::none_of(having_it, [&](const Received& with) { return condition.acts(with); })) {
      lines.push_back(fmt::format("{}{} has no effect unless {}", given->second.text(), name, condition.text));
    }
  }
}

// Adds a line if a key is given but not the setting that it needs.
// @param text  Completes "has no effect ".
void add_if_given(const Places& places, const std::string& name, std::string_view text,
                  std::vector<std::string>& lines) {
  if (const auto given = places.find(name); given != places.end()) {
    lines.push_back(fmt::format("{}{} has no effect {}", given->second.text(), name, text));
  }
}

// Keys of the scenario's parts that act only beside another key of the same part.
void check_parts(const Scenario& scenario, std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < scenario.thrusters.size(); ++i) {
    if (!(scenario.thrusters[i].blade_rate > 0)) {
      add_if_given(scenario.places, fmt::format("thrusters[{}].blade_phase_deg", i), "unless blade_rate is given",
                   lines);
    }
  }
  // Overrides that name no material of the library start from the default one, which may have clutter.
  const auto by_default = scenario.materials.overrides.find(scenario.materials.default_material);
  const bool default_has_clutter =
      by_default != scenario.materials.overrides.end() && by_default->second.clutter_shape.has_value();
  for (const auto& [name, material] : scenario.materials.overrides) {
    if (material.clutter_length && !material.clutter_shape && !(default_has_clutter && material.like.empty())) {
      add_if_given(scenario.places, fmt::format("materials.{}.clutter_length", name), "unless clutter_shape is given",
                   lines);
    }
  }
}

// The text of a line about a setting, with its place.
std::string located_text(const Scenario& scenario, const Error& about) {
  return about.located(scenario.places).what();
}

// Adds a line if sources are above the water's surface, which hides them from the sonars below it.
template <typename Source>
void check_heights(const Scenario& scenario, std::string_view list, const std::vector<Source>& sources,
                   std::vector<std::string>& lines) {
  const auto is_above = [&](const Source& source) { return source.position.z() > scenario.surface->level; };
  const auto first = std::ranges::find_if(sources, is_above);
  if (first == sources.end()) {
    return;
  }
  const auto others = std::count_if(first + 1, sources.end(), is_above);
  lines.push_back(located_text(
      scenario,
      Error(fmt::format("{}[{}]", list, first - sources.begin()), "position[2]",
            fmt::format(
                " = {:.7g} m is above surface.level = {:.7g} m, so that it is not received{}", first->position.z(),
                scenario.surface->level,
                others > 0 ? fmt::format(", nor {}", counted(static_cast<std::uint64_t>(others), "other")) : ""))));
}

// Adds a line if a sonar's pulse is longer than the time from its transmission to the last echo.
void check_pulse(const Scenario& scenario, const std::string& object, const Received& with,
                 std::vector<std::string>& lines) {
  const double speed = with.sonar.assumed_sound_speed.value_or(scenario.water_at(with.sonar).true_sound_speed());
  const double listening = with.sonar.shortest_ping_period(speed);
  if (with.pulse.kind == PulseKind::kNone || with.pulse.duration <= listening) {
    return;
  }
  const bool own = with.receiver.pulse == PulseKind::kInstrument;
  const std::string whose = own ? object : with.sonar.receiver ? object + ".receiver" : "receiver";
  lines.push_back(located_text(
      scenario,
      Error(
          whose, "pulse_duration",
          fmt::format(" = {:.4g} s is longer than the {:.4g} s in which {} receives echoes up to max_range = {:.4g} m",
                      with.pulse.duration, listening, object, with.sonar.max_range),
          {object + ".max_range"})));
}

// Adds the lines about settings of the calibrated model.
void check_calibrated(const Scenario& scenario, std::vector<std::string>& lines) {
  std::vector<Received> all;  // A sonar's own receiver starts from the common one.
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const SonarConfig& sonar = scenario.sonars[i];
    const Received with{.sonar = sonar, .receiver = scenario.receiver_of(sonar)};
    const std::string object = fmt::format("sonars[{}]", i);
    add_idle_keys(scenario.places, object, kOfSonar, {&with, 1}, lines);
    if (sonar.receiver) {
      add_idle_keys(scenario.places, object + ".receiver", kOfReceiver, {&with, 1}, lines);
    }
    check_pulse(scenario, object, with, lines);
    all.push_back(with);
  }
  add_idle_keys(scenario.places, "receiver", kOfReceiver, all, lines);
  add_idle_keys(scenario.places, "", kOfScenario, all, lines);
  if (scenario.mutual_interference && scenario.sonars.size() < 2) {
    add_if_given(scenario.places, "mutual_interference", "unless there are several sonars", lines);
  }
  for (const auto& [name, material] : scenario.materials.overrides) {
    add_idle_keys(scenario.places, "materials." + name, kOfMaterial, all, lines);
  }
  check_parts(scenario, lines);
  if (scenario.surface) {
    check_heights(scenario, "points", scenario.points, lines);
    check_heights(scenario, "interferers", scenario.interferers, lines);
  }
}

// Adds a line if lines are further apart than the swath over a flat bed.
void check_swath(const Scenario& scenario, std::vector<std::string>& lines) {
  const SonarConfig* sonar = swath_sonar(scenario.sonars);
  const SurveyLines* survey = scenario.pattern ? &scenario.pattern->lines : nullptr;
  if (survey == nullptr || sonar == nullptr || !survey->altitude || !survey->spacing || survey->width == 0) {
    return;
  }
  const double swath = 2 * *half_swath(*sonar, *survey->altitude + sonar->position.z());
  if (*survey->spacing > swath) {
    lines.push_back(located_text(
        scenario, Error("pattern.lines", "spacing",
                        fmt::format(" = {:.4g} m is more than the swath of {}, {:.4g} m at this altitude: there are "
                                    "gaps between lines",
                                    *survey->spacing, printable(sonar->name), swath))));
  }
}

}  // namespace

std::vector<std::string> odd_settings(const Scenario& scenario) {
  std::vector<std::string> lines;
  if (scenario.surface) {
    add_if_given(scenario.places, "water.depth", "beside surface: each sonar's depth is that below surface.level",
                 lines);
  }
  if (scenario.model == EchoModel::kCalibrated) {
    check_calibrated(scenario, lines);
  }
  check_swath(scenario, lines);
  add_odd_values(scenario, lines);
  return lines;
}

}  // namespace insonify
