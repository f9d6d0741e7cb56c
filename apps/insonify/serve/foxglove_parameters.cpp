// foxglove_parameters.cpp -- reads parameters from the state of the source, and passes changes to it.

#include "serve/foxglove_parameters.h"

#include <fmt/format.h>

#include <algorithm>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "serve/json_messages.h"

namespace insonify {
namespace {

constexpr const char* kPaused = "/paused";
constexpr const char* kSpeed = "/speed";

std::string range_name(const SonarConfig& sonar) {
  return fmt::format("/{}/max_range", sonar.name);
}

double number_in(const nlohmann::json& value, const std::string& name) {
  if (!value.is_number()) {
    throw Error(fmt::format("{} must be a number", printable(name)));
  }
  return value.get<double>();
}

}  // namespace

nlohmann::json foxglove_parameters(Hub& hub, const std::vector<std::string>& names) {
  nlohmann::json parameters = nlohmann::json::array();
  const auto add = [&](const std::string& name, nlohmann::json value) {
    if (names.empty() || std::ranges::find(names, name) != names.end()) {
      const bool is_number = value.is_number();
      parameters.push_back({{"name", name}, {"value", std::move(value)}});
      if (is_number) {
        parameters.back()["type"] = "float64";  // Else clients take whole numbers for integers.
      }
    }
  };
  const LiveState state = hub.source().state();
  add(kPaused, state.paused);
  add(kSpeed, state.speed);
  if (hub.source().simulation() != nullptr && hub.ready()) {
    for (const SonarConfig& sonar : hub.world().sonars) {
      add(range_name(sonar), sonar.max_range);
    }
  }
  return parameters;
}

void set_foxglove_parameter(Hub& hub, const nlohmann::json& parameter, LiveLoop::Done done) {
  const std::string name = text_of(parameter, "name");
  const nlohmann::json& value = member(parameter, "value");
  PingSource& source = hub.source();
  if (name == kPaused) {
    if (!value.is_boolean()) {
      throw Error("/paused must be true or false");
    }
    source.pause(value.get<bool>());
    return done("");
  }
  if (name == kSpeed) {
    source.set_speed(number_in(value, name));
    return done("");
  }
  if (source.simulation() != nullptr && hub.ready()) {
    const auto& sonars = hub.world().sonars;
    const auto sonar = std::ranges::find(sonars, name, range_name);
    if (sonar != sonars.end()) {
      return source.simulation()->set(
          {fmt::format("sonars[{}].max_range={}", sonar - sonars.begin(), number_in(value, name))}, std::move(done));
    }
  }
  throw Error(fmt::format("there is no parameter {}", printable(name)));
}

}  // namespace insonify
