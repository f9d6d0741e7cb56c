// request_replay.cpp -- options of `insonify replay`.

#include <fmt/format.h>

#include "console/outcome.h"
#include "console/validators.h"
#include "request.h"

namespace insonify {
namespace {

// Options that a function adds to a command.
template <typename Add>
std::vector<CLI::Option*> added(CLI::App& command, Add&& add) {
  const std::vector<CLI::Option*> before = command.get_options();
  add();
  std::vector<CLI::Option*> options = command.get_options();
  options.erase(options.begin(), options.begin() + static_cast<std::ptrdiff_t>(before.size()));
  return options;
}

void refuse(const std::vector<CLI::Option*>& options, const char* why) {
  for (const CLI::Option* option : options) {
    if (option->count() > 0) {
      throw InputError(fmt::format("{} {}", option->get_name(), why));
    }
  }
}

// Pictures are drawn of one recording.
int draw_one(const ReplayOptions& replay, DrawOptions draw_options) {
  if (replay.run.files.size() > 1) {
    throw InputError(fmt::format("{}: pictures are drawn of one recording at a time; several are shown with --view",
                                 replay.run.files[1].string()));
  }
  draw_options.recording = replay.run.files.front();
  draw_options.sonar = replay.run.sonar;
  return draw(draw_options);
}

}  // namespace

void add_replay(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("replay", "Show a recording's pings again: as pictures, or in a browser");
  ReplayOptions& options = request.replay;
  command
      ->add_option("RECORDING", options.run.files,
                   "Recording (.h5, .mcap) that insonify run or export has made; with --view several of one run")
      ->required();
  command->add_option("--sonar", options.run.sonar, "Which sonar of a recording that has several")->type_name("NAME");
  command->add_flag("--view", request.in_viewer, "Show the pings in a browser, in their own time; else draw pictures");
  const std::vector<CLI::Option*> drawing = added(*command, [&] { add_draw_options(*command, request.draw); });
  const std::vector<CLI::Option*> viewing = added(*command, [&] {
    const std::string group = "Viewer";
    command->add_option("--speed", options.speed, "Seconds of the recording in a second, 0.01 to 100 [1]")
        ->check(number_within(from_to(0.01, 100)))
        ->type_name("X")
        ->group(group);
    command->add_flag("--paused", options.paused, "Wait at the first ping")->group(group);
    command
        ->add_option("--folder", options.run.folder,
                     "Folder of the scenario that was run, for the scene [searched beside the recording]")
        ->check(CLI::Validator(CLI::ExistingDirectory).description(""))
        ->type_name("DIR")
        ->group(group);
    add_server_options(*command, options.server, group);
  });
  command->footer(
      "Without --view it draws what insonify draw does. With it, it prints the address of a page that plays the\n"
      "recordings; Ctrl-C ends it.\n\n"
      "Examples:\n"
      "  insonify replay out/fls.h5 -o pictures\n"
      "  insonify replay run.mcap --sonar fls -o pictures --pictures last\n"
      "  insonify replay out/fls.h5 out/msis.h5 --view");
  command->callback([&request, &options, drawing, viewing] {
    if (request.in_viewer) {
      refuse(drawing, "is for pictures, and has no effect with --view");
      request.act = [&options] { return replay(options); };
    } else {
      refuse(viewing, "is for the viewer, and has no effect without --view");
      request.act = [&request, &options] { return draw_one(options, request.draw); };
    }
  });
}

}  // namespace insonify
