// check_effects.cpp -- looks for the place of every field that acts in the other model only.

#include "io/scenario/check_effects.h"

#include <fmt/format.h>

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

// Adds a line for a key that was given and does not act.
void tell_unless(bool acts, const Scenario& scenario, const std::string& object, const char* key, const char* condition,
                 std::vector<std::string>& lines) {
  const std::string name = member_name(object, key);
  const auto given = scenario.places.find(name);
  if (!acts && given != scenario.places.end()) {
    lines.push_back(fmt::format("{}{} has no effect unless {}", given->second.text(), name, condition));
  }
}

void tell_of_receiver(const Scenario& scenario, const std::string& object, const ReceiverConfig& receiver,
                      std::vector<std::string>& lines) {
  const auto tell = [&](bool acts, const char* key, const char* condition) {
    tell_unless(acts, scenario, object, key, condition, lines);
  };
  const auto has_side_lobes = [](BeamPattern pattern) {
    return pattern == BeamPattern::kTaylor || pattern == BeamPattern::kDolphChebyshev;
  };
  tell(receiver.pulse != PulseKind::kNone, "pulse_duration", "pulse is cw or lfm");
  tell(receiver.pulse == PulseKind::kLfm, "pulse_bandwidth", "pulse is lfm");
  tell(receiver.noise, "ambient_noise_db", "noise is true");
  tell(receiver.counts, "full_scale_db", "counts is true");
  tell(has_side_lobes(receiver.azimuth_pattern) || has_side_lobes(receiver.elevation_pattern), "side_lobe_db",
       "a pattern is taylor or dolph_chebyshev");
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
  if (scenario.model == EchoModel::kCalibrated) {
    tell_of_receiver(scenario, "receiver", scenario.receiver, lines);
    for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
      if (const std::optional<ReceiverConfig>& own = scenario.sonars[i].receiver) {
        tell_of_receiver(scenario, fmt::format("sonars[{}].receiver", i), *own, lines);
      }
    }
  }
  return lines;
}

}  // namespace insonify
