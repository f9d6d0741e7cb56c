// command_words.cpp -- lists commands, options and arguments from CLI11's description of the command line.

#include "shell/command_words.h"

#include <algorithm>

#include "console/validators.h"
#include "insonify/describe.h"

namespace insonify {
namespace {

// CLI11 has no notion of files: the type of an option's value follows from its placeholder in the help.
WordKind kind_of(const OptionWords& option) {
  if (option.value.empty()) {
    return WordKind::kNothing;
  }
  if (!option.choices.empty()) {
    return WordKind::kChoice;
  }
  const auto is_one_of = [&](std::initializer_list<const char*> words) {
    return std::ranges::any_of(words, [&](const char* word) { return option.value == word; });
  };
  return is_one_of({"FILE", "SCENARIO", "RECORDING", "A", "B"}) ? WordKind::kFile
         : option.value == "DIR"                                ? WordKind::kFolder
         : option.value == "PRESET"                             ? WordKind::kPreset
                                                                : WordKind::kAny;
}

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const SectionDescription& section : describe_scenario()) {
    names.push_back(section.name);
  }
  return names;
}

OptionWords option_words(CLI::Option& option) {
  OptionWords words;
  words.short_names = option.get_snames();
  words.long_names = option.get_lnames();
  words.help = option.get_description();
  words.group = option.get_group();
  words.required = option.get_required();
  words.choices = choices_of(option);
  if (option.get_positional()) {
    words.value = option.get_single_name();
    if (words.value == "SECTION") {
      words.choices = section_names();
    }
  } else if (option.get_items_expected_max() > 0) {
    words.value = option.get_type_name();
  }
  words.kind = kind_of(words);
  return words;
}

void add_command(CLI::App& app, const std::string& path, std::vector<CommandWords>& all) {
  CommandWords command;
  command.path = path;
  command.name = app.get_name();
  command.help = app.get_description();
  command.footer = app.get_footer();
  for (CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty()) {  // Hidden options have an empty group.
      (option->get_positional() ? command.arguments : command.options).push_back(option_words(*option));
    }
  }
  const std::vector<CLI::App*> inner = app.get_subcommands([](CLI::App*) { return true; });
  const std::string prefix = path.empty() ? "" : path + " ";
  for (CLI::App* next : inner) {
    command.commands.push_back(prefix + next->get_name());
  }
  all.push_back(std::move(command));
  for (CLI::App* next : inner) {
    add_command(*next, prefix + next->get_name(), all);
  }
}

}  // namespace

std::vector<std::string> OptionWords::spelled() const {
  std::vector<std::string> words;
  for (const std::string& name : short_names) {
    words.push_back("-" + name);
  }
  for (const std::string& name : long_names) {
    words.push_back("--" + name);
  }
  return words;
}

std::vector<CommandWords> command_words(CLI::App& app) {
  std::vector<CommandWords> all;
  add_command(app, "", all);
  return all;
}

}  // namespace insonify
