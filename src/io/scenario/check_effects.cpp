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

// A key of a receiver that acts only beside another setting.
struct Condition {
  const char* key;
  bool (*acts)(const ReceiverConfig& receiver);
  const char* text;  // Completes "has no effect unless ...".
};
bool has_set_side_lobes(BeamPattern pattern) {
  return pattern == BeamPattern::kTaylor || pattern == BeamPattern::kDolphChebyshev;
}
constexpr std::array<Condition, 8> kConditions = {
    {{"pulse_duration", [](const ReceiverConfig& r) { return r.pulse != PulseKind::kNone; }, "pulse is cw or lfm"},
     {"pulse_bandwidth", [](const ReceiverConfig& r) { return r.pulse == PulseKind::kLfm; }, "pulse is lfm"},
     {"pulse_window", [](const ReceiverConfig& r) { return r.pulse == PulseKind::kLfm; }, "pulse is lfm"},
     {"pulse_side_lobe_db",
      [](const ReceiverConfig& r) { return r.pulse == PulseKind::kLfm && r.pulse_window == PulseWindow::kTaylor; },
      "pulse is lfm and pulse_window is taylor"},
     {"decimation", [](const ReceiverConfig& r) { return r.pulse != PulseKind::kNone; }, "pulse is cw or lfm"},
     {"ambient_noise_db", [](const ReceiverConfig& r) { return r.noise; }, "noise is true"},
     {"full_scale_db", [](const ReceiverConfig& r) { return r.counts; }, "counts is true"},
     {"side_lobe_db",
      [](const ReceiverConfig& r) {
        return has_set_side_lobes(r.azimuth_pattern) || has_set_side_lobes(r.elevation_pattern);
      },
      "a pattern is taylor or dolph_chebyshev"}}};

// Adds a line for each key given of a receiver that acts in none of those that have it.
void tell_of_receiver(const Places& places, const std::string& object, std::span<const ReceiverConfig* const> having_it,
                      std::vector<std::string>& lines) {
  for (const Condition& condition : kConditions) {
    const std::string name = member_name(object, condition.key);
    const auto given = places.find(name);
    if (given != places.end() &&
        std::ranges::none_of(having_it, [&](const ReceiverConfig* receiver) { return condition.acts(*receiver); })) {
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
  std::vector<const ReceiverConfig*> having_the_common_one = {&scenario.receiver};
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    if (const std::optional<ReceiverConfig>& own = scenario.sonars[i].receiver) {
      const ReceiverConfig* receiver = &*own;
      tell_of_receiver(scenario.places, fmt::format("sonars[{}].receiver", i), {&receiver, 1}, lines);
      having_the_common_one.push_back(receiver);  // It starts from the common one.
    }
  }
  tell_of_receiver(scenario.places, "receiver", having_the_common_one, lines);
  return lines;
}

}  // namespace insonify
