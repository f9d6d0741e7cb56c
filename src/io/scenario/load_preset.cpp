// load_preset.cpp -- reads instruments from presets/*.yaml: each number with its confidence and source.

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "base/names.h"
#include "insonify/files.h"
#include "io/file/input_file.h"
#include "io/scenario/preset_file.h"
#include "io/scenario/yaml_read.h"

namespace insonify {
namespace {

using Kind = YamlValue::Kind;

constexpr double kReferenceSoundSpeed = 1500;  // Of the presets' ranges and rates [m/s].

YamlValue preset_tree(const std::filesystem::path& file) {
  YamlValue tree = parse_yaml(read_text(file), file.string());
  require_map(tree, "the preset", "a map of keys such as title");
  check_keys(tree, "", std::vector<std::string>{"title", "default_mode", "sampling", "sources", "common", "modes"});
  return tree;
}

const YamlValue& required(const YamlValue& map, std::string_view object, std::string_view key) {
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
    std::vector<std::string> keys = keys_of(table_of<SonarConfig>(), false);
    const std::vector<std::string> more = keys_of(table_of<Instrument>());
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
  }

  static std::string unit_of(const std::string& key) {
    std::string unit;
    for (const SettingsTable* table : {&table_of<SonarConfig>(), &table_of<Instrument>()}) {
      for (const FieldEntry& field : table->fields) {
        unit = file_name_of(field) == key ? file_unit_of(field) : unit;
      }
    }
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
    std::error_code ignored;  // A missing folder holds no presets.
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
  preset.sonar.model = preset.title;  // Without its mode: titles show the frequency too.
  preset.fit_to_range(preset.sonar, kReferenceSoundSpeed);
  with_place({preset.file.string(), 1, 1}, [&] { preset.sonar.validate(name); });
  return preset;
}

}  // namespace insonify
