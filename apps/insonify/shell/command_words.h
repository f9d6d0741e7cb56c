// command_words.h -- commands, options and arguments of `insonify`, read from its CLI11 description.

#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
}

namespace insonify {

/// Type of an option's value or of an argument.
enum class WordKind {
  kNothing,  ///< A flag.
  kAny,      ///< A number or a text, for which nothing can be suggested.
  kChoice,   ///< One of `choices`.
  kFile,
  kFolder,
  kPreset,  ///< An instrument, as `insonify sonars` lists them.
};

struct OptionWords {
  std::vector<std::string> short_names, long_names;  ///< Without hyphens; both are empty for an argument.
  std::string help;
  std::string value;  ///< Placeholder of the value in the help: N, DIR, SCENARIO; "" for a flag.
  std::string group;  ///< Heading of the help under which it is listed.
  WordKind kind = WordKind::kNothing;
  std::vector<std::string> choices;
  bool required = false;

  /// "-o" and "--output".
  [[nodiscard]] std::vector<std::string> spelled() const;
};

struct CommandWords {
  std::string path;  ///< "bench engine"; "" for insonify itself.
  std::string name;  ///< "engine"
  std::string help;
  std::string footer;                 ///< Examples and notes after the options in the help.
  std::vector<std::string> commands;  ///< Paths of the subcommands.
  std::vector<OptionWords> options, arguments;
};

/// insonify itself, then every command, each before its subcommands.
[[nodiscard]] std::vector<CommandWords> command_words(CLI::App& app);

}  // namespace insonify
