// completion_zsh.cpp -- `insonify completion zsh`: writes one function per command, based on zsh's _arguments.

#include <fmt/format.h>

#include <algorithm>

#include "shell/shell_texts.h"

namespace insonify {
namespace {

constexpr const char* kHead = R"script(#compdef insonify
# Completes insonify's command line in zsh. Made by `insonify completion zsh`.

_insonify_presets() {
  local -a presets
  presets=(${(f)"$(insonify sonars 2>/dev/null | sed -n '2,/^$/s/^\([^ ][^ ]*\) .*/\1/p')"})
  _describe preset presets
}
)script";

// Escapes text in single quotes, within a part of an _arguments or _describe specification that ends at ':' or ']'.
std::string quoted(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '\'') {
      result += "'\\''";
    } else {
      result += letter == ':' || letter == '[' || letter == ']' || letter == '\\' ? fmt::format("\\{}", letter)
                                                                                  : std::string(1, letter);
    }
  }
  return result;
}

std::string suggested(const OptionWords& option) {
  switch (option.kind) {
    case WordKind::kChoice:
      return fmt::format("({})", fmt::join(option.choices, " "));
    case WordKind::kFile:
      return "_files";
    case WordKind::kFolder:
      return "_files -/";
    case WordKind::kPreset:
      return "_insonify_presets";
    case WordKind::kNothing:
    case WordKind::kAny:
      break;
  }
  return " ";
}

// "bench engine" gives _insonify_bench_engine.
std::string function_of(const std::string& path) {
  std::string name = path.empty() ? "_insonify" : "_insonify_" + path;
  std::ranges::replace(name, ' ', '_');
  return name;
}

std::string option_line(const OptionWords& option) {
  const std::string value = option.value.empty() ? "" : fmt::format(":{}:{}", quoted(option.value), suggested(option));
  std::string text;
  for (const std::string& name : option.spelled()) {
    text += fmt::format("    '{}[{}]{}' \\\n", name, quoted(option.help), value);
  }
  return text;
}

std::string function(const CommandWords& command, const std::vector<CommandWords>& all) {
  std::string text = fmt::format("\n{}() {{\n", function_of(command.path));
  text += command.commands.empty() ? "  _arguments \\\n"
                                   : "  local context state line\n  typeset -A opt_args\n  _arguments -C \\\n";
  for (const OptionWords& option : command.options) {
    text += option_line(option);
  }
  for (const OptionWords& argument : command.arguments) {
    text +=
        fmt::format("    '{}:{}:{}' \\\n", argument.required ? "" : ":", quoted(argument.value), suggested(argument));
  }
  if (command.commands.empty()) {
    return text + "    && return\n}\n";
  }
  text += "    '1:command:->command' \\\n    '*::argument:->argument' && return\n  case $state in\n    command)\n";
  text += "      local -a commands\n      commands=(\n";
  std::string calls;
  for (const CommandWords& next : all) {
    if (std::ranges::find(command.commands, next.path) != command.commands.end()) {
      text += fmt::format("        '{}:{}'\n", next.name, quoted(next.help));
      calls += fmt::format("        {}) {} ;;\n", next.name, function_of(next.path));
    }
  }
  return text + "      )\n      _describe command commands\n      ;;\n    argument)\n      case $words[1] in\n" +
         calls + "      esac\n      ;;\n  esac\n}\n";
}

}  // namespace

std::string zsh_completion(const std::vector<CommandWords>& commands) {
  std::string text = kHead;
  for (const CommandWords& command : commands) {
    text += function(command, commands);
  }
  // Compinit loads the script as the body of _insonify, or the user sources it: either way the function must be
  // registered.
  return text +
         "\nif [[ $funcstack[1] == _insonify ]]; then\n  _insonify \"$@\"\nelse\n  compdef _insonify insonify\nfi\n";
}

}  // namespace insonify
