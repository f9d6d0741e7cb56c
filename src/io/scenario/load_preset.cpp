// load_preset.cpp -- instruments from presets/*.yaml: each number with its confidence and source.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/nearest_name.h"
#include "insonify/files.h"
#include "io/file/input_file.h"
#include "io/scenario/preset_file.h"
#include "io/scenario/preset_folder.h"
#include "io/scenario/yaml_read.h"

namespace insonify {
namespace {

using Kind = YamlValue::Kind;

constexpr double kReferenceSoundSpeed = 1500;  // [m/s], that the presets' own ranges and rates are told for.

YamlValue preset_tree(const std::filesystem::path& file) {
  YamlValue tree = parse_yaml(read_text(file), file.string());
  require_map(tree, "the preset", "a map of keys such as title");
  check_keys(tree, "", std::vector<std::string>{"title", "default_mode", "sampling", "sources", "common", "modes"});
  return tree;
}

const YamlValue& required(const YamlValue& map, const std::string& object, const std::string& key) {
  const YamlValue* value = map.find(key);
  if (value == nullptr) {
    throw Error(object, key, " is missing").at(map.place);
  }
  return *value;
}

std::string required_text(const YamlValue& map, const std::string& object, const std::string& key) {
  std::string text;
  read_member(required(map, object, key), object, Field{key, "", {}, ""}, text);
  return text;
}

std::vector<std::string> modes_of(const YamlValue& tree) {
  const YamlValue& modes = required(tree, "", "modes");
  require_map(modes, "modes", "a map of modes, at least one");
  std::vector<std::string> names;
  for (const auto& [mode, facts] : modes.entries) {
    names.push_back(mode);
  }
  return names;
}

void require_mode(const std::string& preset, const std::string& mode, std::span<const std::string> modes) {
  if (std::ranges::find(modes, mode) == modes.end()) {
    throw Error(
        fmt::format("{} is not a mode of {}, which has {}", quoted_text(mode), preset, fmt::join(modes, " and ")));
  }
}

// Collects the facts of the parts of a file; those of a later part replace those of an earlier one.
class FactReader {
 public:
  std::vector<PresetFact> facts;
  YamlValue values;  // By key, as SonarConfig and Instrument read them.

  explicit FactReader(const YamlValue& sources) : sources_(sources) {
    require_map(sources, "sources", "a map of sources by a short name");
    values.kind = Kind::kMap;
  }

  void add_all(const YamlValue& part, const std::string& object) {
    require_map(part, object, "a map of facts such as frequency");
    check_keys(part, object, known_keys());
    for (const auto& [key, fact] : part.entries) {
      add(key, fact, member_name(object, key));
    }
  }

 private:
  static std::vector<std::string> known_keys() {
    std::vector<std::string> keys = field_keys_of<SonarConfig>();
    const std::vector<std::string> more = field_keys_of<Instrument>();
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
  }

  static std::string unit_of(const std::string& key) {
    std::string unit;
    const auto note_unit = [&](const Field& field, const auto&) {
      if (file_name_of(field) == key) {
        unit = file_unit_of(field);
      }
    };
    const SonarConfig sonar;
    const Instrument instrument;
    SonarConfig::visit_fields(sonar, note_unit);
    Instrument::visit_fields(instrument, note_unit);
    return unit;
  }

  // The source's full text, with the fact's own note.
  std::string source_of(const YamlValue& fact, const std::string& name) const {
    const std::string short_name = required_text(fact, name, "source");
    std::vector<std::string> known;
    for (const auto& [known_name, text] : sources_.entries) {
      known.push_back(known_name);
    }
    if (sources_.find(short_name) == nullptr) {
      throw Error(
          name, "source",
          fmt::format(" = {} is not one of the sources{}", quoted_text(short_name), suggestion(short_name, known)))
          .at(fact.place);
    }
    const std::string text = required_text(sources_, "sources", short_name);
    return fact.find("note") == nullptr ? text : fmt::format("{}: {}", text, required_text(fact, name, "note"));
  }

  void add(const std::string& key, const YamlValue& fact, const std::string& name) {
    require_map(fact, name, "a map of the keys value, confidence and source");
    check_keys(fact, name, std::vector<std::string>{"value", "confidence", "source", "note"});
    YamlValue value = required(fact, name, "value");
    const std::string confidence = required_text(fact, name, "confidence");
    if (confidence != "A" && confidence != "B" && confidence != "C") {
      throw Error(name, "confidence", fmt::format(" = {} must be A, B or C", quoted_text(confidence))).at(fact.place);
    }
    const PresetFact read{key, value.kind == Kind::kScalar ? value.scalar : value.shown(), unit_of(key), confidence,
                          source_of(fact, name)};
    value.place = fact.place;
    if (YamlValue* earlier = values.find(key)) {
      *earlier = value;
      *std::ranges::find(facts, key, &PresetFact::field) = read;
    } else {
      values.entries.push_back(YamlValue::Entry{key, value});
      facts.push_back(read);
    }
  }

  const YamlValue& sources_;
};

void check_pulse_table(const Preset& preset) {
  const std::vector<double>& ranges = preset.instrument.pulse_ranges;
  const std::size_t durations = preset.instrument.pulse_durations.size();
  if (ranges.size() != durations) {
    throw Error(
        preset.name, "pulse_durations",
        fmt::format(" has {} values, must have one for each of the {} of pulse_ranges", durations, ranges.size()));
  }
  if (std::ranges::adjacent_find(ranges, std::ranges::greater_equal()) != ranges.end()) {
    throw Error(preset.name, "pulse_ranges", fmt::format(" = [{:g}] must rise", fmt::join(ranges, ", ")));
  }
}

double linear_in(const std::vector<double>& places, const std::vector<double>& values, double place) {
  const auto above = std::ranges::upper_bound(places, place) - places.begin();
  if (above == 0 || above == std::ssize(places)) {
    return above == 0 ? values.front() : values.back();
  }
  const double part = (place - places[above - 1]) / (places[above] - places[above - 1]);
  return std::lerp(values[above - 1], values[above], part);
}

// Bits and range of the counts: the smallest depth from 8 to 16 bits that the instrument delivers, and its dynamic
// range if known.
void fill_in_counts(Preset& preset) {
  const std::vector<double>& depths = preset.instrument.bit_depths;
  const auto usual = std::ranges::find_if(depths, [](double bits) { return bits >= 8 && bits <= 16; });
  if (usual != depths.end()) {
    preset.sonar.bits = static_cast<int>(*usual);
  }
  preset.sonar.mapping_range_db = preset.instrument.dynamic_range_db.value_or(preset.sonar.mapping_range_db);
}

}  // namespace

std::vector<std::string> preset_names() {
  std::set<std::string> names;
  for (const std::filesystem::path& folder : preset_folders()) {
    std::error_code ignored;  // A folder that is not there holds no presets.
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ".yaml") {
        names.insert(entry.path().stem().string());
      }
    }
  }
  return {names.begin(), names.end()};
}

void check_preset_name(const std::string& name) {
  const std::vector<std::string> names = preset_names();
  if (names.empty()) {
    throw Error(
        fmt::format("{} is not a preset; there are none in {}", quoted_text(name), preset_folders().back().string()));
  }
  if (!std::ranges::binary_search(names, name)) {
    // "gemini" has a large edit distance to "tritech-gemini-720i", but is a part of it.
    std::vector<std::string> holding_it = names;
    std::erase_if(holding_it,
                  [&](const auto& known) { return name.size() < 3 || known.find(name) == std::string::npos; });
    const std::string hint =
        holding_it.empty() ? suggestion(name, names)
                           : "; did you mean " + *std::ranges::min_element(holding_it, {}, &std::string::size) + "?";
    throw Error(fmt::format("{} is not a preset{}", quoted_text(name),
                            hint.empty() ? fmt::format("; there are {}", fmt::join(names, ", ")) : hint));
  }
}

void check_preset_mode(const std::string& name, const std::string& mode) {
  require_mode(name, mode, modes_of(preset_tree(find_preset_file(name))));
}

void Preset::fit_to_range(SonarConfig& fitted, double sound_speed) const {
  const double window = fitted.max_range - fitted.min_range;
  // The tolerance keeps a window of a whole number of bins from getting one more by rounding.
  const double wanted =
      instrument.range_resolution ? std::ceil(window / *instrument.range_resolution - 1e-6) : instrument.bin_limit;
  fitted.bin_count = std::clamp(static_cast<int>(std::min(wanted, 65536.0)), 1, instrument.bin_limit);
  if (!instrument.pulse_ranges.empty()) {
    constexpr double kMicro = 1e-6;  // Instruments count their pulses' durations in microseconds.
    const double duration = linear_in(instrument.pulse_ranges, instrument.pulse_durations, fitted.max_range);
    fitted.pulse_duration = std::max(1.0, std::round(duration / kMicro)) * kMicro;
  }
  fitted.ping_period.reset();
  if (instrument.ping_rate_limit && 1 / *instrument.ping_rate_limit > fitted.shortest_ping_period(sound_speed)) {
    fitted.ping_period = 1 / *instrument.ping_rate_limit;
  }
}

std::vector<Preset::Excess> Preset::exceeded_by(const SonarConfig& given) const {
  constexpr double kSlack = 1e-6;      // Tolerance for angles converted from degrees.
  constexpr double kOtherBand = 0.25;  // Instruments that can be tuned reach about that far.
  std::vector<Excess> excesses;
  if (!(given.max_range > given.min_range)) {
    return excesses;  // Which is an error of its own.
  }
  const auto tell = [&](bool exceeded, const char* field, const std::string& text) {
    if (exceeded) {
      excesses.push_back({field, text});
    }
  };
  const auto degrees = [](double angle) { return degrees_from_radians(angle); };
  tell(std::abs(given.frequency / sonar.frequency - 1) > kOtherBand, "frequency",
       fmt::format(" = {:.6g} Hz, and a {} transmits at {:.6g} Hz", given.frequency, title, sonar.frequency));
  tell(given.max_range > sonar.max_range * (1 + kSlack), "max_range",
       fmt::format(" = {:.6g} m, and a {} reaches {:.6g} m", given.max_range, title, sonar.max_range));
  tell(given.min_range < sonar.min_range * (1 - kSlack), "min_range",
       fmt::format(" = {:.6g} m, and a {} begins at {:.6g} m", given.min_range, title, sonar.min_range));
  tell(given.azimuth_aperture > sonar.azimuth_aperture * (1 + kSlack), "azimuth_aperture_deg",
       fmt::format(" = {:.6g}, and the fan of a {} has {:.6g} deg", degrees(given.azimuth_aperture), title,
                   degrees(sonar.azimuth_aperture)));
  tell(given.elevation_aperture > sonar.elevation_aperture * (1 + kSlack), "elevation_aperture_deg",
       fmt::format(" = {:.6g}, and the beams of a {} have {:.6g} deg", degrees(given.elevation_aperture), title,
                   degrees(sonar.elevation_aperture)));
  tell(given.beam_count > sonar.beam_count, "beam_count",
       fmt::format(" = {}, and a {} has {}", given.beam_count, title, sonar.beam_count));
  tell(given.bin_count > instrument.bin_limit, "bin_count",
       fmt::format(" = {}, and a {} has at most {}", given.bin_count, title, instrument.bin_limit));
  const double finest = instrument.range_resolution.value_or(given.bin_length());
  tell(given.bin_count > std::ceil((given.max_range - given.min_range) / finest - kSlack), "bin_count",
       fmt::format(" = {} makes bins of {:.4g} m, and those of a {} have at least {:.4g} m", given.bin_count,
                   given.bin_length(), title, finest));
  tell(instrument.ping_rate_limit && given.ping_period && *given.ping_period * *instrument.ping_rate_limit < 1 - kSlack,
       "ping_period",
       fmt::format(" = {:.4g} s, and a {} makes at most {:.4g} pings a second", given.ping_period.value_or(0), title,
                   instrument.ping_rate_limit.value_or(0)));
  const bool head = given.type == SonarType::kMechanicallyScanned && !instrument.steps.empty();
  const double least_step = head ? *std::ranges::min_element(instrument.steps) : 0;
  tell(head && std::abs(given.step) < least_step * (1 - kSlack), "step_deg",
       fmt::format(" = {:.4g}, and the head of a {} makes steps of at least {:.4g} deg", degrees(given.step), title,
                   degrees(least_step)));
  return excesses;
}

Preset load_preset(const std::string& name, const std::string& mode) {
  check_preset_name(name);
  Preset preset;
  preset.name = name;
  preset.file = find_preset_file(name);
  const YamlValue tree = preset_tree(preset.file);
  preset.title = required_text(tree, "", "title");
  preset.default_mode = required_text(tree, "", "default_mode");
  preset.modes = modes_of(tree);
  with_place(required(tree, "", "default_mode").place, [&] { require_mode(name, preset.default_mode, preset.modes); });
  require_mode(name, mode.empty() ? preset.default_mode : mode, preset.modes);

  FactReader reader(required(tree, "", "sources"));
  if (const YamlValue* common = tree.find("common")) {
    reader.add_all(*common, "common");
  }
  const std::string chosen = mode.empty() ? preset.default_mode : mode;
  reader.add_all(*tree.find("modes")->find(chosen), "modes." + chosen);
  preset.facts = reader.facts;

  Places places;
  read_fields(reader.values, "", preset.sonar, places);
  read_fields(reader.values, "", preset.instrument, places);
  if (const YamlValue* sampling = tree.find("sampling")) {
    read_section(*sampling, "sampling", preset.sonar.sampling, places);
  }
  with_place({preset.file.string(), 1, 1}, [&] { check_pulse_table(preset); });
  fill_in_counts(preset);
  preset.sonar.model = preset.title;  // Not its mode: the frequency stands beside it.
  preset.fit_to_range(preset.sonar, kReferenceSoundSpeed);
  with_place({preset.file.string(), 1, 1}, [&] { preset.sonar.validate(name); });
  return preset;
}

}  // namespace insonify
