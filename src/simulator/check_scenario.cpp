// check_scenario.cpp -- Scenario::validate(): checks a scenario's parts against each other.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "insonify/error.h"
#include "insonify/scenario.h"
#include "receiver/array/line_array.h"
#include "receiver/array/steering.h"
#include "simulator/check_speeds.h"

namespace insonify {
namespace {

// Rounds up to three digits, so that the limit in a message is itself allowed.
double rounded_up(double value) {
  const double digit = std::pow(10, std::floor(std::log10(value)) - 2);
  return std::ceil(value / digit) * digit;
}

// The depth of a sonar's water is that at which it starts, below the surface.
void check_water(const Scenario& scenario) {
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
    check_ping_period(object, sonars[i], water);
    if (scenario.model == EchoModel::kCalibrated) {
      static_cast<void>(steered_by_assumed_speed(sonars[i], water.true_sound_speed(), object));
    }
  }
}

// Checks that an array of this pattern and width exists.
template <typename MakeArray>
void check_array(const std::string& object, std::string_view key, BeamPattern pattern, const MakeArray& make_array) {
  if (pattern == BeamPattern::kTopHat) {
    return;
  }
  ArraySettings array;
  try {
    array = make_array();
  } catch (const Error& error) {
    throw Error(object, key, fmt::format(" = {}", error.what()));
  }
  array.validate(object);
}

// Arrays measure the sine of the bearing, which is ambiguous beyond 90 degrees.
void check_fan(const std::string& object, std::string_view key, std::string_view only, std::size_t index,
               const SonarConfig& sonar) {
  if (sonar.azimuth_aperture > std::numbers::pi) {
    throw Error(object, key,
                fmt::format(" must be {} for fans of more than 180 deg; sonars[{}] has {:.4g}", only, index,
                            degrees_from_radians(sonar.azimuth_aperture)),
                {fmt::format("sonars[{}].azimuth_aperture_deg", index)});
  }
}

void check_beams(const std::string& object, const ReceiverConfig& receiver, std::size_t index,
                 const SonarConfig& sonar) {
  if (receiver.azimuth_pattern != BeamPattern::kTopHat) {
    check_fan(object, "azimuth_pattern", "top_hat", index, sonar);
  }
  if (receiver.beam_shape == BeamShape::kCone) {
    check_fan(object, "beam_shape", "wedge", index, sonar);
  }
  check_array(object, "azimuth_pattern", receiver.azimuth_pattern, [&] { return azimuth_array(receiver, sonar); });
  const BeamPattern elevation = sonar.elevation_pattern_beside(receiver);
  check_array(object, "elevation_pattern", elevation,
              [&] { return line_array(elevation, receiver.side_lobe_db, sonar.elevation_aperture); });
  if (sonar.transmit_width || sonar.element_width) {
    check_fan(fmt::format("sonars[{}]", index), sonar.transmit_width ? "transmit_width_deg" : "element_width_deg",
              "absent", index, sonar);
  }
}

// Gains are applied in single precision, which overflows at 385 dB.
void check_gain(const std::string& object, const ReceiverConfig& receiver, std::size_t index, const SonarConfig& sonar,
                const Water& water) {
  constexpr double kMost = 300;
  const double range = sonar.bin_range(sonar.bin_count - 1);
  const double gain = receiver.gain_db(range, water.absorption_db_per_m_at(sonar.frequency));
  if (gain > kMost) {
    throw Error(
        object, receiver.time_varied_gain ? "time_varied_gain" : "gains_db",
        fmt::format(" comes to {:.4g} dB at {:.4g} m, the far end of sonars[{}]; must be at most {} dB: nothing "
                    "is left to raise there",
                    gain, range, index, kMost));
  }
}

// Checks each sonar with its receiver, in the calibrated model.
void check_receivers(const Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const SonarConfig& sonar = scenario.sonars[i];
    const ReceiverConfig& receiver = scenario.receiver_of(sonar);
    const std::string object = sonar.receiver ? fmt::format("sonars[{}].receiver", i) : "receiver";
    check_beams(object, receiver, i, sonar);
    if (scenario.primary == PrimaryEchoes::kRaster && !scenario.has_even_rows(sonar)) {
      throw Error(
          "", "primary",
          fmt::format(" = raster needs {0}.beam_shape = wedge and {0}.elevation_pattern = top_hat; auto or rays "
                      "takes any",
                      object));
    }
    check_gain(object, receiver, i, sonar, scenario.water_at(sonar));
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

void check_engine(const std::string& engine) {
  const std::vector<std::string_view> names = engine_names();
  if (std::ranges::find(names, engine) == names.end()) {
    throw Error("", "engine", fmt::format(" = \"{}\" must be {}", engine, fmt::join(names, " or ")));
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
  if (scenario.turns && std::ranges::none_of(scenario.sonars, [](const SonarConfig& sonar) {
        return sonar.type == SonarType::kMechanicallyScanned;
      })) {
    throw Error("", "turns", " needs a scanning sonar (type: msis), and there is none; duration or pings takes any");
  }
}

void check_view(const ViewConfig& view) {
  if (view.position == view.look_at) {
    throw Error("view", "look_at", " must differ from view.position", {"view.position"});
  }
}

}  // namespace

void Scenario::validate() const {
  check_fields("", *this);
  if (model == EchoModel::kPaper && !points.empty()) {
    throw Error("", "points", " need model = calibrated");
  }
  if (model == EchoModel::kPaper && !interferers.empty()) {
    throw Error("", "interferers", " need model = calibrated");
  }
  if (model == EchoModel::kPaper && !thrusters.empty()) {
    throw Error("", "thrusters", " need model = calibrated");
  }
  if (model == EchoModel::kPaper && mutual_interference) {
    throw Error("", "mutual_interference", " needs model = calibrated");
  }
  if (model == EchoModel::kPaper && (receiver.field || receiver.counts)) {
    throw Error("receiver", receiver.field ? "field" : "counts", " needs model = calibrated");
  }
  if (model == EchoModel::kPaper && motion_in_ping) {
    throw Error("", "motion_in_ping", " needs model = calibrated");
  }
  if (model == EchoModel::kPaper && rough_mirrors) {
    throw Error("", "rough_mirrors", " needs model = calibrated");
  }
  if (model == EchoModel::kPaper && random_walks > 0) {
    throw Error("", "random_walks", " needs model = calibrated");
  }
  check_walks(*this);
  if (model == EchoModel::kPaper && ground_truth == GroundTruth::kFull) {
    throw Error("", "ground_truth", " = full needs model = calibrated");
  }
  check_engine(engine);
  check_water(*this);
  receiver.validate();
  check_materials(materials);
  check_sonars(*this);
  check_length(*this);
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

}  // namespace insonify
