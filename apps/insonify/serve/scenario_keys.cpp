// scenario_keys.cpp -- lists settings from the configurations' field lists.

#include "serve/scenario_keys.h"

#include <cmath>

#include "insonify/words.h"
#include "serve/json_text.h"

namespace insonify {
namespace {

void put_limits(const Field& field, Json& entry) {
  const double scale = file_scale_of(field);
  if (std::isfinite(field.limits.least)) {
    entry["least"] = field.limits.least * scale;
  }
  if (std::isfinite(field.limits.most)) {
    entry["most"] = field.limits.most * scale;
  }
}

template <typename Member>
Json value_of(const Field& field, const Member& member) {
  if constexpr (std::is_same_v<Member, bool>) {
    return member;
  } else if constexpr (std::is_enum_v<Member>) {
    return word_of(member);
  } else if constexpr (std::is_floating_point_v<Member>) {
    return member * file_scale_of(field);
  } else {
    return member;
  }
}

template <typename Member>
void put(const std::string& path, const Field& field, const Member& member, Json& keys) {
  if constexpr (requires { member.has_value(); }) {
    using Value = typename Member::value_type;
    if constexpr (std::is_arithmetic_v<Value>) {
      put(path, field, member.value_or(Value{}), keys);
      keys[path]["optional"] = true;
      if (!member) {
        keys[path]["value"] = nullptr;
      }
    }
  } else if constexpr (std::is_arithmetic_v<Member> || std::is_enum_v<Member>) {
    Json entry = {{"value", value_of(field, member)}};
    if constexpr (std::is_same_v<Member, bool>) {
      entry["kind"] = "switch";
    } else if constexpr (std::is_enum_v<Member>) {
      entry["kind"] = "word";
      entry["choices"] = Json::array();
      for (const auto& [word, meaning] : words_of<Member>()) {
        entry["choices"].push_back(word);
      }
    } else {
      entry["kind"] = std::is_integral_v<Member> ? "whole number" : "number";
      put_limits(field, entry);
    }
    entry["help"] = field.help;
    entry["unit"] = file_unit_of(field);
    keys[path] = entry;
  }
}

template <typename Config>
void put_fields(const std::string& object, const Config& config, ActsIn idle, Json& keys) {
  Config::visit_fields(config, [&](const Field& field, const auto& member) {
    if (field.acts != idle) {
      put((object.empty() ? "" : object + ".") + file_name_of(field), field, member, keys);
    }
  });
}

}  // namespace

nlohmann::ordered_json scenario_keys(const Scenario& scenario) {
  const ActsIn idle = scenario.model == EchoModel::kPaper ? ActsIn::kCalibrated : ActsIn::kPaper;
  Json keys = Json::object();
  put_fields("", scenario, idle, keys);
  put_fields("water", scenario.water, idle, keys);
  put_fields("receiver", scenario.receiver, idle, keys);
  put_fields("surface", scenario.surface.value_or(SeaSurface{}), idle, keys);
  keys["surface"] = {
      {"value", scenario.surface.has_value()}, {"kind", "part"}, {"help", "Whether there is a surface."}};
  if (scenario.model == EchoModel::kPaper) {
    put_fields("paper", scenario.paper, idle, keys);
  }
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const std::string object = "sonars[" + std::to_string(i) + "]";
    put_fields(object, scenario.sonars[i], idle, keys);
    put_fields(object + ".sampling", scenario.sonars[i].sampling, idle, keys);
    put_fields(object + ".receiver", scenario.receiver_of(scenario.sonars[i]), idle, keys);
  }
  return keys;
}

}  // namespace insonify
