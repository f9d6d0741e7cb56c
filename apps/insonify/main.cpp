// main.cpp -- parses the command line, runs the command and sets the exit status.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <new>

#include "about/about.h"
#include "console/console.h"
#include "console/outcome.h"
#include "request.h"

namespace insonify {
namespace {

// Reports a CLI11 parse error in one line, with a hint.
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
      "In a browser: insonify serve scenes/ferry_calibrated.yaml\n"
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
  add_serve(app, request);
  add_emulate(app, request);
  add_draw(app, request);
  add_replay(app, request);
  add_info(app, request);
  add_export(app, request);
  add_sonars(app, request);
  add_describe(app, request);
  add_compare(app, request);
  add_bench(app, request);
  add_version(app, request);
  add_completion(app, request);
  add_manual(app, request);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    say_text(app.help());
    return kDone;
  } catch (const CLI::Success&) {
    return kDone;  // --version.
  } catch (const CLI::ParseError& error) {
    throw InputError(explained(app, error, argc > 1 ? argv[1] : ""));
  }
  return request.act();
}

// Reports an error in one line and returns the exit status.
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
  std::signal(SIGXFSZ, SIG_IGN);  // Exceeding a file size limit becomes an ordinary write error.
  return insonify::finish_output(insonify::run_guarded(argc, argv));
}
