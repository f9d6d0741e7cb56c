// completion_bash.cpp -- `insonify completion bash`: writes a function that completes from the words before the cursor.

#include <fmt/format.h>

#include "shell/shell_texts.h"

namespace insonify {
namespace {

constexpr const char* kHead = R"script(# Completes insonify's command line in bash. Made by `insonify completion bash`.

_insonify_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$2"); }
_insonify_paths() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen "$1" -- "$2")
}
_insonify_presets() {
  _insonify_words "$("$1" sonars 2>/dev/null | sed -n '2,/^$/s/^\([^ ][^ ]*\) .*/\1/p')" "$2"
}

_insonify() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} last=${COMP_WORDS[COMP_CWORD - 1]} command='' i
  COMPREPLY=()
)script";

// Shell call that suggests values of an option or argument.
std::string suggested(const OptionWords& option) {
  switch (option.kind) {
    case WordKind::kChoice:
      return fmt::format("_insonify_words '{}' \"$word\"", fmt::join(option.choices, " "));
    case WordKind::kFile:
      return "_insonify_paths -f \"$word\"";
    case WordKind::kFolder:
      return "_insonify_paths -d \"$word\"";
    case WordKind::kPreset:
      return "_insonify_presets \"$program\" \"$word\"";
    case WordKind::kNothing:
    case WordKind::kAny:
      break;
  }
  return ":";
}

// Shell code that finds the command among the words before the cursor.
std::string command_loop(const std::vector<CommandWords>& commands) {
  std::string text = "  for ((i = 1; i < COMP_CWORD; ++i)); do\n    case \"$command ${COMP_WORDS[i]}\" in\n";
  for (const CommandWords& command : commands) {
    if (!command.path.empty()) {
      const std::size_t space = command.path.rfind(' ');
      const std::string typed = space == std::string::npos ? " " + command.path : command.path;
      text += fmt::format("      '{}') command='{}' ;;\n", typed, command.path);
    }
  }
  return text + "    esac\n  done\n";
}

std::string option_values(const std::vector<CommandWords>& commands) {
  std::string text = "  case \"$command $last\" in\n";
  for (const CommandWords& command : commands) {
    for (const OptionWords& option : command.options) {
      if (option.kind == WordKind::kNothing) {
        continue;
      }
      std::vector<std::string> typed;
      for (const std::string& name : option.spelled()) {
        typed.push_back(fmt::format("'{} {}'", command.path, name));
      }
      text += fmt::format("    {}) {}; return ;;\n", fmt::join(typed, " | "), suggested(option));
    }
  }
  return text + "  esac\n";
}

std::string options_and_arguments(const std::vector<CommandWords>& commands) {
  std::string text = "  case \"$command\" in\n";
  for (const CommandWords& command : commands) {
    std::vector<std::string> options, names;
    for (const OptionWords& option : command.options) {
      const std::vector<std::string> typed = option.spelled();
      options.insert(options.end(), typed.begin(), typed.end());
    }
    for (const std::string& path : command.commands) {
      names.push_back(path.substr(path.rfind(' ') + 1));
    }
    const std::string next = !names.empty() ? fmt::format("_insonify_words '{}' \"$word\"", fmt::join(names, " "))
                             : command.arguments.empty() ? ":"
                                                         : suggested(command.arguments.front());
    text += fmt::format("    '{}')\n      if [[ $word == -* ]]; then\n        _insonify_words '{}' \"$word\"\n",
                        command.path, fmt::join(options, " "));
    text += fmt::format("      else\n        {}\n      fi\n      ;;\n", next);
  }
  return text + "  esac\n";
}

}  // namespace

std::string bash_completion(const std::vector<CommandWords>& commands) {
  return kHead + command_loop(commands) + option_values(commands) + options_and_arguments(commands) +
         "}\n\ncomplete -F _insonify insonify\n";
}

}  // namespace insonify
