// shell_commands.cpp -- insonify completion and insonify manual: write what other files here make of the command line.

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "insonify/describe.h"
#include "shell/shell_texts.h"

namespace insonify {
namespace {

// All commands; `insonify describe` can be followed by the name of a section.
std::vector<CommandWords> words_of(const Command& program) {
  std::vector<CommandWords> all = program.words();
  for (CommandWords& command : all) {
    for (OptionWords& argument : command.arguments) {
      if (argument.value == "SECTION") {
        argument.kind = WordKind::kChoice;
        for (const SectionDescription& section : describe_scenario()) {
          argument.choices.push_back(section.name);
        }
      }
    }
  }
  return all;
}

}  // namespace

void add_completion(const Command& program) {
  const Command command = program.add("completion", "Write the script that completes these commands in a shell");
  auto& shell = command.keep<std::string>();
  command.argument("SHELL", &shell, "bash, zsh or fish", one_of({"bash", "zsh", "fish"}));
  command.footer(
      "Installed packages hold these scripts where the shells look for them. For a build of your own:\n"
      "  source <(insonify completion bash)                    # in ~/.bashrc\n"
      "  source <(insonify completion zsh)                     # in ~/.zshrc, after compinit\n"
      "  insonify completion fish | source                     # in ~/.config/fish/config.fish");
  command.act([program, &shell] {
    const std::vector<CommandWords> words = words_of(program);
    say_text(shell == "bash"  ? bash_completion(words)
             : shell == "zsh" ? zsh_completion(words)
                              : fish_completion(words));
    return kDone;
  });
}

void add_manual(const Command& program) {
  const Command command = program.add("manual", "Write the manual page, insonify(1)");
  command.footer("Example:\n  insonify manual | man -l -");
  command.act([program] {
    say_text(manual_page(words_of(program)));
    return kDone;
  });
}

}  // namespace insonify
