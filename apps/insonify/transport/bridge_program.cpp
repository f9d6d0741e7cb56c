// bridge_program.cpp -- parses the command line of a bridge and runs it.

#include "transport/bridge_program.h"

#include <fmt/format.h>

#include <algorithm>

#include "console/console.h"
#include "console/outcome.h"

namespace insonify {
namespace {

// The command line of a bridge and its parsed values.
struct BridgeParser {
  explicit BridgeParser(const BridgeKind& its_kind)
      : kind(its_kind), line(fmt::format("insonify bridge {}", kind.name), kind.help) {
    add_bridge_options(line, kind, request);
  }

  // False if the help was asked for. @throws InputError for invalid arguments.
  bool parse(std::vector<std::string> words) {
    if (!line.parse(std::move(words))) {
      return false;
    }
    check_other_words(line, kind);
    return true;
  }

  const BridgeKind& kind;
  BridgeRequest request;
  CommandLine line;
};

}  // namespace

int run_bridge(std::string_view name, int argc, char** argv,
               const std::function<int(const BridgeRequest&, int&, char**)>& act) {
  return run_guarded([&] {
    BridgeParser parser(bridge_kind(name));
    return parser.parse({argv + 1, argv + argc}) ? act(parser.request, argc, argv) : kDone;
  });
}

BridgeRequest parsed_bridge(const BridgeKind& kind, std::vector<std::string> words, const OptionValues& more) {
  BridgeParser first(kind);
  (void)first.parse(words);
  const CommandWords known = first.line.words().front();
  for (const OptionWords& option : known.options) {
    const std::string& name = option.long_names.front();
    if (name == "help" || first.line.given("--" + name)) {
      continue;
    }
    for (const std::string& value : more(name)) {
      if (!option.value.empty()) {
        words.push_back(fmt::format("--{}={}", name, value));
      } else if (value == "true") {
        words.push_back(fmt::format("--{}", name));
      }
    }
  }
  BridgeParser second(kind);
  (void)second.parse(std::move(words));
  return second.request;
}

}  // namespace insonify
