// completion_fish.cpp -- `insonify completion fish`: writes one `complete` line per word that may follow a command.

#include <fmt/format.h>

#include <algorithm>

#include "shell/shell_texts.h"

namespace insonify {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') {
      result += '\\';
    }
    result += letter;
  }
  return result + "'";
}

// Start of a `complete` line that applies after this command.
std::string line(const std::string& path) {
  return fmt::format("complete -c insonify -n 'test \"$(__insonify_command)\" = \"{}\"'", path);
}

std::string suggested(const OptionWords& option) {
  switch (option.kind) {
    case WordKind::kChoice:
      return fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
    case WordKind::kFile:
      return " -r -F";
    case WordKind::kFolder:
      return " -x -a '(__fish_complete_directories)'";
    case WordKind::kPreset:
      return " -x -a '(__insonify_presets)'";
    case WordKind::kAny:
      return " -x";
    case WordKind::kNothing:
      break;
  }
  return "";
}

std::string function_head(const std::vector<CommandWords>& commands) {
  std::string text =
      "# Completes insonify's command line in fish. Made by `insonify completion fish`.\n\n"
      "function __insonify_command\n  set -l command ''\n  for word in (commandline -opc)[2..-1]\n"
      "    switch \"$command $word\"\n";
  for (const CommandWords& command : commands) {
    if (!command.path.empty()) {
      const std::string typed = command.path.find(' ') == std::string::npos ? " " + command.path : command.path;
      text += fmt::format("      case '{}'\n        set command '{}'\n", typed, command.path);
    }
  }
  return text +
         "    end\n  end\n  echo -n $command\nend\n\n"
         "function __insonify_presets\n"
         "  insonify sonars 2>/dev/null | sed -n '2,/^$/s/^\\([^ ][^ ]*\\) .*/\\1/p'\nend\n\n"
         "complete -c insonify -f\n";
}

}  // namespace

std::string fish_completion(const std::vector<CommandWords>& commands) {
  std::string text = function_head(commands);
  for (const CommandWords& command : commands) {
    for (const CommandWords& next : commands) {
      if (std::ranges::find(command.commands, next.path) != command.commands.end()) {
        text += fmt::format("{} -a {} -d {}\n", line(command.path), next.name, quoted(next.help));
      }
    }
    for (const OptionWords& argument : command.arguments) {
      text += fmt::format("{}{} -d {}\n", line(command.path), suggested(argument), quoted(argument.help));
    }
    for (const OptionWords& option : command.options) {
      text += line(command.path);
      for (const std::string& name : option.short_names) {
        text += " -s " + name;
      }
      for (const std::string& name : option.long_names) {
        text += " -l " + name;
      }
      text += fmt::format("{} -d {}\n", suggested(option), quoted(option.help));
    }
  }
  return text;
}

}  // namespace insonify
