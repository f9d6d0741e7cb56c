// request_shell.cpp -- options of `insonify completion` and `insonify manual`.

#include "console/console.h"
#include "console/outcome.h"
#include "console/validators.h"
#include "request.h"
#include "shell/shell_texts.h"

namespace insonify {

void add_completion(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("completion", "Write the script that completes these commands in a shell");
  command->add_option("SHELL", request.shell, "bash, zsh or fish")->required()->check(one_of({"bash", "zsh", "fish"}));
  command->footer(
      "Installed packages hold these scripts where the shells look for them. For a build of your own:\n"
      "  source <(insonify completion bash)                    # in ~/.bashrc\n"
      "  source <(insonify completion zsh)                     # in ~/.zshrc, after compinit\n"
      "  insonify completion fish | source                     # in ~/.config/fish/config.fish");
  command->callback([&app, &request] {
    request.act = [&app, &request] {
      const std::vector<CommandWords> words = command_words(app);
      say_text(request.shell == "bash"  ? bash_completion(words)
               : request.shell == "zsh" ? zsh_completion(words)
                                        : fish_completion(words));
      return kDone;
    };
  });
}

void add_manual(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("manual", "Write the manual page, insonify(1)");
  command->footer("Example:\n  insonify manual | man -l -");
  command->callback([&app, &request] {
    request.act = [&app] {
      say_text(manual_page(command_words(app)));
      return kDone;
    };
  });
}

}  // namespace insonify
