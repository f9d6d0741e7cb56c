// describe_scenario.cpp -- every key of a scenario with its unit, limits and default, from the tables of the
// configurations.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "insonify/describe.h"
#include "insonify/scenario.h"
#include "io/scenario/file_choices.h"
#include "io/scenario/yaml_read.h"

namespace insonify {
namespace {

constexpr const char* kNoDefault = "-";

std::string number(double value) {
  return fmt::format("{:.10g}", value);
}

// The allowed values and the default of a member, as `describe` prints them.
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
Texts texts_of(const Field& field, const std::vector<int>& /*member*/) {
  return {"list of whole numbers " + field.limits.text(), kNoDefault};
}
Texts texts_of(const Field& /*field*/, const std::vector<std::string>& /*member*/) {
  return {"list of texts", kNoDefault};
}
template <typename Number>
Texts texts_of(const Field& field, const std::optional<Number>& /*member*/) {
  return {(std::is_integral_v<Number> ? "whole, " : "") + field.limits.text(file_scale_of(field)), kNoDefault};
}
Texts texts_of(const Field& /*field*/, const EnumWord& member) {
  return {fmt::format("{}", fmt::join(member.list->words, ", ")), std::string(member.text())};
}

void add_keys(SectionDescription& section, const SettingsTable& table) {
  for (const FieldEntry& field : table.fields) {
    const Texts texts = field.get(table.defaults, [&](const auto& member) { return texts_of(field, member); });
    section.keys.push_back({file_name_of(field), std::string(file_unit_of(field)), texts.allowed, texts.default_value,
                            std::string(field.help)});
    if (is_orientation(field)) {
      section.keys.push_back({quaternion_name_of(field), "", "four numbers", kNoDefault,
                              fmt::format("Instead of {}: a unit quaternion, [w, x, y, z].", file_name_of(field))});
    }
  }
}

void add_sections(std::string name, std::string help, const SettingsTable& table,
                  std::vector<SectionDescription>& sections) {
  SectionDescription section{std::move(name), std::move(help), {}};
  if (&table == &table_of<SonarConfig>()) {
    add_keys(section, table_of<PresetChoice>());
  }
  add_keys(section, table);
  if (&table == &table_of<Scenario>()) {
    std::ranges::find(section.keys, "engine", &KeyDescription::key)->allowed =
        fmt::format("{}", fmt::join(engine_choices(), ", "));
  }
  for (const PartEntry& part : table.parts) {
    section.keys.push_back({std::string(part.name), "", std::string(part.kind), kNoDefault, std::string(part.help)});
  }
  sections.push_back(std::move(section));
  for (const PartEntry& part : table.parts) {
    if (!part.about.empty()) {
      add_sections(std::string(part.name), std::string(part.about), *part.table, sections);
    }
  }
}

}  // namespace

std::vector<SectionDescription> describe_scenario() {
  std::vector<SectionDescription> sections;
  add_sections("scenario",
               "The keys of the file itself. Only `sonars` must be there, and `world`, `points` or `surface`.",
               table_of<Scenario>(), sections);
  return sections;
}

}  // namespace insonify
