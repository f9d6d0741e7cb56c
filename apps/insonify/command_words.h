// command_words.h -- what may be typed after `insonify`, read from the description of the command line itself.

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace insonify {

/// What follows an option, or stands as an argument.
enum class WordKind {
  kNothing,  ///< A flag.
  kAny,      ///< A number or a text, of which nothing can be suggested.
  kChoice,   ///< One of `choices`.
  kFile,
  kFolder,
  kPreset,  ///< An instrument, as `insonify sonars` lists them.
};

struct OptionWords {
  std::vector<std::string> short_names, long_names;  ///< Without hyphens; both empty for an argument.
  std::string help;
  std::string value;  ///< What stands for the value in texts: N, DIR, SCENARIO; "" for a flag.
  std::string group;  ///< Heading under which the help lists it.
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
  std::string footer;                 ///< Examples and the like, ready to print.
  std::vector<std::string> commands;  ///< Paths of the commands that may follow.
  std::vector<OptionWords> options, arguments;
};

/// insonify itself, then every command, each before those that may follow it.
[[nodiscard]] std::vector<CommandWords> command_words(CLI::App& app);

}  // namespace insonify
