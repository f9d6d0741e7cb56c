// main.cpp -- the command line: what each command takes, and how it ends.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <csignal>
#include <functional>
#include <limits>

#include "bench.h"
#include "commands.h"
#include "console.h"
#include "insonify/engine.h"

namespace insonify {
namespace {

// What the words on the command line asked for; `act` does it.
struct Request {
  RunOptions run;
  CompareOptions compare;
  int pings = 1;
  std::uint64_t seed = 1;
  std::string engine;
  std::string preset, mode;
  std::string section;
  BenchOptions bench;
  bool markdown = false;
  bool no_pictures = false, no_view = false, no_ms_ssim = false;
  std::function<int()> act;
};

// CLI11's own checks say "Value 0 not in range 1 to 9"; these speak as the library does.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  const auto check = [=](const std::string& text) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool good = error == std::errc() && end == text.data() + text.size() && number >= least && number <= most;
    return good ? std::string() : fmt::format("{} must be a whole number, from {} to {}", text, least, most);
  };
  return CLI::Validator(check, "");
}

CLI::Validator number_within(const Limits& limits) {
  const auto check = [=](const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool good = error == std::errc() && end == text.data() + text.size() && limits.allow(number);
    return good ? std::string() : fmt::format("{} must be a number, {}", text, limits.text());
  };
  return CLI::Validator(check, "");
}

CLI::Validator not_empty(const char* example) {
  const auto check = [=](const std::string& text) {
    return text.empty() ? fmt::format("must not be empty: name {}", example) : std::string();
  };
  return CLI::Validator(check, "");
}

CLI::Validator one_of(std::vector<std::string> words) {
  const auto check = [words = std::move(words)](const std::string& text) {
    const bool good = std::ranges::find(words, text) != words.end();
    return good ? std::string() : fmt::format("{} must be {}", text, fmt::join(words, " or "));
  };
  return CLI::Validator(check, "");
}

std::vector<std::string> engines() {
  const auto names = engine_names();
  return {names.begin(), names.end()};
}

void add_run(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("run", "Simulate a scenario: pings into recordings and pictures");
  RunOptions& options = request.run;
  command->add_option("SCENARIO", options.scenario, "Scenario file (YAML)")->required();
  command
      ->add_option("-o,--output", options.folder,
                   "Folder for what is written, made if missing [SCENARIO's name + _pings]")
      ->check(not_empty("a folder, or . for this one"))
      ->type_name("DIR");

  auto* pings = command->add_option("--pings", request.pings, "Pings of each sonar")
                    ->check(whole_number(1, 1'000'000'000))
                    ->type_name("N");
  auto* engine = command->add_option("--engine", request.engine, "What computes the echoes: cpu, or reference (slow)")
                     ->check(one_of(engines()))
                     ->type_name("NAME");
  auto* seed = command->add_option("--seed", request.seed, "Start of the random numbers")
                   ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
                   ->type_name("N");
  command->add_option("--threads", options.threads, "Worker threads; 0 for as many as there are processors [0]")
      ->check(whole_number(0, 1024))
      ->type_name("N");
  command->add_option("--set", options.settings, "Change a key of the scenario, such as max_range=20; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  command->add_flag("-q,--quiet", options.quiet, "Say nothing but warnings and errors");

  const std::string pictures = "Pictures";
  command->add_option("--pictures", options.pictures, "Pings to draw: all, last, none or how many [20]")
      ->type_name("N")
      ->group(pictures);
  command->add_flag("--no-pictures", request.no_pictures, "The same as --pictures none --no-view")->group(pictures);
  command
      ->add_flag_function(
          "--view", [](std::int64_t) {}, "Draw the scene as a camera sees it: the default")
      ->group(pictures);
  command->add_flag("--no-view", request.no_view, "Do not draw the scene")->group(pictures);
  command->add_option("--colour-map", options.colour_map, "inferno, copper, grey or blue [inferno]")
      ->type_name("NAME")
      ->group(pictures);
  command->add_option("--scale", options.scale, "linear or db [linear]")
      ->check(one_of({"linear", "db"}))
      ->type_name("NAME")
      ->group(pictures);
  command->add_option("--floor-db", options.floor_db, "Darkest level on a decibel scale [-50]")
      ->check(number_within({.least = -300, .most = 0, .most_allowed = false}))
      ->type_name("DB")
      ->group(pictures);
  command->add_option("--height", options.height, "Height of each picture in pixels, 240 to 8192 [720]")
      ->check(whole_number(240, 8192))
      ->type_name("N")
      ->group(pictures);

  command->footer(
      "Writes, for each sonar NAME:\n"
      "  DIR/NAME.h5              the recording (HDF5): intensity [ping, bin, beam] and ground truth\n"
      "  DIR/NAME_fan_0000.png    each ping as seen from above; NAME_polar_0000.png as a table\n"
      "  DIR/NAME_scan_0000.png   what a scanning sonar has seen up to a ping, instead\n"
      "  DIR/NAME_scan.png        the same at the end; NAME_polar.png its waterfall\n"
      "  DIR/NAME_view.png        the scene, with the sonar and its field\n"
      "Pictures of these names that an earlier run left are removed first.\n\n"
      "Keys of --set: pings, water.depth, sonars[0].max_range, sonars.NAME.max_range, or max_range for every sonar;\n"
      "insonify describe tells them all.\n\n"
      "Examples:\n"
      "  insonify run scenes/sphere.yaml\n"
      "  insonify run scenes/ferry.yaml -o out --pings 3 --set max_range=30\n"
      "  insonify run scenes/tank.yaml -o out --scale db --floor-db -40 --colour-map copper\n\n"
      "Ctrl-C ends a run and keeps the pings made so far.\n"
      "Exit status: 0 done, 1 failed while running or stopped, 2 wrong input.");
  command->callback([&request, &options, pings, engine, seed] {
    if (*pings) {
      options.settings.push_back(fmt::format("pings={}", request.pings));
    }
    if (*engine) {
      options.settings.push_back("engine=" + request.engine);
    }
    if (*seed) {
      options.settings.push_back(fmt::format("seed={}", request.seed));
    }
    if (request.no_pictures) {
      options.pictures = "none";
    }
    options.view = !request.no_view && !request.no_pictures;
    request.act = [&options] { return run(options); };
  });
}

void add_sonars(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("sonars", "List the instruments there are presets of, or tell all of one");
  command->add_option("PRESET", request.preset, "Instrument to tell of, with the source of each number");
  command->add_option("--mode", request.mode, "Mode of it, such as low or high")->type_name("MODE");
  command->footer(
      "Examples:\n"
      "  insonify sonars\n"
      "  insonify sonars blueprint-oculus-m750d --mode high\n\n"
      "Presets are read from the folder INSONIFY_PRESETS where that is set.");
  command->callback([&request] { request.act = [&request] { return sonars(request.preset, request.mode); }; });
}

void add_describe(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("describe", "Tell every key of a scenario: unit, limits, default, meaning");
  command->add_option("SECTION", request.section, "One section alone: water, sonars, paper ...");
  command->add_flag("--markdown", request.markdown, "As a page of the manual");
  command->footer("Examples:\n  insonify describe\n  insonify describe sonars");
  command->callback([&request] { request.act = [&request] { return describe(request.section, request.markdown); }; });
}

void add_compare(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("compare", "Tell how alike two recordings or two grey pictures are");
  CompareOptions& options = request.compare;
  command->add_option("A", options.a, "Recording (.h5), folder of recordings, or grey picture (.png)")->required();
  command->add_option("B", options.b, "The same, of the same shape: what is judged against A")->required();
  command->add_option("--sonar", options.sonar, "Which recording of a folder")->type_name("NAME");
  command->add_option("--ping", options.pings, "Ping to compare, from 0; may be repeated [all that both have]")
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("N")
      ->expected(1)
      ->take_all();
  command->add_option("--full-scale", options.full_scale, "Intensity that counts as 1, in recordings of fractions [1]")
      ->type_name("X");
  command->add_option("--scale", options.scale, "How intensities count: linear or db [linear]")
      ->check(one_of({"linear", "db"}))
      ->type_name("NAME");
  command->add_option("--floor-db", options.floor_db, "Level that counts as 0 on a decibel scale [-50]")
      ->type_name("DB");
  command->add_flag("--no-ms-ssim", request.no_ms_ssim, "Leave out MS-SSIM, which needs 176 x 176");
  command->add_flag("--json", options.json, "As JSON, with the numbers of each ping");
  command->footer(
      "Tells MSE, PSNR, SSIM, MS-SSIM, correlation and the distance of the histograms, as means over the pings; below\n"
      "them what worthless pictures score against A: a flat grey, A's mean range profile, A's pixels shuffled.\n\n"
      "Examples:\n"
      "  insonify compare real.h5 simulated.h5 --ping 0 --ping 5\n"
      "  insonify compare out_a out_b --sonar fls --json\n"
      "  insonify compare real.png simulated.png");
  command->callback([&request, &options] {
    options.ms_ssim = !request.no_ms_ssim;
    request.act = [&options] { return compare(options); };
  });
}

void add_bench(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("bench", "Measure how fast this machine is");
  command->require_subcommand(1);
  command->footer("Help on it: insonify bench engine --help");
  CLI::App* engine = command->add_subcommand("engine", "Whole pings against the bare traversal of their rays");
  BenchOptions& options = request.bench;
  engine->add_option("--triangles", options.triangles, "About how many triangles each scene has [1000 100000 1000000]")
      ->check(whole_number(1, 100'000'000))
      ->type_name("N ...");
  engine->add_option("--threads", options.threads, "Worker threads [1 2]")
      ->check(whole_number(1, 1024))
      ->type_name("N ...");
  engine->add_option("--repetitions", options.repetitions, "Timed pings of each row [40]")
      ->check(whole_number(1, 1'000'000))
      ->type_name("N");
  engine->add_option("--json", options.json, "Write the rows to this file too")->type_name("FILE");
  engine->footer("Example:\n  insonify bench engine --triangles 1000 100000 --threads 1 --json rows.json");
  engine->callback([&request, &options] { request.act = [&options] { return bench_engine(options); }; });
  CLI::App* primary = command->add_subcommand("primary", "Primary echoes traced by rays against drawn ones");
  primary->add_option("--triangles", options.triangles, "About how many triangles each scene has [1000 100000 1000000]")
      ->check(whole_number(1, 100'000'000))
      ->type_name("N ...");
  primary->add_option("--repetitions", options.repetitions, "Timed pings of each row [40]")
      ->check(whole_number(1, 1'000'000))
      ->type_name("N");
  primary->add_option("--json", options.json, "Write the rows to this file too")->type_name("FILE");
  primary->callback([&request, &options] { request.act = [&options] { return bench_primary(options); }; });
}

void add_version(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("version", "Tell the version and the engines built in");
  command->footer("Example:\n  insonify version");
  command->callback([&request] { request.act = version; });
}

// What CLI11 did not understand, in one line with a way out.
std::string explained(const CLI::App& app, const CLI::ParseError& error, const std::string& first) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    commands.push_back(command->get_name());
  }
  if (std::ranges::find(commands, first) != commands.end()) {
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
      return fmt::format("not understood: {} (insonify {} --help)", fmt::join(app.remaining(true), " "), first);
    }
    return fmt::format("{} (insonify {} --help)", error.what(), first);
  }
  const std::string unknown = first.empty()
                                  ? "name a command"
                                  : fmt::format("there is no {} {}", first[0] == '-' ? "option" : "command", first);
  return fmt::format("{}; the commands are {} (insonify --help)", unknown, fmt::join(commands, ", "));
}

int run_program(int argc, char** argv) {
  CLI::App app("insonify -- what imaging sonars would show of a 3-D scene", "insonify");
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.footer(
      "Start with:  insonify run scenes/sphere.yaml\n"
      "Help on one: insonify run --help");
  Request request;
  app.add_flag_callback(
      "--version",
      [] {
        version();
        throw CLI::Success();
      },
      "Tell the version");
  add_run(app, request);
  add_sonars(app, request);
  add_describe(app, request);
  add_compare(app, request);
  add_bench(app, request);
  add_version(app, request);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    say_text(app.help());
    return kDone;
  } catch (const CLI::Success&) {
    return kDone;  // Version.
  } catch (const CLI::ParseError& error) {
    throw InputError(explained(app, error, argc > 1 ? argv[1] : ""));
  }
  return request.act();
}

// What went wrong, in one line and an exit status.
int run_guarded(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const InputError& error) {
    complain(error.what());
    return kWrongInput;
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& error) {
    complain(error.what());
  }
  return kFailed;
}

}  // namespace
}  // namespace insonify

int main(int argc, char** argv) {
  insonify::open_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // A file that may not grow is an error like any other.
  return insonify::finish_output(insonify::run_guarded(argc, argv));
}
