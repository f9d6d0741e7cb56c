// command.h -- commands and options of a command line. CLI11, which parses it, is included in command.cpp alone: its
// templates take long to compile.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "console/validators.h"

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
class Option;
}  // namespace CLI

namespace insonify {

/// What the value of an option or argument is stored in, or passed to. It must outlive the command line.
using Target = std::variant<std::string*, std::filesystem::path*, int*, double*, std::uint64_t*, std::optional<int>*,
                            std::optional<double>*, std::vector<std::string>*, std::vector<std::filesystem::path>*,
                            std::vector<int>*, std::vector<std::uint64_t>*, std::function<void(const std::string&)>>;

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

/// A command of a command line, or the program itself. A reference to it: copies stand for the same command.
class Command {
 public:
  /// Adds a command to this one, which then needs one of them.
  [[nodiscard]] Command add(const std::string& name, const std::string& help) const;

  /// The same command; what is added by the result stands below this heading of the help.
  [[nodiscard]] Command under(const std::string& heading) const;

  void argument(const std::string& name, const Target& target, const std::string& help, const Check& check = {},
                bool required = true) const;

  /// @param names  "-o,--output"
  /// @param value  Placeholder of the value in the help: "DIR". Lists may be repeated; after "N ..." several values may
  ///               follow the option at once.
  void option(const std::string& names, const std::string& value, const Target& target, const std::string& help,
              const Check& check = {}) const;
  void flag(const std::string& names, bool* target, const std::string& help) const;

  /// A flag that prints something and ends the program.
  void print_flag(const std::string& names, const std::function<void()>& print, const std::string& help) const;

  /// An option without which the command line is wrong.
  void require(const std::string& name) const;
  /// An option that excludes others; those that the command does not have are ignored.
  void exclude(const std::string& name, const std::vector<std::string>& others) const;
  /// Each value of an option that may be repeated needs the option before it.
  void one_at_a_time(const std::string& name) const;

  /// Text after the options in the help.
  void footer(const std::string& text) const;

  /// Unknown words are not an error; remaining() returns them.
  void allow_extras() const;
  [[nodiscard]] std::vector<std::string> remaining() const;

  /// Options and arguments so far, by the names that messages give them: "--output".
  [[nodiscard]] std::vector<std::string> options() const;
  /// Whether an option was on the command line.
  [[nodiscard]] bool given(const std::string& name) const;

  /// What the command does once its line is parsed. @return  The exit status of the program.
  void act(std::function<int()> function) const;

  /// New options, for targets, that live as long as the command line.
  template <typename Options>
  [[nodiscard]] Options& keep() const {
    auto options = std::make_shared<Options>();
    keep(options);
    return *options;
  }

  /// Everything about this command and those below it, each before its own.
  [[nodiscard]] std::vector<CommandWords> words() const;

 protected:
  struct Line;
  Command(Line& line, CLI::App& app) : line_(&line), app_(&app) {}

  Line* line_;
  CLI::App* app_;
  std::string heading_ = "Options";

 private:
  void keep(std::shared_ptr<void> options) const;
  CLI::Option& named(const std::string& name) const;
};

/// The command line of a program.
class CommandLine : public Command {
 public:
  /// @param name  "insonify", or "insonify bridge dds" for a program that is called so.
  CommandLine(const std::string& name, const std::string& help);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Reads a command line, without the program. Prints the help if that is asked for.
  /// @return  False if all is done by that.
  /// @throws InputError, with a hint, for a line that is wrong.
  [[nodiscard]] bool parse(std::vector<std::string> words);

  /// Does what the command does that was parsed.
  [[nodiscard]] int run() const;

 private:
  explicit CommandLine(std::unique_ptr<Line> line);
  std::unique_ptr<Line> owned_;
};

}  // namespace insonify
