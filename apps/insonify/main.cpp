// main.cpp -- parses the command line, runs the command and sets the exit status.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "about/about.h"
#include "console/console.h"
#include "console/guarded.h"
#include "console/outcome.h"
#include "request.h"

namespace insonify {
namespace {

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    commands.push_back(command->get_name());
  }
  return commands;
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

// Reports a CLI11 parse error in one line, with a hint.
std::string explained(const CLI::App& app, const CLI::ParseError& error, const std::string& first,
                      const std::string& second) {
  const std::vector<std::string> commands = commands_of(app);
  if (contains(commands, first)) {
    const std::vector<std::string> inner = commands_of(*app.get_subcommand(first));
    if (!inner.empty() && !contains(inner, second)) {
      return fmt::format("{}: name one of {} (insonify {} --help)",
                         second.empty() ? first : fmt::format("there is no {} {}", first, second),
                         fmt::join(inner, ", "), first);
    }
    const std::string named = inner.empty() ? first : fmt::format("{} {}", first, second);
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
      return fmt::format("not understood: {} (insonify {} --help)", fmt::join(app.remaining(true), " "), named);
    }
    std::string text = error.what();
    if (const std::size_t at = text.find(" was given a disallowed flag override"); at != std::string::npos) {
      text = fmt::format("{}{} takes no value", at == 1 ? "-" : "--", text.substr(0, at));
    }
    return fmt::format("{} (insonify {} --help)", text, named);
  }
  const std::string unknown = first.empty()
                                  ? "name a command"
                                  : fmt::format("there is no {} {}", first[0] == '-' ? "option" : "command", first);
  return fmt::format("{}; the commands are {} (insonify --help)", unknown, fmt::join(commands, ", "));
}

// A flag takes no value: --force=5 is a mistake, which CLI11 would take for --force.
void refuse_values_of_flags(CLI::App& app) {
  for (CLI::Option* option :
       app.get_options([](const CLI::Option* each) { return each->get_items_expected_max() == 0; })) {
    option->disable_flag_override();
  }
  for (CLI::App* command : app.get_subcommands({})) {
    refuse_values_of_flags(*command);
  }
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
  request.words.assign(argv + std::min(argc, 1), argv + argc);
  app.add_flag_callback(
      "--version",
      [] {
        version();
        throw CLI::Success();
      },
      "Print the version");
  add_run(app, request);
  add_serve(app, request);
  add_emulate(app, request);
  add_bridge(app, request);
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
  refuse_values_of_flags(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    say_text(app.help());
    return kDone;
  } catch (const CLI::Success&) {
    return kDone;  // --version.
  } catch (const CLI::ParseError& error) {
    throw InputError(explained(app, error, argc > 1 ? argv[1] : "", argc > 2 ? argv[2] : ""));
  }
  return request.act();
}

}  // namespace
}  // namespace insonify

int main(int argc, char** argv) {
  return insonify::run_guarded([&] { return insonify::run_program(argc, argv); });
}
