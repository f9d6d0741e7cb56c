// replay.cpp -- insonify replay --view.

#include "replay/replay.h"

#include <fmt/format.h>

#include <memory>

#include "console/console.h"
#include "console/outcome.h"
#include "insonify/words.h"
#include "replay/recording_player.h"

namespace insonify {
namespace {

RecordedRun open(const ReplayOptions& options) {
  try {
    return {options.run, [](Severity severity, const std::string& message) {
              if (severity == Severity::kWarning) {
                complain("warning: " + message);
              }
            }};
  } catch (const Error& error) {
    throw InputError(error.what());
  }
}

// "fls.h5", "fls.h5 + 2".
std::string name_of(const std::vector<std::filesystem::path>& files) {
  const std::string first = files.front().filename().string();
  return files.size() == 1 ? first : fmt::format("{} + {}", first, files.size() - 1);
}

}  // namespace

int replay(const ReplayOptions& options) {
  PageServer server(options.server);
  RecordedRun run = open(options);
  RecordingPlayer player(run, name_of(options.run.files), options.paused);
  player.set_speed(options.speed);
  server.show(player, options.run.files.front());
  if (!options.server.quiet) {
    say("{} shown\n", counted(player.state().pings_made, "ping"));
  }
  return kDone;
}

}  // namespace insonify
