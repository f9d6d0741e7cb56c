// export.cpp -- insonify export: writes recordings in the formats of other tools.

#include "export/export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "insonify/export.h"
#include "insonify/recording_info.h"

namespace insonify {
namespace {

// Refuses options that do nothing for the format.
void check_effects(const ExportCommand& options) {
  static const std::map<std::string, std::vector<std::string>> kActsOn = {
      {"--bits", {".mcap", ".bag"}},  {"--fan-rate", {".mcap", ".bag"}},
      {"--start", {".mcap", ".bag"}}, {"--store", {".npz"}},
      {"--rate", {".mp4", ".gif"}},   {"--colour-map", {".mp4", ".gif", ".mcap", ".bag"}},
      {"--height", {".mp4", ".gif"}}, {"--levels", {".mp4", ".gif", ".mcap", ".bag"}}};
  const std::filesystem::path& file = options.file;
  std::string ending = (file.has_filename() ? file : file.parent_path()).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::ranges::find(export_endings(), ending) == export_endings().end()) {
    return;  // check_export() says so.
  }
  for (const std::string& name : options.given) {
    const std::vector<std::string>& endings = kActsOn.at(name);
    if (std::ranges::find(endings, ending) == endings.end()) {
      throw InputError(fmt::format("{} has no effect on {}, only on {}", name, ending, fmt::join(endings, ", ")));
    }
  }
}

// Every fault of the input is found here, before anything is written.
void check_input(const ExportCommand& options, const std::vector<RecordingPart>& parts, const ExportOptions& how) {
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(options.file, ignored)) && !options.force) {
    throw InputError(fmt::format("{} exists already: --force replaces it", options.file.string()));
  }
  checked_input([&] {
    check_export(parts, options.file, how);
    for (const std::filesystem::path& recording : options.recordings) {
      if (const std::string text = unfinished_text(recording, recording_info(recording)); !text.empty()) {
        complain("warning: " + text);
      }
    }
  });
}

}  // namespace

int export_command(const ExportCommand& options) {
  const PictureStyle style = picture_style(options.pictures, EchoModel::kCalibrated, {});
  ExportOptions how{.replace = options.force, .compress = !options.store};
  how.messages = message_options(style, options.messages);
  how.messages.bits = options.bits;
  how.log = [](Severity, const std::string& message) { complain("warning: " + message + "; --levels changes that"); };
  how.video.rate = options.rate;
  how.video.low_db = how.messages.low_db;
  how.video.high_db = how.messages.high_db;
  how.video.colour_map = style.display.colour_map;
  how.video.height = style.display.height;
  std::vector<RecordingPart> parts;
  for (const std::filesystem::path& recording : options.recordings) {
    parts.push_back({recording, options.sonar});
  }
  check_effects(options);
  check_input(options, parts, how);
  note_when_asked();
  how.stop = &stop_asked();
  show_status(fmt::format("Writing {} ...", options.file.string()));
  export_recordings(std::span<const RecordingPart>(parts), options.file, how);
  say("{}\n", options.file.string());
  return kDone;
}

}  // namespace insonify
