// check_scenario.cpp -- Scenario::validate(): checks a scenario's parts against each other.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "insonify/error.h"
#include "insonify/scenario.h"
#include "pattern/swath.h"
#include "receiver/array/steering.h"
#include "simulator/checks.h"

namespace insonify {
namespace {

// The depth of a sonar's water is that at which it starts, below the surface.
void check_water(const Scenario& scenario) {
  scenario.water.validate();
  for (std::size_t i = 0; scenario.surface && i < scenario.sonars.size(); ++i) {
    constexpr double kMost = 7000;
    const double depth = scenario.water_at(scenario.sonars[i]).depth;
    if (depth > kMost) {
      throw Error("surface", "level",
                  fmt::format(" = {:.7g} m puts sonars[{}] {:.7g} m deep; must be at most {:.7g} m",
                              scenario.surface->level, i, depth, kMost));
    }
  }
}

// Before a pattern is flown, the depth below a surface is not known, nor is the sound speed there.
bool depth_is_known(const Scenario& scenario) {
  return !scenario.pattern || !scenario.surface;
}

void check_profile_of(const Scenario& scenario) {
  if (scenario.primary == PrimaryEchoes::kRaster && !scenario.water.profile.empty()) {
    throw Error("", "primary", " = raster draws along straight rays; with water.profile it must be auto or rays",
                {"water.profile"});
  }
}

void check_ping_period(const std::string& object, const SonarConfig& sonar, const Water& water) {
  const double least = sonar.shortest_ping_period(sonar.assumed_sound_speed.value_or(water.true_sound_speed()));
  if (sonar.ping_period.has_value() && *sonar.ping_period < least) {
    throw Error(object, "ping_period",
                fmt::format(" = {:.10g} s must be at least {:.10g} s, the time sound takes to max_range = {:.10g} m "
                            "and back",
                            *sonar.ping_period, rounded_up(least), sonar.max_range),
                {object + ".max_range"});
  }
}

void check_sonars(const Scenario& scenario) {
  const std::vector<SonarConfig>& sonars = scenario.sonars;
  if (sonars.empty()) {
    throw Error("", "sonars", " must have at least one entry");
  }
  for (std::size_t i = 0; i < sonars.size(); ++i) {
    const std::string object = fmt::format("sonars[{}]", i);
    const auto same = std::ranges::find(sonars.begin(), sonars.begin() + i, sonars[i].name, &SonarConfig::name);
    if (same != sonars.begin() + i) {
      throw Error(object, "name",
                  fmt::format(" = \"{}\" must differ from that of sonars[{}]", sonars[i].name, same - sonars.begin()));
    }
    sonars[i].validate(object);
    if (sonars[i].receiver) {
      sonars[i].receiver->validate(object + ".receiver");
    }
    const Water water = scenario.water_at(sonars[i]);
    if (depth_is_known(scenario)) {
      check_ping_period(object, sonars[i], water);
    }
    if (scenario.model == EchoModel::kCalibrated) {
      static_cast<void>(steered_by_assumed_speed(sonars[i], water.true_sound_speed(), object));
    }
  }
}

// Spherical spreading has a pole where sonars coincide.
void check_mutual_interference(const Scenario& scenario) {
  constexpr double kNearest = 0.01;
  for (std::size_t i = 0; scenario.mutual_interference && i < scenario.sonars.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = (scenario.sonars[i].position - scenario.sonars[j].position).norm();
      if (distance < kNearest) {
        throw Error(fmt::format("sonars[{}]", i), "position",
                    fmt::format(" is {:.3g} m from that of sonars[{}]; with mutual_interference at least {} m",
                                distance, j, kNearest),
                    {"mutual_interference"});
      }
    }
  }
}

// Spherical spreading has a pole where a thruster is in a sonar.
void check_thrusters(const Scenario& scenario) {
  constexpr double kNearest = 0.01;
  for (std::size_t i = 0; i < scenario.thrusters.size(); ++i) {
    const std::string object = fmt::format("thrusters[{}]", i);
    scenario.thrusters[i].validate(object);
    for (std::size_t j = 0; j < scenario.sonars.size(); ++j) {
      const double distance = (scenario.thrusters[i].position - scenario.sonars[j].position).norm();
      if (distance < kNearest) {
        throw Error(object, "position",
                    fmt::format(" is {:.3g} m from that of sonars[{}]; must be at least {} m", distance, j, kNearest));
      }
    }
  }
}

void check_engine(const Scenario& scenario) {
  const std::vector<std::string_view> names = engine_choices();
  if (std::ranges::find(names, scenario.engine) == names.end()) {
    throw Error("", "engine", fmt::format(" = \"{}\" must be {}", scenario.engine, fmt::join(names, " or ")));
  }
}

void check_materials(const MaterialRules& rules) {
  for (const auto& [name, changes] : rules.overrides) {
    changes.relief_config.validate("materials." + name);
  }
}

// Walks hold the paths that secondary echoes leave out.
void check_walks(const Scenario& scenario) {
  if (scenario.random_walks > 0 && scenario.secondary == SecondaryEchoes::kNone) {
    throw Error("", "random_walks",
                fmt::format(" = {} needs secondary = selective or all, since it adds to these echoes; or 0 for none",
                            scenario.random_walks),
                {"secondary"});
  }
  if (scenario.random_walks > 0 && scenario.max_surfaces < kPathOrders) {
    throw Error("", "random_walks",
                fmt::format(" = {} needs max_surfaces = {}, not {}: the paths meet three surfaces and more",
                            scenario.random_walks, kPathOrders, scenario.max_surfaces),
                {"max_surfaces"});
  }
}

void check_motions(const std::vector<Motion>& motions) {
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const std::string object = fmt::format("motions[{}]", i);
    if (motions[i].object.empty()) {
      throw Error(object, "object", " is missing: the name of what moves");
    }
    if (motions[i].trajectory.waypoints.empty()) {
      throw Error(object, "trajectory", " must have at least one waypoint");
    }
    motions[i].trajectory.validate(object + ".trajectory");
  }
}

// At most one of `pings`, `duration` and `turns` may be given.
void check_length(const Scenario& scenario) {
  if (scenario.duration && scenario.turns) {
    throw Error("", "duration", " and turns both say when pings end; leave one out");
  }
  if ((scenario.duration || scenario.turns) && scenario.pings != Scenario().pings) {
    throw Error("", scenario.duration ? "duration" : "turns",
                fmt::format(" says when pings end, as pings = {} does; leave one out", scenario.pings));
  }
  if (scenario.turns && std::ranges::none_of(scenario.sonars, [](const SonarConfig& sonar) { return sonar.scans(); })) {
    throw Error("", "turns", " needs a scanning sonar (type: msis), and there is none; duration or pings takes any");
  }
}

void check_ping_spans(const Scenario& scenario) {
  const std::vector<PingSpan>& spans = scenario.ping_spans;
  if (!spans.empty() && scenario.mutual_interference) {
    throw Error("", "mutual_interference", " needs sonars that ping all the time, without ping_spans", {"ping_spans"});
  }
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const std::string object = fmt::format("ping_spans[{}]", i);
    if (!(spans[i].end > spans[i].begin)) {
      throw Error(object, "end",
                  fmt::format(" = {:.10g} s must be greater than begin = {:.10g} s", spans[i].end, spans[i].begin),
                  {object + ".begin"});
    }
    if (i > 0 && spans[i].begin < spans[i - 1].end) {
      throw Error(object, "begin",
                  fmt::format(" = {:.10g} s must be at least ping_spans[{}].end = {:.10g} s", spans[i].begin, i - 1,
                              spans[i - 1].end));
    }
  }
}

void check_pattern(const Scenario& scenario) {
  if (!scenario.pattern) {
    return;
  }
  if (!scenario.trajectory.waypoints.empty()) {
    throw Error("", "pattern", " and trajectory both move the vehicle; leave one out", {"trajectory"});
  }
  if (!scenario.ping_spans.empty() && scenario.pattern->lines.turns == TurnPings::kSkip) {
    throw Error("pattern.lines", "turns", " = skip and ping_spans both say when the sonars ping; leave one out");
  }
  if (scenario.mutual_interference && scenario.pattern->lines.turns == TurnPings::kSkip) {
    throw Error("", "mutual_interference", " needs sonars that ping all the time: pattern.lines.turns = ping",
                {"pattern.lines.turns"});
  }
  scenario.pattern->validate("pattern");
  (void)line_spacing(scenario.pattern->lines, scenario.sonars);
}

void check_view(const ViewConfig& view) {
  if (view.position == view.look_at) {
    throw Error("view", "look_at", " must differ from view.position", {"view.position"});
  }
}

// What the paper model does not have.
void check_calibrated_only(const Scenario& scenario) {
  if (scenario.model != EchoModel::kPaper) {
    return;
  }
  if (!scenario.points.empty()) {
    throw Error("", "points", " need model = calibrated");
  }
  if (!scenario.interferers.empty()) {
    throw Error("", "interferers", " need model = calibrated");
  }
  if (!scenario.thrusters.empty()) {
    throw Error("", "thrusters", " need model = calibrated");
  }
  if (scenario.mutual_interference) {
    throw Error("", "mutual_interference", " needs model = calibrated");
  }
  if (scenario.receiver.field || scenario.receiver.counts) {
    throw Error("receiver", scenario.receiver.field ? "field" : "counts", " needs model = calibrated");
  }
  if (scenario.motion_in_ping) {
    throw Error("", "motion_in_ping", " needs model = calibrated");
  }
  if (scenario.rough_mirrors) {
    throw Error("", "rough_mirrors", " needs model = calibrated");
  }
  if (scenario.random_walks > 0) {
    throw Error("", "random_walks", " needs model = calibrated");
  }
}

}  // namespace

void Scenario::validate() const {
  check_fields("", *this);
  check_calibrated_only(*this);
  check_walks(*this);
  if (model == EchoModel::kPaper && ground_truth == GroundTruth::kFull) {
    throw Error("", "ground_truth", " = full needs model = calibrated");
  }
  check_engine(*this);
  check_water(*this);
  check_profile_of(*this);
  receiver.validate();
  check_materials(materials);
  check_sonars(*this);
  check_length(*this);
  check_ping_spans(*this);
  check_pattern(*this);
  if (model == EchoModel::kCalibrated) {
    check_receivers(*this);
    check_mutual_interference(*this);
    check_thrusters(*this);
  }
  trajectory.validate("trajectory");
  if (motion_in_ping) {
    check_speeds(trajectory);
  }
  check_motions(motions);
  if (view.has_value()) {
    check_view(*view);
  }
}

std::size_t sonar_index(int sonar, std::size_t count) {
  if (sonar < 0 || static_cast<std::size_t>(sonar) >= count) {
    throw Error(fmt::format("sonar = {} must be from 0 to {}, the last", sonar, count - 1));
  }
  return static_cast<std::size_t>(sonar);
}

}  // namespace insonify
