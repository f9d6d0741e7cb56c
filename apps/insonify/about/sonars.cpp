// sonars.cpp -- insonify sonars: lists the presets, or shows one in full.

#include <fmt/format.h>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "insonify/files.h"

namespace insonify {
namespace {

Row table_row(const Preset& preset, const std::string& mode, bool first) {
  const SonarConfig& sonar = preset.sonar;
  return {first ? preset.name : "",
          mode + (mode == preset.default_mode && preset.modes.size() > 1 ? " *" : ""),
          std::string(word_of(sonar.type)),
          fmt::format("{:.10g}", sonar.frequency / 1000),
          fmt::to_string(sonar.beam_count),
          fmt::format("{:.4g} x {:.4g}", degrees_from_radians(sonar.azimuth_aperture),
                      degrees_from_radians(sonar.elevation_aperture)),
          fmt::format("{:.4g} - {:.4g}", sonar.min_range, sonar.max_range)};
}

int list_all() {
  std::vector<Row> rows = {{"preset", "mode", "type", "kHz", "beams", "degrees", "range m"}};
  const std::vector<std::string> names = preset_names();
  if (names.empty()) {
    throw Error("there are no presets; INSONIFY_PRESETS names folders of them");
  }
  for (const std::string& name : names) {
    const std::vector<std::string> modes = load_preset(name).modes;
    for (const std::string& mode : modes) {
      rows.push_back(table_row(load_preset(name, mode), mode, mode == modes.front()));
    }
  }
  print_table(rows);
  say("\n* mode when none is named. fls: the whole fan at once; msis: one beam, turned; sss: side-scan, beams to "
      "port\nand starboard, as wide along the track as degrees says.\n"
      "insonify sonars PRESET shows the source of each number.\n");
  return kDone;
}

int print_preset(const std::string& name, const std::string& mode) {
  const Preset preset = load_preset(name, mode);
  say("{}: {}, mode {} (modes: {})\n{}\n\n", preset.name, preset.title, mode.empty() ? preset.default_mode : mode,
      fmt::format("{}", fmt::join(preset.modes, ", ")), preset.file.string());
  std::vector<Row> rows = {{"field", "value", "unit", "confidence", "source"}};
  for (const PresetFact& fact : preset.facts) {
    rows.push_back({fact.field, fact.value, fact.unit, fact.confidence, fact.source});
  }
  print_table(rows);
  const SonarConfig& sonar = preset.sonar;
  say("\nOver the whole range this gives {} bin{} of {:.4g} m and a ping every {:.4g} s; over a shorter one, finer "
      "bins\nand faster pings, until range_resolution and ping_rate_limit stop them.\n"
      "Confidence: A read in the source, B recalled from it and cross-checked, C uncertain.\n",
      sonar.bin_count, sonar.bin_count == 1 ? "" : "s", sonar.bin_length(),
      sonar.ping_period.value_or(sonar.shortest_ping_period(1500)));
  return kDone;
}

int sonars(const std::string& name, const std::string& mode) {
  return checked_input([&] {
    if (name.empty() && !mode.empty()) {
      throw Error(fmt::format("--mode {} belongs to a preset, and none is named", mode));
    }
    return name.empty() ? list_all() : print_preset(name, mode);
  });
}

}  // namespace

void add_sonars(const Command& program) {
  const Command command = program.add("sonars", "List the instruments with presets, or describe one");
  auto& preset = command.keep<std::string>();
  auto& mode = command.keep<std::string>();
  command.argument("PRESET", &preset, "Instrument to describe, with the source of each number", {}, false);
  command.option("--mode", "MODE", &mode, "Mode of it, such as low or high");
  command.footer(
      "Examples:\n"
      "  insonify sonars\n"
      "  insonify sonars blueprint-oculus-m750d --mode high\n\n"
      "Folders of your own presets, named in INSONIFY_PRESETS (separated by colons), add to the shipped ones.");
  command.act([&preset, &mode] { return sonars(preset, mode); });
}

}  // namespace insonify
