// check_effects.cpp -- looks for the place of every field that acts in the other model only.

#include "io/scenario/check_effects.h"

#include <fmt/format.h>

#include <functional>

#include "insonify/error.h"
#include "insonify/words.h"

namespace insonify {
namespace {

// Calls visit(object, field) for each field of a configuration and of its parts.
void visit_all_fields(const std::string& object, ConstSettings settings,
                      const std::function<void(const std::string&, const Field&)>& visit) {
  for (const FieldEntry& field : settings.table->fields) {
    visit(object, field);
  }
  for (const PartEntry& part : settings.table->parts) {
    for (const auto& [suffix, entry] : part.entries(settings.config)) {
      visit_all_fields(member_name(object, part.name) + suffix, entry, visit);
    }
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

}  // namespace insonify
