// viewer_texts.cpp -- writes the viewer's text messages as JSON.

#include "serve/viewer_texts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "insonify/files.h"
#include "insonify/picture.h"
#include "insonify/recording_formats.h"
#include "insonify/version.h"
#include "insonify/words.h"
#include "serve/json_messages.h"

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

// The control of a member; nothing for texts, lists and vectors.
template <typename Member>
void put(const std::string& path, const Field& field, const Member& member, Json& keys) {
  Json entry;
  if constexpr (requires { member.has_value(); }) {
    put(path, field, member.value_or(typename Member::value_type{}), keys);
    keys[path]["optional"] = true;
    if (!member) {
      keys[path]["value"] = nullptr;
    }
    return;
  } else if constexpr (std::is_same_v<Member, bool>) {
    entry = {{"value", member}, {"kind", "switch"}};
  } else if constexpr (std::is_same_v<Member, EnumWord>) {
    entry = {{"value", member.text()}, {"kind", "word"}, {"choices", member.list->words}};
  } else if constexpr (std::is_integral_v<Member>) {
    entry = {{"value", member}, {"kind", "whole number"}};
    put_limits(field, entry);
  } else if constexpr (std::is_floating_point_v<Member>) {
    entry = {{"value", member * file_scale_of(field)}, {"kind", "number"}};
    put_limits(field, entry);
  } else {
    return;
  }
  entry["help"] = field.help;
  entry["unit"] = file_unit_of(field);
  keys[path] = entry;
}

void put_fields(const std::string& object, ConstSettings settings, ActsIn idle, Json& keys) {
  for (const FieldEntry& field : settings.table->fields) {
    if (field.acts != idle) {
      const std::string path = (object.empty() ? "" : object + ".") + file_name_of(field);
      field.get(settings.config, [&](const auto& member) { put(path, field, member, keys); });
    }
  }
}

// Settings with their values and limits, for the page's controls, by their `--set` paths: {"sonars[0].max_range":
// {"value": 30, "least": 0, "most": 100000, "help": ..., "unit": "m"}}. Without those that have no effect in the
// scenario's model.
Json scenario_keys(const Scenario& scenario) {
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

Json sonar_json(const LiveWorld& world, int index, const ShownLevels& levels) {
  const SonarConfig& sonar = world.sonars[static_cast<std::size_t>(index)];
  Json azimuths = Json::array();
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    azimuths.push_back(degrees_from_radians(sonar.beam_azimuth(beam)));
  }
  Json edges = Json::array();
  for (const double edge : sonar.bearings().edges()) {
    edges.push_back(degrees_from_radians(edge));
  }
  const bool calibrated = world.scenario.model == EchoModel::kCalibrated;
  return {{"name", sonar.name},
          {"model", sonar.model},
          {"type", word_of(sonar.type)},
          {"product", word_of(sonar.product())},
          {"mounting", word_of(sonar.head.mounting)},
          {"beams", sonar.beam_count},
          {"bins", sonar.bin_count},
          {"min_range", sonar.min_range},
          {"dead_range", std::max(sonar.dead_range, sonar.blanking_range)},
          {"max_range", sonar.max_range},
          {"azimuths", azimuths},
          {"azimuth_edges", edges},
          {"elevation_aperture", degrees_from_radians(sonar.elevation_aperture)},
          {"elevation_center", degrees_from_radians(sonar.middle_elevation())},
          {"azimuth_aperture", degrees_from_radians(sonar.azimuth_aperture)},
          {"step", degrees_from_radians(sonar.head.step)},
          {"sector_center", degrees_from_radians(sonar.head.sector_center)},
          {"sector_width", degrees_from_radians(sonar.head.sector_width)},
          {"gain_db", 10 * std::log10(sonar.gain)},
          {"period", *sonar.ping_period},
          {"reference", calibrated ? "dB re source at 1 m" : "dB re full scale"},
          {"levels", {levels.first, levels.second}},
          {"shown_gain", shown_gain(world, index)}};
}

// The name to show for a material: an object that was given another's has that name, not its own.
std::string shown_material(const LiveWorld& world, const std::string& name) {
  const auto found = world.scenario.materials.overrides.find(name);
  if (found == world.scenario.materials.overrides.end() ||
      std::ranges::find(world.scene.instances, name, &Instance::name) == world.scene.instances.end()) {
    return name;
  }
  bool changed = found->second.like.empty();
  MaterialOverride::visit_fields(found->second, [&](const Field& /*field*/, const auto& member) {
    if constexpr (requires { member.has_value(); }) {
      changed = changed || member.has_value();
    }
  });
  return changed ? name : found->second.like;
}

constexpr double kDepth = 50;                 // From the darkest to the brightest level [dB].
constexpr std::size_t kMostKept = 4'000'000;  // Intensities.

// Number of pings from one end of the scanned sector to the other.
std::size_t pings_of_turn(const SonarConfig& sonar) {
  if (!sonar.scans() || sonar.head.step == 0) {
    return 1;
  }
  return static_cast<std::size_t>(std::ceil(sonar.head.sector_width / std::abs(sonar.head.step)));
}

}  // namespace

std::string hello_text(const LiveWorld& world, const std::vector<ShownLevels>& levels, const Playback* playback) {
  Json sonars = Json::array();
  for (std::size_t i = 0; i < world.sonars.size(); ++i) {
    sonars.push_back(sonar_json(world, static_cast<int>(i), levels[i]));
  }
  Json objects = Json::array(), object_materials = Json::array(), materials = Json::array(), library = Json::array();
  for (const Instance& instance : world.scene.instances) {
    objects.push_back(instance.name);
    object_materials.push_back(instance.materials.empty() ? -1 : instance.materials[0]);
  }
  for (const Material& material : world.scene.materials) {
    materials.push_back(shown_material(world, material.name));
  }
  for (const Material& material : material_library()) {
    library.push_back(material.name);
  }
  for (const auto& [name, change] : world.scenario.materials.overrides) {
    if (find_material(name) == nullptr && change.like != name) {
      library.push_back(name);
    }
  }
  Json trajectory = Json::array();
  for (const Waypoint& waypoint : world.trajectory.waypoints) {
    trajectory.push_back(listed(waypoint.position));
  }
  const Json recording = playback == nullptr ? Json()
                                             : Json{{"first_time", playback->first_time()},
                                                    {"last_time", playback->last_time()},
                                                    {"pings", playback->ping_count()}};
  Json formats = Json::array();
  for (const RecordingFormat& format : recording_formats()) {
    formats.push_back({format.name, format.title});
  }
  return dumped({{"op", "hello"},
                 {"version", kVersion},
                 {"scenario_name", playback == nullptr ? world.scenario.file.stem().string() : playback->name()},
                 {"recording", recording},
                 {"record_formats", formats},
                 {"change", world.change},
                 {"sonars", sonars},
                 {"objects", objects},
                 {"materials", materials},
                 {"object_materials", object_materials},
                 {"library", library},
                 {"presets", playback == nullptr ? preset_names() : std::vector<std::string>()},
                 {"trajectory", trajectory},
                 {"keys", scenario_keys(world.scenario)}});
}

std::string state_text(const LiveState& state, const ServerCounts& counts, const std::string& sonar,
                       std::uint64_t dropped) {
  return dumped({{"op", "state"},
                 {"paused", state.paused},
                 {"follow", state.follows},
                 {"speed", state.speed},
                 {"sonar", sonar},
                 {"recording", state.recording.empty() ? Json() : Json(state.recording)},
                 {"recorded_pings", state.recorded_pings},
                 {"pings_per_second", std::round(counts.pings_per_second * 100) / 100},
                 {"ms_per_ping", std::round(counts.ms_per_ping * 100) / 100},
                 {"dropped", dropped},
                 {"clients", counts.clients},
                 {"pings_since_change", state.pings_since_change},
                 {"time", state.time},
                 {"preparing", state.preparing}});
}

std::string levels_text(const std::string& sonar, const ShownLevels& levels) {
  return dumped({{"op", "levels"}, {"sonar", sonar}, {"levels", {levels.first, levels.second}}});
}
std::string error_text(const std::string& text, const std::string& of) {
  return dumped({{"op", "error"}, {"text", text}, {"of", of}});
}
std::string note_text(const std::string& text) {
  return dumped({{"op", "note"}, {"text", text}});
}
std::string closing_text(const std::string& reason) {
  return dumped({{"op", "closing"}, {"reason", reason}});
}
std::string saved_text(const std::string& yaml) {
  return dumped({{"op", "saved"}, {"yaml", yaml}, {"path", nullptr}});
}

double shown_gain(const LiveWorld& world, int sonar) {
  const Scenario& scenario = world.scenario;
  return usual_display(scenario.model, scenario.receiver_of(world.sonars[static_cast<std::size_t>(sonar)]))
      .raised_per_decade;
}

bool ShownScale::add(const LivePing& live) {
  if (complete_) {
    return false;
  }
  const SonarConfig& sonar = live.world->sonars[static_cast<std::size_t>(live.sonar)];
  const Ping raised = raised_by_range(live.ping, sonar, shown_gain(*live.world, live.sonar));
  const std::vector<float> to_fit = intensities_to_fit(raised, sonar);
  intensities_.insert(intensities_.end(), to_fit.begin(), to_fit.end());
  ++pings_;
  complete_ = pings_ >= pings_of_turn(sonar) || intensities_.size() > kMostKept;
  // Refits at the 1st, 2nd, 4th, 8th ... ping, at the end, and when an echo is far louder than all
  // before.
  const double alone = fitting_full_scale(to_fit);
  if (!complete_ && !std::has_single_bit(pings_) && alone <= full_scale_) {
    return false;
  }
  full_scale_ = fitting_full_scale(intensities_);
  if (complete_) {
    intensities_ = {};
  }
  const double high = 10 * std::log10(full_scale_);
  const std::optional<ShownLevels> before = std::exchange(levels_, ShownLevels(high - kDepth, high));
  return before != levels_;
}

}  // namespace insonify
