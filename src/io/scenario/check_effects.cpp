// check_effects.cpp -- looks for the place of every field that acts in the other model only.

#include "io/scenario/check_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "insonify/error.h"
#include "insonify/words.h"

namespace insonify {
namespace {

// Calls visit(object, field) for each field of a configuration and of its parts.
template <typename Config, typename Visit>
void visit_all_fields(const std::string& object, const Config& config, const Visit& visit) {
  Config::visit_fields(config, [&](const Field& field, const auto&) { visit(object, field); });
  if constexpr (HasParts<Config>) {
    Config::visit_parts(config, [&](const Part& part, const auto& member) {
      visit_entries(member_name(object, part.name), member,
                    [&](const std::string& name, const auto& entry) { visit_all_fields(name, entry, visit); });
    });
  }
}

bool is_of_command_line(const Place& place) {
  return place.line == 0;
}

bool model_is_of_command_line(const Scenario& scenario) {
  const auto model = scenario.places.find("model");
  return model != scenario.places.end() && is_of_command_line(model->second);
}

// Calls visit(object, field, place) for each key given that acts in the other model only.
template <typename Visit>
void visit_idle_keys(const Scenario& scenario, const Visit& visit) {
  const ActsIn other = scenario.model == EchoModel::kPaper ? ActsIn::kCalibrated : ActsIn::kPaper;
  visit_all_fields("", scenario, [&](const std::string& object, const Field& field) {
    const auto given = scenario.places.find(member_name(object, file_name_of(field)));
    if (field.acts == other && given != scenario.places.end()) {
      visit(object, field, given->second);
    }
  });
}

// A sonar and the receiver that it has.
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
constexpr std::array<Condition, 15> kOfSonar = {
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
      "noise is true and the pulse is none"}}};

constexpr std::array<Condition, 2> kOfMaterial = {
    {{"clutter_shape", [](const Received& r) { return r.receiver.speckle; }, "receiver.speckle is true"},
     {"scatterer_density", [](const Received& r) { return r.receiver.speckle; }, "receiver.speckle is true"}}};

constexpr std::array<Condition, 1> kOfScenario = {
    {{"thrusters", [](const Received& r) { return r.receiver.noise; }, "receiver.noise is true"}}};

// Adds a line for each key given of `object` that acts in none of those that have it.
void tell_of(const Places& places, const std::string& object, std::span<const Condition> conditions,
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

}  // namespace

void refuse_idle_keys(const Scenario& scenario) {
  visit_idle_keys(scenario, [&](const std::string& object, const Field& field, const Place& place) {
    if (model_is_of_command_line(scenario) && !is_of_command_line(place)) {
      return;
    }
    const EchoModel other = scenario.model == EchoModel::kPaper ? EchoModel::kCalibrated : EchoModel::kPaper;
    const std::string instead = field.instead.empty() ? fmt::format("it needs model = {}", word_of(other))
                                                      : fmt::format("set {}", field.instead);
    throw Error(object, file_name_of(field),
                fmt::format(" has no effect with model = {}; {}", word_of(scenario.model), instead))
        .at(place);
  });
}

std::vector<std::string> idle_keys(const Scenario& scenario) {
  std::vector<std::string> keys;
  visit_idle_keys(scenario, [&](const std::string& object, const Field& field, const Place&) {
    keys.push_back(member_name(object, file_name_of(field)));
  });
  return keys;
}

std::vector<std::string> keys_idle_beside_others(const Scenario& scenario) {
  std::vector<std::string> lines;
  if (scenario.model != EchoModel::kCalibrated) {
    return lines;
  }
  std::vector<Received> all;  // Each receiver of a sonar's own starts from the common one.
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const SonarConfig& sonar = scenario.sonars[i];
    const Received with{.sonar = sonar, .receiver = scenario.receiver_of(sonar)};
    const std::string object = fmt::format("sonars[{}]", i);
    tell_of(scenario.places, object, kOfSonar, {&with, 1}, lines);
    if (sonar.receiver) {
      tell_of(scenario.places, object + ".receiver", kOfReceiver, {&with, 1}, lines);
    }
    all.push_back(with);
  }
  tell_of(scenario.places, "receiver", kOfReceiver, all, lines);
  tell_of(scenario.places, "", kOfScenario, all, lines);
  if (const auto given = scenario.places.find("mutual_interference");
      given != scenario.places.end() && scenario.mutual_interference && scenario.sonars.size() < 2) {
    lines.push_back(given->second.text() + "mutual_interference has no effect unless there are several sonars");
  }
  visit_entries("materials", scenario.materials.overrides,
                [&](const std::string& name, const auto&) { tell_of(scenario.places, name, kOfMaterial, all, lines); });
  return lines;
}

}  // namespace insonify
