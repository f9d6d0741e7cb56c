// manual.cpp -- `insonify manual`: writes the manual page for `man insonify`.

#include <fmt/format.h>

#include <algorithm>

#include "insonify/version.h"
#include "shell/shell_texts.h"

namespace insonify {
namespace {

// Escapes text for troff: hyphens stay hyphens, and no line is read as a request.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    const bool first = result.empty() || result.back() == '\n';
    if (first && (letter == '.' || letter == '\'')) {
      result += "\\&";
    }
    if (letter == '\\') {
      result += "\\e";
    } else if (letter == '-') {
      result += "\\-";
    } else {
      result += letter;
    }
  }
  return result;
}

// "[OPTIONS] SCENARIO"
std::string usage(const CommandWords& command) {
  std::string text = command.options.empty() ? "" : " [\\fIOPTIONS\\fR]";
  for (const OptionWords& argument : command.arguments) {
    const std::string name = fmt::format("\\fI{}\\fR", escaped(argument.value));
    text += argument.required ? " " + name : " [" + name + "]";
  }
  return text;
}

std::string option_text(const OptionWords& option) {
  std::string names;
  for (const std::string& name : option.spelled()) {
    names += (names.empty() ? "\\fB" : ", \\fB") + escaped(name) + "\\fR";
  }
  const std::string value = option.value.empty() ? "" : " \\fI" + escaped(option.value) + "\\fR";
  return fmt::format(".TP\n{}{}\n{}.\n", names, value, escaped(option.help));
}

std::string command_text(const CommandWords& command) {
  std::string text =
      fmt::format(".SS insonify {}{}\n{}.\n", escaped(command.path), usage(command), escaped(command.help));
  for (const OptionWords& argument : command.arguments) {
    text += fmt::format(".TP\n\\fI{}\\fR\n{}.\n", escaped(argument.value), escaped(argument.help));
  }
  std::vector<std::string> groups;
  for (const OptionWords& option : command.options) {
    if (std::ranges::find(groups, option.group) == groups.end()) {
      groups.push_back(option.group);
    }
  }
  for (const std::string& group : groups) {
    if (group != "Options") {
      text += fmt::format(".PP\n{}:\n", escaped(group));
    }
    for (const OptionWords& option : command.options) {
      text += option.group == group ? option_text(option) : "";
    }
  }
  if (!command.footer.empty()) {
    text += fmt::format(".PP\n.nf\n{}\n.fi\n", escaped(command.footer));
  }
  return text;
}

}  // namespace

std::string manual_page(const std::vector<CommandWords>& commands) {
  const CommandWords& program = commands.front();
  std::string text = fmt::format(
      ".\\\" Made by `insonify manual`.\n.TH INSONIFY 1 \"\" \"insonify {}\" \"User commands\"\n", kVersion);
  text += ".SH NAME\ninsonify \\- simulator of imaging sonars\n.SH SYNOPSIS\n";
  for (const CommandWords& command : commands) {
    if (command.commands.empty()) {
      text += fmt::format(".B insonify {}\\fR{}\n.br\n", escaped(command.path), usage(command));
    }
  }
  text +=
      ".SH DESCRIPTION\nPuts sound into a 3-D scene and gives the pings that a forward-looking sonar, a mechanically "
      "scanned\none, a side-scan or a multibeam would record: recordings (HDF5) and pictures (PNG). What to simulate "
      "is said by a scenario, a YAML file\n"
      "whose keys\n.B insonify describe\ntells.\n";
  for (const OptionWords& option : program.options) {
    text += option_text(option);
  }
  text += ".SH COMMANDS\n";
  for (const CommandWords& command : commands) {
    text += command.path.empty() || !command.commands.empty() ? "" : command_text(command);
  }
  return text +
         ".SH ENVIRONMENT\n.TP\n.B INSONIFY_PRESETS\nFolders of presets that add to the shipped ones, separated by "
         "colons.\n"
         ".SH EXIT STATUS\n0 done; 1 failed while running, or stopped; 2 wrong input.\n"
         ".SH SEE ALSO\nThe shipped scenes and presets, in the folder\n.I share/insonify\nbeside the program's\n.IR "
         "bin .\n";
}

}  // namespace insonify
