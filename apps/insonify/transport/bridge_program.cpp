// bridge_program.cpp -- parses the command line of a bridge and runs it.

#include "transport/bridge_program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "console/console.h"
#include "console/guarded.h"
#include "console/outcome.h"

namespace insonify {
namespace {

// The command line of a bridge and its parsed values.
struct BridgeParser {
  explicit BridgeParser(const BridgeKind& its_kind)
      : kind(its_kind), command(kind.help, fmt::format("insonify bridge {}", kind.name)) {
    command.get_formatter()->column_width(34);
    add_bridge_options(command, kind, request);
  }

  // Throws CLI::CallForHelp, and InputError for invalid arguments.
  void parse(std::vector<std::string> words) {
    std::ranges::reverse(words);  // CLI11 expects them reversed.
    try {
      command.parse(std::move(words));
    } catch (const CLI::CallForHelp&) {
      throw;
    } catch (const CLI::ParseError& error) {
      const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
      throw InputError(extra ? fmt::format("not understood: {} (insonify bridge {} --help)",
                                           fmt::join(command.remaining(), " "), kind.name)
                             : fmt::format("{} (insonify bridge {} --help)", error.what(), kind.name));
    }
    check_other_words(command, kind);
  }

  const BridgeKind& kind;
  BridgeRequest request;
  CLI::App command;
};

}  // namespace

int run_bridge(std::string_view name, int argc, char** argv,
               const std::function<int(const BridgeRequest&, int&, char**)>& act) {
  return run_guarded([&] {
    BridgeParser parser(bridge_kind(name));
    try {
      parser.parse({argv + 1, argv + argc});
    } catch (const CLI::CallForHelp&) {
      say_text(parser.command.help());
      return kDone;
    }
    return act(parser.request, argc, argv);
  });
}

BridgeRequest parsed_bridge(const BridgeKind& kind, std::vector<std::string> words, const OptionValues& more) {
  BridgeParser first(kind);
  first.parse(words);
  for (const CLI::Option* option : first.command.get_options()) {
    if (option->count() > 0 || option->get_lnames().empty() || option == first.command.get_help_ptr()) {
      continue;
    }
    const std::string& name = option->get_lnames().front();
    const bool has_value = option->get_items_expected_max() > 0;
    for (const std::string& value : more(name)) {
      if (has_value) {
        words.push_back(fmt::format("--{}={}", name, value));
      } else if (value == "true") {
        words.push_back(fmt::format("--{}", name));
      }
    }
  }
  BridgeParser second(kind);
  second.parse(std::move(words));
  return second.request;
}

}  // namespace insonify
