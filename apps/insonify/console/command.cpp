// command.cpp -- builds a command line with CLI11, and explains in one line what is wrong with what was typed.

#include "console/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "console/console.h"
#include "console/outcome.h"

namespace insonify {

struct Command::Line {
  explicit Line(const std::string& name, const std::string& help) : app(help, name) {}

  std::vector<std::shared_ptr<void>> kept;
  std::map<const CLI::Option*, std::vector<std::string>> choices;
  std::function<int()> act;
  CLI::App app;
};

namespace {

std::vector<std::string> names_of(const std::vector<CLI::App*>& commands) {
  std::vector<std::string> names;
  std::ranges::transform(commands, std::back_inserter(names), [](const CLI::App* one) { return one->get_name(); });
  return names;
}

std::vector<CLI::App*> commands_of(CLI::App& app) {
  return app.get_subcommands([](CLI::App*) { return true; });
}

// Reports what CLI11 found in one line, with a hint.
std::string explained(CLI::App& program, const CLI::ParseError& error, const std::vector<std::string>& words) {
  CLI::App* command = &program;
  std::string path;  // "emulate oculus"
  auto word = words.begin();
  for (std::vector<CLI::App*> inner = commands_of(program); word != words.end(); inner = commands_of(*command)) {
    const auto found = std::ranges::find(inner, *word, [](const CLI::App* one) { return one->get_name(); });
    if (found == inner.end()) {
      break;
    }
    command = *found;
    path += (path.empty() ? "" : " ") + *word++;
  }
  const std::string next = word == words.end() ? "" : *word;
  const std::string inner = fmt::format("{}", fmt::join(names_of(commands_of(*command)), ", "));
  if (!inner.empty() && path.empty()) {
    const std::string fault =
        next.empty() ? "name a command" : fmt::format("there is no {} {}", next[0] == '-' ? "option" : "command", next);
    return fmt::format("{}; the commands are {} ({} --help)", fault, inner, program.get_name());
  }
  const std::string named = program.get_name() + (path.empty() ? "" : " ") + path;
  if (!inner.empty()) {
    return fmt::format("{}: name one of {} ({} --help)",
                       next.empty() ? path : fmt::format("there is no {} {}", path, next), inner, named);
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    return fmt::format("not understood: {} ({} --help)", fmt::join(program.remaining(true), " "), named);
  }
  std::string text = error.what();
  if (const std::size_t at = text.find(" was given a disallowed flag override"); at != std::string::npos) {
    text = fmt::format("{}{} takes no value", at == 1 ? "-" : "--", text.substr(0, at));
  }
  return fmt::format("{} ({} --help)", text, named);
}

// A flag takes no value: --force=5 is a mistake, which CLI11 would take for --force.
void refuse_values_of_flags(CLI::App& app) {
  for (CLI::Option* option :
       app.get_options([](const CLI::Option* each) { return each->get_items_expected_max() == 0; })) {
    option->disable_flag_override();
  }
  for (CLI::App* command : commands_of(app)) {
    refuse_values_of_flags(*command);
  }
}

// CLI11 has no notion of files: the kind of an option's value follows from its placeholder in the help.
WordKind kind_of(const OptionWords& option) {
  static const std::map<std::string, WordKind> kKinds = {{"", WordKind::kNothing},      {"FILE", WordKind::kFile},
                                                         {"SCENARIO", WordKind::kFile}, {"RECORDING", WordKind::kFile},
                                                         {"A", WordKind::kFile},        {"B", WordKind::kFile},
                                                         {"DIR", WordKind::kFolder},    {"PRESET", WordKind::kPreset}};
  const auto found = kKinds.find(option.value);
  return !option.value.empty() && !option.choices.empty() ? WordKind::kChoice
         : found == kKinds.end()                          ? WordKind::kAny
                                                          : found->second;
}

OptionWords option_words(const CLI::Option& option, const std::vector<std::string>& choices) {
  OptionWords words;
  words.short_names = option.get_snames();
  words.long_names = option.get_lnames();
  words.help = option.get_description();
  words.group = option.get_group();
  words.required = option.get_required();
  words.choices = choices;
  words.value = option.get_positional()               ? option.get_single_name()
                : option.get_items_expected_max() > 0 ? option.get_type_name()
                                                      : "";
  words.kind = kind_of(words);
  return words;
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

Command Command::add(const std::string& name, const std::string& help) const {
  app_->require_subcommand(1);
  return {*line_, *app_->add_subcommand(name, help)};
}

Command Command::under(const std::string& heading) const {
  Command command = *this;
  command.heading_ = heading;
  return command;
}

void Command::argument(const std::string& name, const Target& target, const std::string& help, const Check& check,
                       bool required) const {
  option(name, "", target, help, check);
  app_->get_option(name)->required(required);
}

void Command::option(const std::string& names, const std::string& value, const Target& target, const std::string& help,
                     const Check& check) const {
  CLI::Option* const option = std::visit(
      [&](const auto& to) {
        if constexpr (requires { to(std::string()); }) {
          return app_->add_option_function<std::string>(names, to, help);
        } else {
          return app_->add_option(names, *to, help);
        }
      },
      target);
  if (check.fault) {
    option->check(CLI::Validator([fault = check.fault](const std::string& text) { return fault(text); }, ""));
  }
  if (!check.choices.empty()) {
    line_->choices[option] = check.choices;
  }
  if (!value.empty()) {
    option->type_name(value)->group(heading_);
    if (option->get_items_expected_max() > 1 && !value.ends_with("...")) {
      option->expected(1)->take_all();
    }
  }
}

void Command::flag(const std::string& names, bool* target, const std::string& help) const {
  app_->add_flag(names, *target, help)->group(heading_);
}

void Command::print_flag(const std::string& names, const std::function<void()>& print, const std::string& help) const {
  const auto print_and_end = [print] {
    print();
    throw CLI::Success();
  };
  app_->add_flag_callback(names, print_and_end, help);
}

CLI::Option& Command::named(const std::string& name) const {
  return *app_->get_option(name);
}

void Command::require(const std::string& name) const {
  named(name).required();
}

void Command::exclude(const std::string& name, const std::vector<std::string>& others) const {
  for (const std::string& other : others) {
    if (CLI::Option* const option = app_->get_option_no_throw(other)) {
      named(name).excludes(option);
    }
  }
}

void Command::one_at_a_time(const std::string& name) const {
  named(name).allow_extra_args(false);
}

void Command::footer(const std::string& text) const {
  app_->footer(text);
}

void Command::allow_extras() const {
  app_->allow_extras();
}

std::vector<std::string> Command::remaining() const {
  return app_->remaining();
}

std::vector<std::string> Command::options() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : app_->get_options()) {
    // Not all by get_name(), which is empty for hidden options.
    names.push_back(option->get_lnames().empty() ? option->get_name() : "--" + option->get_lnames().front());
  }
  return names;
}

bool Command::given(const std::string& name) const {
  return named(name).count() > 0;
}

void Command::act(std::function<int()> function) const {
  app_->callback([line = line_, function = std::move(function)] { line->act = function; });
}

void Command::keep(std::shared_ptr<void> options) const {
  line_->kept.push_back(std::move(options));
}

std::vector<CommandWords> Command::words() const {
  std::vector<CommandWords> all;
  const auto add = [&](const auto& self, CLI::App& app, const std::string& path) -> void {
    CommandWords command;
    command.path = path;
    command.name = app.get_name();
    command.help = app.get_description();
    command.footer = app.get_footer();
    for (const CLI::Option* option : app.get_options()) {
      if (!option->get_group().empty()) {  // Hidden options have an empty group.
        (option->get_positional() ? command.arguments : command.options)
            .push_back(option_words(*option, line_->choices[option]));
      }
    }
    const std::string prefix = path.empty() ? "" : path + " ";
    for (const CLI::App* next : commands_of(app)) {
      command.commands.push_back(prefix + next->get_name());
    }
    all.push_back(std::move(command));
    for (CLI::App* next : commands_of(app)) {
      self(self, *next, prefix + next->get_name());
    }
  };
  add(add, *app_, "");
  return all;
}

CommandLine::CommandLine(const std::string& name, const std::string& help)
    : CommandLine(std::make_unique<Line>(name, help)) {
  app_->get_formatter()->column_width(34);
}

CommandLine::CommandLine(std::unique_ptr<Line> line) : Command(*line, line->app), owned_(std::move(line)) {}

CommandLine::~CommandLine() = default;

bool CommandLine::parse(std::vector<std::string> words) {
  refuse_values_of_flags(*app_);
  const std::vector<std::string> typed = words;
  std::ranges::reverse(words);  // CLI11 expects them reversed.
  try {
    app_->parse(std::move(words));
  } catch (const CLI::CallForHelp&) {
    say_text(app_->help());
    return false;
  } catch (const CLI::Success&) {
    return false;  // A flag has printed something.
  } catch (const CLI::ParseError& error) {
    throw InputError(explained(*app_, error, typed));
  }
  return true;
}

int CommandLine::run() const {
  return line_->act();
}

}  // namespace insonify
