// describe_scenario.cpp -- every key of a scenario with its unit, limits and default, read off the configurations.

#include <fmt/format.h>

#include <algorithm>

#include "insonify/describe.h"
#include "insonify/scenario.h"
#include "insonify/words.h"
#include "io/scenario/preset_choice.h"
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
    if (is_orientation(field)) {
      section.keys.push_back({quaternion_name_of(field), "", "four numbers", kNoDefault,
                              fmt::format("Instead of {}: a unit quaternion, [w, x, y, z].", file_name_of(field))});
    }
  });
}

// An entry of a part with its defaults: the struct itself, or one element of an optional, a list or a map.
template <typename Member>
auto entry_of(const Member& member) {
  if constexpr (requires { typename Member::mapped_type; }) {
    return typename Member::mapped_type{};
  } else if constexpr (requires { typename Member::value_type; }) {
    return typename Member::value_type{};
  } else {
    return member;
  }
}

template <typename Config>
void add_sections(std::string name, std::string help, const Config& defaults,
                  std::vector<SectionDescription>& sections) {
  SectionDescription section{std::move(name), std::move(help), {}};
  if constexpr (std::is_same_v<Config, SonarConfig>) {
    add_keys(section, PresetChoice());
  }
  add_keys(section, defaults);
  if constexpr (std::is_same_v<Config, Scenario>) {
    std::ranges::find(section.keys, "engine", &KeyDescription::key)->allowed =
        fmt::format("{}", fmt::join(engine_names(), ", "));
  }
  if constexpr (HasParts<Config>) {
    Config::visit_parts(defaults, [&](const Part& part, const auto&) {
      section.keys.push_back({std::string(part.name), "", std::string(part.kind), kNoDefault, std::string(part.help)});
    });
  }
  sections.push_back(std::move(section));
  if constexpr (HasParts<Config>) {
    Config::visit_parts(defaults, [&](const Part& part, const auto& member) {
      if (!part.about.empty()) {
        add_sections(std::string(part.name), std::string(part.about), entry_of(member), sections);
      }
    });
  }
}

}  // namespace

std::vector<SectionDescription> describe_scenario() {
  std::vector<SectionDescription> sections;
  add_sections("scenario",
               "The keys of the file itself. Only `sonars` must be there, and `world`, `points` or `surface`.",
               Scenario(), sections);
  return sections;
}

}  // namespace insonify
