// export.cpp -- insonify export: writes recordings in the formats of other tools.

#include "insonify/export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "insonify/recording_formats.h"
#include "insonify/recording_info.h"
#include "insonify/sound_speed_files.h"
#include "pictures/picture_options.h"

namespace insonify {
namespace {

struct ExportCommand {
  std::vector<std::filesystem::path> recordings;
  std::string sonar;  // Sonar of recordings with several; "" for all.
  std::filesystem::path file;
  bool force = false;               // Replace a file that is there.
  int bits = 16;                    // Bits of a value of sonar images in .mcap, 8 or 16.
  MessageChoice messages;           // What the messages of .mcap and .bag hold.
  bool store = false;               // Leave .npz uncompressed.
  std::string origin = {};          // Latitude and longitude of the world's origin, for survey files; "": none.
  bool uncertainty = false;         // A fourth column of .xyz.
  std::filesystem::path profile;    // Sound speeds by which soundings are placed; "": straight rays.
  std::optional<double> rate = {};  // Pictures a second of a video.
  PictureOptions pictures;          // Colours and levels.
  std::vector<std::string> given;   // Names of the options that act on some formats only and were given.
};

// Refuses options that do nothing for the format.
void check_effects(const ExportCommand& options) {
  static const std::map<std::string, std::vector<std::string>> kActsOn = {
      {"--bits", {".mcap", ".bag"}},
      {"--fan-rate", {".mcap", ".bag"}},
      {"--start", {".mcap", ".bag", ".xtf", ".jsf", ".gsf", ".kmall"}},
      {"--store", {".npz"}},
      {"--origin", {".xtf", ".jsf", ".xyz", ".gsf", ".kmall"}},
      {"--uncertainty", {".xyz"}},
      {"--profile", {".xyz", ".gsf", ".kmall"}},
      {"--rate", {".mp4", ".gif"}},
      {"--colour-map", {".mp4", ".gif", ".mcap", ".bag"}},
      {"--height", {".mp4", ".gif"}},
      {"--levels", {".mp4", ".gif", ".mcap", ".bag"}}};
  const std::filesystem::path& file = options.file;
  std::string ending = (file.has_filename() ? file : file.parent_path()).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::ranges::none_of(export_kinds(), [&](const ExportKind& kind) { return kind.ending == ending; })) {
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

// Damage that only a ping itself shows is wrong input, as a recording that cannot be opened is.
void export_checked(const ExportCommand& options, const std::vector<RecordingPart>& parts, const ExportOptions& how) {
  try {
    export_recordings(std::span<const RecordingPart>(parts), options.file, how);
  } catch (const Error& error) {
    const std::string_view message = error.what();
    const auto is_of = [&](const std::filesystem::path& file) { return message.starts_with(file.string() + ": "); };
    if (std::ranges::any_of(options.recordings, is_of)) {
      throw InputError(error.what());
    }
    throw;
  }
}

int export_command(const ExportCommand& options) {
  const PictureStyle style = picture_style(options.pictures, EchoModel::kCalibrated, {});
  ExportOptions how{.replace = options.force, .compress = !options.store};
  how.messages = message_options(style, options.messages);
  how.messages.bits = options.bits;
  how.log = [](Severity, const std::string& message) { complain("warning: " + message + "; --levels changes that"); };
  how.origin = parsed_origin(options.origin);
  how.uncertainty = options.uncertainty;
  if (!options.profile.empty()) {
    checked_input([&] { how.profile = load_sound_speed_profile(options.profile, log_to_user(false)); });
  }
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
  export_checked(options, parts, how);
  say("{}\n", options.file.string());
  return kDone;
}

}  // namespace

void add_export(const Command& program) {
  const Command command = program.add("export", "Write recordings in a format that other tools read");
  auto& options = command.keep<ExportCommand>();
  auto& bits = command.keep<std::string>();
  command.argument("RECORDING", &options.recordings, fmt::format("Recordings ({}) of one run", readable_recordings()));
  command.option("-o,--output", "FILE", &options.file, "File to write; its extension is the format",
                 not_empty("a file, such as run.mcap"));
  command.require("--output");
  command.option("--sonar", "NAME", &options.sonar, "Only this sonar of a recording that has several [all]");
  command.flag("-f,--force", &options.force, "Replace FILE if it exists");
  command.option("--bits", "N", &bits, "Bits of the values of sonar images in .mcap and .bag, 8 or 16 [16]",
                 one_of({"8", "16"}));
  add_message_choice(command, options.messages, "in .mcap and .bag", "[that of the recordings, else 1970]");
  command.flag("--store", &options.store, "Do not compress .npz");
  command.option("--origin", "LAT,LON", &options.origin,
                 "Where the world's origin is [deg], for positions in survey files [metres]; .gsf and .kmall need it",
                 origin());
  command.flag("--uncertainty", &options.uncertainty, "Standard deviations of depths as a fourth column of .xyz");
  command.option("--profile", "FILE", &options.profile,
                 "Sound-speed profile (.csv, .svp, .asvp) along whose rays soundings are placed; it need not be "
                 "that of the water [straight rays]",
                 not_empty("a file, such as cast.svp"));
  command.option("--rate", "N", &options.rate,
                 "Frames per second of a video [as fast as the pings were made, at most 50]",
                 number_within(above_to(0, 120)));
  add_picture_options(command.under("Pictures"), options.pictures, false);
  std::string formats;
  for (const ExportKind& kind : export_kinds()) {
    formats += fmt::format("  {:<8}{}\n", kind.ending, kind.contents);
  }
  command.footer(
      "Formats, by the extension of FILE:\n" + formats +
      "--colour-map, --levels and --height act on videos. In .mcap and .bag --levels acts on the values of sonar\n"
      "images and on fan pictures, --colour-map on those.\n\n"
      "Examples:\n"
      "  insonify export out/fls.h5 out/profiler.h5 -o out/run.mcap\n"
      "  insonify export run.mcap --sonar fls -o fls.npz\n"
      "  insonify export out/fls.h5 -o fls.gif --levels -90:-40 --height 480");
  command.act([command, &options, &bits] {
    for (const char* name : {"--bits", "--store", "--rate", "--height", "--colour-map", "--levels", "--origin",
                             "--uncertainty", "--profile"}) {
      if (command.given(name)) {
        options.given.emplace_back(name);
      }
    }
    const std::vector<std::string> messages = options.messages.given();
    options.given.insert(options.given.end(), messages.begin(), messages.end());
    options.bits = bits == "8" ? 8 : 16;
    return export_command(options);
  });
}

}  // namespace insonify
