// export.cpp -- insonify export: writes recordings in the formats of other tools.

#include "export/export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "insonify/export.h"
#include "insonify/recording_info.h"

namespace insonify {
namespace {

// Refuses endings that are no format, and options that do nothing for the format.
void check_effects(const ExportCommand& options) {
  static const std::map<std::string, std::vector<std::string>> kActsOn = {
      {"--bits", {".mcap"}},          {"--store", {".npz"}},
      {"--rate", {".mp4", ".gif"}},   {"--colour-map", {".mp4", ".gif", ".mcap"}},
      {"--height", {".mp4", ".gif"}}, {"--levels", {".mp4", ".gif", ".mcap"}}};
  const std::filesystem::path& file = options.file;
  std::string ending = (file.has_filename() ? file : file.parent_path()).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!std::set<std::string>{".mcap", ".npz", ".zarr", ".mp4", ".gif"}.contains(ending)) {
    throw InputError(
        fmt::format("{}: its ending must be .mcap, .npz, .zarr, .mp4 or .gif, which says the format", file.string()));
  }
  for (const std::string& name : options.given) {
    const std::vector<std::string>& endings = kActsOn.at(name);
    if (std::ranges::find(endings, ending) == endings.end()) {
      throw InputError(fmt::format("{} has no effect on {}, only on {}", name, ending, fmt::join(endings, ", ")));
    }
  }
}

// Every fault of the input is found here, before anything is written.
void check_input(const ExportCommand& options) {
  try {
    for (const std::filesystem::path& recording : options.recordings) {
      const RecordingInfo info = recording_info(recording);
      if (info.format == "MCAP") {
        throw Error(fmt::format("{}: is an MCAP file; insonify exports HDF5 recordings (.h5), which hold more",
                                recording.string()));
      }
      if (info.state == RecordingState::kUnfinished) {
        complain(fmt::format("warning: {} is unfinished: the run that wrote it was killed; it has {} pings",
                             recording.string(), info.sonars.front().pings));
      }
    }
  } catch (const Error& error) {
    throw InputError(error.what());
  }
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(options.file, ignored)) && !options.force) {
    throw InputError(fmt::format("{} is there already: --force replaces it", options.file.string()));
  }
}

}  // namespace

int export_command(const ExportCommand& options) {
  check_effects(options);
  check_input(options);
  const PictureStyle style = picture_style(options.pictures, EchoModel::kCalibrated, {});
  ExportOptions how{.replace = options.force, .compress = !options.store};
  how.messages = message_options(style);
  how.messages.bits = options.bits;
  how.video.rate = options.rate;
  how.video.low_db = how.messages.low_db;
  how.video.high_db = how.messages.high_db;
  how.video.colour_map = style.display.colour_map;
  how.video.height = style.display.height;
  note_when_asked();
  how.stop = &stop_asked();
  show_status(fmt::format("Writing {} ...", options.file.string()));
  export_recordings(options.recordings, options.file, how);
  say("{}\n", options.file.string());
  return kDone;
}

}  // namespace insonify
