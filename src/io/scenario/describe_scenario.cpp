// describe_scenario.cpp -- every key of a scenario with its unit, limits and default, read off the configurations.

#include <fmt/format.h>

#include <algorithm>

#include "insonify/describe.h"
#include "insonify/scenario.h"
#include "io/file/yaml_words.h"

namespace insonify {
namespace {

constexpr const char* kNoDefault = "-";

std::string number(double value) {
  return fmt::format("{:.10g}", value);
}

// What may be written for a member, and what stands for its default.
struct Texts {
  std::string allowed, default_value;
};

Texts texts_of(const Field& field, double member) {
  const double scale = file_scale_of(field);
  return {field.limits.text(scale), number(member * scale)};
}
Texts texts_of(const Field& field, int member) {
  return {"whole, " + field.limits.text(), fmt::to_string(member)};
}
Texts texts_of(const Field& field, std::uint64_t member) {
  return {"whole, " + field.limits.text(), fmt::to_string(member)};
}
Texts texts_of(const Field& /*field*/, bool member) {
  return {"true, false", member ? "true" : "false"};
}
Texts texts_of(const Field& /*field*/, const std::string& member) {
  return {"text", member.empty() ? kNoDefault : member};
}
Texts texts_of(const Field& /*field*/, const std::filesystem::path& /*member*/) {
  return {"file", kNoDefault};
}
Texts texts_of(const Field& field, const Vec3& member) {
  const double scale = file_scale_of(field);
  return {"three numbers", fmt::format("[{}, {}, {}]", number(member.x() * scale), number(member.y() * scale),
                                       number(member.z() * scale))};
}
Texts texts_of(const Field& field, const std::vector<double>& /*member*/) {
  return {"list of numbers " + field.limits.text(file_scale_of(field)), kNoDefault};
}
Texts texts_of(const Field& field, const std::optional<double>& /*member*/) {
  return {field.limits.text(file_scale_of(field)), kNoDefault};
}
template <typename Enum>
requires std::is_enum_v<Enum> Texts texts_of(const Field& /*field*/, const Enum& member) {
  Texts texts;
  for (const auto& [word, meaning] : words_of<Enum>()) {
    texts.allowed += fmt::format("{}{}", texts.allowed.empty() ? "" : ", ", word);
    texts.default_value = meaning == member ? std::string(word) : texts.default_value;
  }
  return texts;
}

template <typename Config>
void add_keys(SectionDescription& section, const Config& defaults = {}) {
  Config::visit_fields(defaults, [&](const Field& field, const auto& member) {
    const Texts texts = texts_of(field, member);
    section.keys.push_back({file_name_of(field), std::string(file_unit_of(field)), texts.allowed, texts.default_value,
                            std::string(field.help)});
  });
}

template <typename Config>
SectionDescription section_of(std::string name, std::string help, const Config& defaults = {}) {
  SectionDescription section{std::move(name), std::move(help), {}};
  add_keys(section, defaults);
  return section;
}

// Keys that hold another part.
KeyDescription part(const std::string& key, const std::string& allowed, const std::string& help) {
  return {key, "", allowed, kNoDefault, help};
}

SectionDescription scenario_section() {
  auto section = section_of(
      "scenario", "The keys of the file itself. Only `sonars` must be there, and `world`, `points` or `surface`.",
      Scenario());
  std::ranges::find(section.keys, "engine", &KeyDescription::key)->allowed =
      fmt::format("{}", fmt::join(engine_names(), ", "));
  add_keys(section, MaterialRules());
  section.keys.push_back(part("water", "map", "The water: see `water`."));
  section.keys.push_back(part("materials", "map of names", "What surfaces are made of: see `materials`."));
  section.keys.push_back(part("sonars", "list, at least one", "The sonars: see `sonars`."));
  section.keys.push_back(part("receiver", "map", "What the receiver adds: see `receiver`."));
  section.keys.push_back(part("paper", "map", "The paper model's settings: see `paper`."));
  section.keys.push_back(part("surface", "map", "The water's surface, none where not named: see `surface`."));
  section.keys.push_back(part("points", "list", "Ideal point targets (calibrated model): see `points`."));
  section.keys.push_back(
      part("interferers", "list", "Other sonars that are heard (calibrated model): see `interferers`."));
  section.keys.push_back(part("trajectory", "list of waypoints", "How the vehicle moves: see `trajectory`."));
  section.keys.push_back(part("motions", "list", "What else moves: see `motions`."));
  section.keys.push_back(part("view", "map", "The camera of the picture of the scene: see `view`."));
  return section;
}

SectionDescription sonars_section() {
  SectionDescription section{
      "sonars",
      "One entry for each sonar. The keys beside `preset` override it; without one, the defaults "
      "below hold. With a preset, `bin_count` and `ping_period` follow from the range unless given.",
      {}};
  section.keys.push_back(part("preset", "text", "Instrument to start from: `insonify sonars` lists them."));
  section.keys.push_back(part("mode", "text", "Mode of the preset; its own default when absent."));
  add_keys(section, SonarConfig());
  section.keys.push_back(part("sampling", "map", "How finely the fan is sampled: see `sampling`."));
  return section;
}

}  // namespace

std::vector<SectionDescription> describe_scenario() {
  std::vector<SectionDescription> sections;
  sections.push_back(scenario_section());
  sections.push_back(section_of("water", "The water, alike everywhere.", Water()));
  sections.push_back(section_of<MaterialOverride>(
      "materials",
      "One entry for each name of a visual or a material: `hull: steel` or `hull: {like: steel, reflectivity: 0.9}`."));
  sections.push_back(sonars_section());
  sections.push_back(
      section_of("sampling", "Part of a sonar. More samples resolve finer detail and take more time.", Sampling()));
  sections.push_back(section_of("receiver", "What the receiver adds, in every model.", ReceiverConfig()));
  sections.push_back(section_of("paper", "Settings of the paper model.", PaperModel()));
  sections.push_back(
      section_of("trajectory",
                 "One entry for each waypoint, in order of time. Between two, the vehicle moves straight and "
                 "turns evenly; before the first and after the last it stands still.",
                 Waypoint()));
  sections.push_back(section_of("surface", "The water's surface above the sonar, a rough mirror.", SeaSurface()));
  sections.push_back(section_of("points", "One entry for each ideal point target (calibrated model).", PointTarget()));
  sections.push_back(
      section_of("interferers", "One entry for each other sonar that is heard (calibrated model).", Interferer()));
  auto motions = section_of("motions", "One entry for each object of the world that moves.", Motion());
  motions.keys.push_back(part("trajectory", "list of waypoints", "Where the object is: as `trajectory`."));
  sections.push_back(motions);
  sections.push_back(section_of(
      "view", "The camera of the picture of the scene. Without it, one that shows the first sonar's field is chosen.",
      ViewConfig()));
  return sections;
}

}  // namespace insonify
