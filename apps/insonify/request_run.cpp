// request_run.cpp -- options of `insonify run`.

#include <fmt/format.h>

#include <limits>

#include "console/validators.h"
#include "insonify/engine.h"
#include "request.h"

namespace insonify {
namespace {

std::vector<std::string> engines() {
  const auto names = engine_names();
  return {names.begin(), names.end()};
}

}  // namespace

void add_run(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("run", "Simulate a scenario: pings into recordings and pictures");
  RunOptions& options = request.run;
  command->add_option("SCENARIO", options.scenario, "Scenario file (YAML, or Stonefish's .scn)")->required();
  command->add_option("-o,--output", options.folder, "Output folder, made if missing [SCENARIO's name + _pings]")
      ->check(not_empty("a folder, or . for this one"))
      ->type_name("DIR");

  auto* pings = command->add_option("--pings", request.pings, "Pings of each sonar")
                    ->check(whole_number(1, 1'000'000'000))
                    ->type_name("N");
  auto* duration = command->add_option("--duration", request.duration, "Instead: ping from time 0 until this time [s]")
                       ->check(number_within(above_to(0, 1e9)))
                       ->excludes(pings)
                       ->type_name("S");
  auto* turns =
      command
          ->add_option("--turns", request.turns, "Instead: full turns of a scanning head, or sweeps across its sector")
          ->check(number_within(above_to(0, 1e6)))
          ->excludes(pings)
          ->excludes(duration)
          ->type_name("N");
  auto* engine =
      command->add_option("--engine", request.engine, "Engine that computes the echoes: cpu, or reference (slow)")
          ->check(one_of(engines()))
          ->type_name("NAME");
  auto* seed = command->add_option("--seed", request.seed, "Start of the random numbers")
                   ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
                   ->type_name("N");
  command->add_flag("--strict", request.strict, "End with an error if a part of the world is missing");
  command->add_option("--threads", options.threads, "Worker threads; 0: one per processor [0]")
      ->check(whole_number(0, 1024))
      ->type_name("N");
  command->add_option("--set", options.settings, "Change a key of the scenario, such as max_range=20; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  command->add_option("--record", request.record, "Recordings to make: h5, mcap (ROS 2 messages) or both: h5,mcap [h5]")
      ->check(one_of(record_choices()))
      ->type_name("KIND");
  add_message_choice(*command, options.messages, "in mcap recordings", "[1970]");
  command->add_flag("--compress", options.compress,
                    "Compress h5 recordings by HDF5's own filters: less than half the size, some time per ping");
  command->add_flag("-f,--force", options.force, "Replace recordings and pictures of an earlier run");
  command->add_flag("-q,--quiet", options.quiet, "Print only warnings and errors");

  const std::string pictures = "Pictures";
  command->add_option("--pictures", options.pictures.pictures, "Pings to draw: all, last, none or how many [20]")
      ->type_name("N")
      ->group(pictures);
  command->add_flag("--no-pictures", request.no_pictures, "The same as --pictures none --no-view")->group(pictures);
  command
      ->add_flag_function(
          "--view", [](std::int64_t) {}, "Draw the scene as a camera sees it: the default")
      ->group(pictures);
  command->add_flag("--no-view", request.no_view, "Do not draw the scene")->group(pictures);
  command->add_flag("--channels", options.channels, "Also draw distance and intensity by direction, at the first ping")
      ->group(pictures);
  add_picture_options(*command, options.pictures, pictures);
  add_counts_option(*command, options.pictures, pictures);

  command->footer(
      "Writes, for each sonar NAME:\n"
      "  DIR/NAME.h5              the recording (HDF5): intensity [ping, bin, beam] and ground truth\n"
      "  DIR/NAME.mcap            with --record mcap, ROS 2 messages: sonar image, fan, points, pose, scenario\n"
      "  DIR/NAME_fan_0000.png    each ping as seen from above; NAME_polar_0000.png as a table\n"
      "  DIR/NAME_scan_0000.png   what a scanning sonar has seen up to a ping, instead\n"
      "  DIR/NAME_scan.png        the same at the end; NAME_polar.png its waterfall\n"
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
  command->callback([&request, &options, pings, duration, turns, engine, seed] {
    const auto set_length = [&](const CLI::Option* option, const char* key, const auto& value) {
      if (*option) {
        options.settings.push_back(fmt::format("--{}={}", key, value));
      }
    };
    set_length(pings, "pings", request.pings);
    set_length(duration, "duration", request.duration);
    set_length(turns, "turns", request.turns);
    if (*engine) {
      options.settings.push_back("--engine=" + request.engine);
    }
    if (*seed) {
      options.settings.push_back(fmt::format("--seed={}", request.seed));
    }
    if (request.strict) {
      options.settings.emplace_back("--strict=true");
    }
    options.record = record_kinds(request.record);
    if (request.no_pictures) {
      options.pictures.pictures = "none";
    }
    options.view = !request.no_view && !request.no_pictures;
    request.act = [&options] { return run(options); };
  });
}

}  // namespace insonify
