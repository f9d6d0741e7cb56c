// run_options.cpp -- options of `insonify run`.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "console/commands.h"
#include "insonify/engine.h"
#include "run/run.h"

namespace insonify {
namespace {

// What the options of the command line are before they are those of run().
struct RunLine {
  RunOptions run;
  int pings = 1;
  double duration = 0, turns = 0;
  std::uint64_t seed = 1;
  std::string engine, device, record = "h5";
  bool strict = false, no_pictures = false, no_view = false;
};

std::vector<std::string> record_choices() {
  std::vector<std::string> choices;
  for (const RecordingFormat& format : recording_formats()) {
    choices.emplace_back(format.name);
  }
  return choices;
}

// The files of the formats, as the help lists them.
std::string recordings_text() {
  std::string text;
  for (const RecordingFormat& format : recording_formats()) {
    text += fmt::format("  {:<24} {}{}\n", "DIR/NAME" + format.ending(),
                        text.empty() ? "" : fmt::format("with --record {}, ", format.name), format.contents);
  }
  return text;
}

std::vector<std::string> engines() {
  const auto names = engine_choices();
  return {names.begin(), names.end()};
}

void add_input_options(const Command& command, RunLine& line) {
  RunOptions& options = line.run;
  command.argument("SCENARIO", &options.scenario, "Scenario file (YAML, or Stonefish's .scn)");
  command.option("-o,--output", "DIR", &options.folder, "Output folder, made if missing [SCENARIO's name + _pings]",
                 not_empty("a folder, or . for this one"));
  command.option("--pings", "N", &line.pings, "Pings of each sonar", whole_number(1, 1'000'000'000));
  command.option("--duration", "S", &line.duration, "Instead: ping from time 0 until this time [s]",
                 number_within(above_to(0, 1e9)));
  command.exclude("--duration", {"--pings"});
  command.option("--turns", "N", &line.turns, "Instead: full turns of a scanning head, or sweeps across its sector",
                 number_within(above_to(0, 1e6)));
  command.exclude("--turns", {"--pings", "--duration"});
  command.option(
      "--engine", "NAME", &line.engine,
      "Engine that computes the echoes: cpu, gpu (a graphics card), reference (slow), or auto: the faster of "
      "cpu and gpu",
      one_of(engines()));
  command.option("--device", "NAME", &line.device,
                 "Graphics card of engine gpu or auto: a part of its name, or its index");
  command.option("--seed", "N", &line.seed, "Start of the random numbers",
                 whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  command.flag("--strict", &line.strict, "End with an error if a part of the world is missing");
  command.option("--threads", "N", &options.threads, "Worker threads; 0: one per processor [0]", whole_number(0, 1024));
  command.option("--set", "KEY=VALUE", &options.settings,
                 "Change a key of the scenario, such as max_range=20; may be repeated");
}

void add_output_options(const Command& command, RunLine& line) {
  RunOptions& options = line.run;
  command.option("--record", "KIND", &line.record,
                 fmt::format("Recordings to make: {}, or several with commas: {} [{}]", recording_names("", ", "),
                             recording_names("", ","), line.record),
                 some_of(record_choices()));
  add_message_choice(command, options.messages, "in mcap recordings", "[1970]");
  command.flag("--compress", &options.compress,
               "Compress h5 recordings by HDF5's own filters: less than half the size, some time per ping");
  command.flag("-f,--force", &options.force, "Replace recordings and pictures of an earlier run");
  command.flag("-q,--quiet", &options.quiet, "Print only warnings and errors");

  const Command pictures = command.under("Pictures");
  pictures.option("--pictures", "N", &options.pictures.pictures, "Pings to draw: all, last, none or how many [20]");
  pictures.flag("--no-pictures", &line.no_pictures, "The same as --pictures none --no-view");
  pictures.flag("--view", &options.view, "Draw the scene as a camera sees it: the default");
  pictures.flag("--no-view", &line.no_view, "Do not draw the scene");
  pictures.flag("--channels", &options.channels, "Also draw distance and intensity by direction, at the first ping");
  add_picture_options(pictures, options.pictures);
  add_counts_option(pictures, options.pictures);
  add_waterfall_options(command.under("Waterfalls of side-scan sonars"), options.pictures);
}

// The settings and recordings that the line asks for.
RunOptions finished(const Command& command, RunLine line) {
  std::vector<std::string>& settings = line.run.settings;
  const auto set = [&](const char* key, const auto& value) {
    if (command.given(fmt::format("--{}", key))) {
      settings.push_back(fmt::format("--{}={}", key, value));
    }
  };
  set("pings", line.pings);
  set("duration", line.duration);
  set("turns", line.turns);
  set("engine", line.engine);
  set("device", line.device);
  set("seed", line.seed);
  set("strict", line.strict);
  line.run.record = record_kinds(line.record);
  if (line.no_pictures) {
    line.run.pictures.pictures = "none";
  }
  line.run.view = !line.no_view && !line.no_pictures;
  return line.run;
}

}  // namespace

RecordKinds record_kinds(const std::string& text) {
  RecordKinds kinds;
  for (const RecordingFormat& format : recording_formats()) {
    if (fmt::format(",{},", text).find(fmt::format(",{},", format.name)) != std::string::npos) {
      kinds.push_back(&format);
    }
  }
  return kinds;
}

std::vector<std::string> endings_of(const RecordKinds& kinds) {
  std::vector<std::string> endings;
  std::ranges::transform(kinds, std::back_inserter(endings), [](const auto* format) { return format->ending(); });
  return endings;
}

void add_run(const Command& program) {
  const Command command = program.add("run", "Simulate a scenario: pings into recordings and pictures");
  auto& line = command.keep<RunLine>();
  add_input_options(command, line);
  add_output_options(command, line);
  command.footer(
      "Writes, for each sonar NAME:\n" + recordings_text() +
      "  DIR/NAME_fan_0000.png    each ping as seen from above; NAME_polar_0000.png as a table\n"
      "  DIR/NAME_scan_0000.png   what a scanning sonar has seen up to a ping, instead\n"
      "  DIR/NAME_scan.png        the same at the end; NAME_polar.png its waterfall\n"
      "  DIR/NAME_waterfall.png   all pings of a side-scan sonar, instead\n"
      "  DIR/NAME_view.png        the scene, with the sonar and its field\n"
      "  DIR/NAME_channels.png    distance and intensity by direction, with --channels\n"
      "Files of an earlier run are replaced only with --force, once the new run has ended.\n\n"
      "Keys of --set: pings, water.depth, sonars[0].max_range, sonars.NAME.max_range, or max_range for every sonar;\n"
      "insonify describe lists them all.\n\n"
      "Examples:\n"
      "  insonify run scenes/sphere.yaml\n"
      "  insonify run scenes/ferry.yaml -o out --pings 3 --set max_range=30\n"
      "  insonify run scenes/tank.yaml -o tank --scale db --floor-db -40 --colour-map copper\n\n"
      "Ctrl-C ends a run and keeps the pings made so far; a second one ends the program at once.\n"
      "Exit status: 0 done, 1 failed while running or stopped, 2 wrong input.");
  command.act([command, &line] { return run(finished(command, line)); });
}

}  // namespace insonify
