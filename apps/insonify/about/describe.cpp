// describe.cpp -- insonify describe: documents every key of a scenario with its unit, limits and default.

#include "insonify/describe.h"

#include <fmt/format.h>

#include <algorithm>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"

namespace insonify {
namespace {

constexpr const char* kMarkdownHead =
    "# Scenario file\n\n"
    "A scenario is a YAML file that says what to simulate. `insonify describe` prints this page's tables; the page is "
    "made\n"
    "by `insonify describe --markdown`.\n\n"
    "```yaml\n"
    "world: seabed.obj                  # SDF world or model, mesh or height grid, from this file's folder\n"
    "sonars:\n"
    "  - preset: tritech-gemini-720i    # start from an instrument ...\n"
    "    max_range: 20                  # ... and change what you like\n"
    "    position: [0, 0, 5]\n"
    "    orientation_deg: [0, 15, 0]    # roll, pitch, yaw: positive pitch looks down\n"
    "pings: 10\n"
    "```\n\n"
    "Lengths are in metres, times in seconds, frequencies in hertz. Angles are in degrees, and their keys say so:\n"
    "`azimuth_aperture_deg`. An unknown key, a wrong type or a value out of limits is an error that names the line.\n\n"
    "`--set key=value` on the command line changes any of it: `--set pings=3`, `--set water.depth=4`,\n"
    "`--set sonars[0].max_range=30`, `--set sonars.fls.max_range=30` (by the sonar's name), and `--set max_range=30` "
    "for\n"
    "every sonar.\n";

std::string plain(std::string text) {
  std::erase(text, '`');
  return text;
}

void print_text(const SectionDescription& section) {
  say("{}: {}\n", section.name, plain(section.help));
  for (const KeyDescription& key : section.keys) {
    const bool has_default = key.default_value != "-";
    const std::string unit = key.unit.empty() ? "" : has_default ? " " + key.unit : " [" + key.unit + "]";
    const std::string named = fmt::format("  {}{}{}", key.key, has_default ? " = " + key.default_value : "", unit);
    say("{:<44}  {}\n      {}\n", named, key.allowed, plain(key.help));
  }
  say("\n");
}

void print_markdown(const SectionDescription& section) {
  say("\n## {}\n\n{}\n\n", section.name, section.help);
  say("| Key | Unit | Allowed | Default | Meaning |\n| --- | --- | --- | --- | --- |\n");
  for (const KeyDescription& key : section.keys) {
    const std::string anchor = section.name + "." + key.key;
    say("| <a id=\"{0}\" href=\"#{0}\">`{1}`</a> | {2} | {3} | {4} | {5} |\n", anchor, key.key, key.unit, key.allowed,
        key.default_value == "-" ? "" : "`" + key.default_value + "`", key.help);
  }
}

int describe(const std::string& wanted, bool markdown) {
  std::vector<SectionDescription> sections = describe_scenario();
  if (!wanted.empty()) {
    std::string names;
    for (const SectionDescription& section : sections) {
      names += (names.empty() ? "" : ", ") + section.name;
    }
    std::erase_if(sections, [&](const auto& section) { return section.name != wanted; });
    if (sections.empty()) {
      throw InputError(fmt::format("there is no section {}; there are {}", wanted, names));
    }
  } else if (markdown) {
    say_text(kMarkdownHead);
  }
  for (const SectionDescription& section : sections) {
    markdown ? print_markdown(section) : print_text(section);
  }
  return kDone;
}

}  // namespace

void add_describe(const Command& program) {
  const Command command = program.add("describe", "List every key of a scenario: unit, limits, default, meaning");
  auto& section = command.keep<std::string>();
  auto& markdown = command.keep<bool>();
  command.argument("SECTION", &section, "One section only: water, sonars, paper ...", {}, false);
  command.flag("--markdown", &markdown, "As a page of the manual");
  command.footer("Examples:\n  insonify describe\n  insonify describe sonars");
  command.act([&section, &markdown] { return describe(section, markdown); });
}

}  // namespace insonify
