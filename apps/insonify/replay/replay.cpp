// replay.cpp -- insonify replay: shows the recordings of a run in the viewer, or draws one.

#include <fmt/format.h>

#include <memory>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "insonify/recording_formats.h"
#include "insonify/recording_info.h"
#include "insonify/words.h"
#include "pictures/draw.h"
#include "replay/recording_player.h"
#include "serve/page_server.h"

namespace insonify {
namespace {

struct ReplayOptions {
  RecordedRunOptions run;
  PageServerOptions server;
  double speed = 1;  // Seconds of the recording in a second.
  bool paused = false;
};

// "fls.h5", "fls.h5 + 2".
std::string name_of(const std::vector<std::filesystem::path>& files) {
  const std::string first = files.front().filename().string();
  return files.size() == 1 ? first : fmt::format("{} + {}", first, files.size() - 1);
}

void check_replayed(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) {
    if (recording_info(file).model.empty()) {
      throw InputError(fmt::format(
          "{}: is not of a run of insonify, which --view shows; without it its pings are drawn", file.string()));
    }
  }
}

int replay(const ReplayOptions& options) {
  PageServer server(options.server);
  RecordedRun run = checked_input([&] {
    check_replayed(options.run.files);
    return RecordedRun(options.run, log_to_user(true));
  });
  RecordingPlayer player(run, name_of(options.run.files), recording_info(options.run.files.front()).markers,
                         options.paused);
  player.set_speed(options.speed);
  server.show(player, options.run.files.front());
  if (!options.server.quiet) {
    say("{} shown\n", counted(player.state().pings_made, "ping"));
  }
  return kDone;
}

// Options that were added to a command after some others.
std::vector<std::string> added_after(const std::vector<std::string>& others, const Command& command) {
  std::vector<std::string> options = command.options();
  options.erase(options.begin(), options.begin() + static_cast<std::ptrdiff_t>(others.size()));
  return options;
}

void refuse(const Command& command, const std::vector<std::string>& options, const char* why) {
  for (const std::string& option : options) {
    if (command.given(option)) {
      throw InputError(fmt::format("{} {}", option, why));
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

void add_replay(const Command& program) {
  const Command command = program.add("replay", "Show a recording's pings again: as pictures, or in a browser");
  auto& options = command.keep<ReplayOptions>();
  auto& drawn = command.keep<DrawOptions>();
  auto& in_viewer = command.keep<bool>();
  command.argument("RECORDING", &options.run.files,
                   fmt::format("Recording ({}) that insonify run or export has made; with --view several of one run",
                               readable_recordings()));
  command.option("--sonar", "NAME", &options.run.sonar, "Which sonar of a recording that has several");
  command.flag("--view", &in_viewer, "Show the pings in a browser, in their own time; else draw pictures");
  std::vector<std::string> before = command.options();
  add_draw_options(command, drawn);
  const std::vector<std::string> drawing = added_after(before, command);
  before = command.options();
  const Command viewer = command.under("Viewer");
  viewer.option("--speed", "X", &options.speed, "Seconds of the recording in a second, 0.01 to 100 [1]",
                number_within(from_to(0.01, 100)));
  viewer.flag("--paused", &options.paused, "Wait at the first ping");
  viewer.option("--folder", "DIR", &options.run.folder,
                "Folder of the scenario that was run, for the scene [searched beside the recording]",
                existing_folder());
  add_server_options(viewer, options.server);
  const std::vector<std::string> viewing = added_after(before, command);
  command.footer(std::string(kDrawOrReplay) +
                 "\nWith --view it prints the address of a page that plays the recordings; Ctrl-C ends it.\n\n"
                 "Examples:\n"
                 "  insonify replay out/fls.h5 -o pictures\n"
                 "  insonify replay run.mcap --sonar fls -o pictures --pictures last\n"
                 "  insonify replay out/fls.h5 out/msis.h5 --view");
  command.act([command, &options, &drawn, &in_viewer, drawing, viewing] {
    if (in_viewer) {
      refuse(command, drawing, "is for pictures, and has no effect with --view");
      return replay(options);
    }
    refuse(command, viewing, "is for the viewer, and has no effect without --view");
    return draw_one(options, drawn);
  });
}

}  // namespace insonify
