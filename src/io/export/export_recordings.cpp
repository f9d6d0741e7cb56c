// export_recordings.cpp -- checks recordings and file, and calls the exporter for the file's extension.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "base/utf8.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/export/export_format.h"
#include "io/file/input_file.h"
#include "io/recorded/open_recording.h"

namespace insonify {
namespace {

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

struct ExportFormat : ExportKind {
  void (*write)(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options);
  std::string_view mark = {};  // A file in every export of the format, which is a folder; "": it is a file.
  std::size_t most_sonars = kAny;
  std::optional<SonarType> only = {};  // The type of sonar that it holds.
  bool on_earth = false;               // Whether it needs an origin.
};

constexpr std::size_t kMostSideScans = 3;  // Six channels of an XTF header, three frequencies of EdgeTech's.

constexpr SonarType kSideScan = SonarType::kSideScan, kMultibeam = SonarType::kMultibeam;

// In the order in which messages list them.
constexpr ExportFormat kFormats[] = {
    {{".mcap", "ROS 2 messages of all sonars, for Foxglove and ros2 bag"}, export_mcap},
    {{".bag", "ROS 1 messages of all sonars, for rosbag"}, export_bag},
    {{".npz", "NumPy arrays: numpy.load(FILE)[\"intensity\"]"}, export_npz},
    {{".zarr", "a folder of chunked arrays, one chunk a ping"}, export_zarr, ".zgroup"},
    {{".xtf", "side-scan sonars with navigation, for survey programs"}, export_xtf, "", kMostSideScans, kSideScan},
    {{".jsf", "the same as files of EdgeTech's"}, export_jsf, "", kMostSideScans, kSideScan},
    {{".xyz", "soundings of multibeams as text: x y z"}, export_xyz, "", kAny, kMultibeam},
    {{".gsf", "soundings of a multibeam with navigation, for survey programs"}, export_gsf, "", 1, kMultibeam, true},
    {{".kmall", "the same as files of Kongsberg's"}, export_kmall, "", 1, kMultibeam, true},
    {{".mp4", "the fan of one sonar, by the program ffmpeg"}, export_video, "", 1},
    {{".gif", "the same as a moving picture"}, export_video, "", 1}};

const ExportFormat* format_of(const std::filesystem::path& file) {
  const auto* const found = std::ranges::find(kFormats, ending_of(file), &ExportFormat::ending);
  return found == std::end(kFormats) ? nullptr : found;
}

// Replacing something that is not an export would be a mistake, not what --force means.
void check_place(const std::filesystem::path& file, const ExportFormat& format, bool replace) {
  std::error_code ignored;
  const std::filesystem::file_status there = std::filesystem::symlink_status(file, ignored);
  if (!std::filesystem::exists(there)) {
    return;
  }
  if (!replace) {
    throw Error(fmt::format("{}: cannot create: it exists already", file.string()));
  }
  const bool folder = std::filesystem::is_directory(there), wanted = !format.mark.empty();
  if (folder != wanted) {
    throw Error(fmt::format("{}: cannot replace: it is {}", file.string(), folder ? "a folder" : "no folder"));
  }
  if (wanted && !std::filesystem::exists(file / format.mark, ignored)) {
    throw Error(fmt::format("{}: cannot replace: it is a folder without {}", file.string(), format.mark));
  }
}

std::string name_of(const RecordedTables& recording) {
  const std::string sonar = recording.text("sonar");
  return sonar.empty() ? recording.path().stem().string() : sonar;
}

void check_names(RecordedSonars recordings) {
  std::map<std::string, std::filesystem::path> seen;
  for (const auto& recording : recordings) {
    // Names become folders and entries in archives.
    const std::string name = name_of(*recording);
    if (name == "." || name == ".." || name.find_first_of(std::string_view("/\\\0", 3)) != std::string::npos) {
      throw Error(fmt::format("{}: its sonar is called {}, which cannot be the name of a folder",
                              recording->path().string(), printable(name)));
    }
    const auto [other, is_new] = seen.emplace(name, recording->path());
    if (!is_new) {
      throw Error(fmt::format("{} and {} are both of a sonar called {}; one file holds one recording of each",
                              other->second.string(), recording->path().string(), other->first));
    }
  }
}

// Whether the format can hold these sonars.
void check_kinds(const std::filesystem::path& file, const ExportFormat& format, RecordedSonars recordings) {
  if (recordings.size() > format.most_sonars) {
    std::vector<std::string> names;
    for (const auto& recording : recordings) {
      names.push_back(name_of(*recording));
    }
    throw Error(fmt::format(
        "{}: a {}, and there are {}: {}", file.string(),
        format.only ? fmt::format("file of {} holds at most {}", format.ending, counted(format.most_sonars, "sonar"))
                    : "video shows one sonar",
        names.size(), printable(fmt::format("{}", fmt::join(names, ", ")))));
  }
  for (const auto& recording : recordings) {
    if (format.only && recording->sonar_config().type != *format.only) {
      throw Error(fmt::format("{}: its sonar {} is not a {}; {} holds these alone", recording->path().string(),
                              printable(name_of(*recording)),
                              *format.only == kSideScan ? "side-scan sonar" : "multibeam", format.ending));
    }
  }
}

// A file holds one run. Recordings of other programs do not identify their run.
void check_run(RecordedSonars recordings) {
  const RecordedTables& first = *recordings.front();
  for (const auto& recording : recordings) {
    const auto refuse = [&](const std::string& what) {
      throw Error(fmt::format("{} and {} are of different runs: {}; export each run to a file of its own",
                              first.path().string(), recording->path().string(), what));
    };
    for (const char* name : {"seed", "model", "scenario", "start"}) {
      const auto one = first.attributes().find(name), other = recording->attributes().find(name);
      if (one == first.attributes().end() || other == recording->attributes().end() || *one == *other) {
        continue;
      }
      refuse(std::string(name) == "scenario"
                 ? "their scenarios differ"
                 : fmt::format("their {}s are {} and {}", name, one->is_string() ? first.text(name) : one->dump(),
                               other->is_string() ? recording->text(name) : other->dump()));
    }
  }
}

// The checked inputs of an export: its sonars, and its file without a trailing slash.
struct Checked {
  std::filesystem::path file;
  const ExportFormat* format = nullptr;
  std::vector<std::unique_ptr<RecordedTables>> sonars;
};

Checked checked(std::span<const RecordingPart> recordings, const std::filesystem::path& place,
                const ExportOptions& options) {
  Checked found;
  // A folder may be named with a trailing slash.
  const ExportFormat* const of_folder = place.has_filename() ? nullptr : format_of(place.parent_path());
  found.file = of_folder != nullptr && !of_folder->mark.empty() ? place.parent_path() : place;
  found.format = format_of(found.file);
  if (found.format == nullptr) {
    throw Error(
        fmt::format("{}: its ending must be {}, which says the format", found.file.string(), export_endings(" or ")));
  }
  if (recordings.empty()) {
    throw Error(fmt::format("{}: there is not a recording to export", found.file.string()));
  }
  check_place(found.file, *found.format, options.replace);
  if (options.origin) {
    check_origin(*options.origin);
  } else if (found.format->on_earth) {
    throw Error(fmt::format("{}: {} holds latitudes and longitudes, for which an origin is needed", found.file.string(),
                            found.format->ending));
  }
  for (const RecordingPart& recording : recordings) {
    for (auto& sonar : open_all_tables(recording.path, recording.sonar)) {
      if (sonar->ping_count() == 0) {
        throw Error(fmt::format("{}: there is no ping in it", recording.path.string()));
      }
      found.sonars.push_back(std::move(sonar));
    }
  }
  check_kinds(found.file, *found.format, found.sonars);
  check_names(found.sonars);
  check_run(found.sonars);
  return found;
}

}  // namespace

std::string prefix_of(RecordedSonars recordings, std::size_t index) {
  return recordings.size() == 1 ? "" : name_of(*recordings[index]) + "/";
}

nlohmann::json facts_of(const RecordedTables& recording) {
  nlohmann::json facts = recording.attributes();
  facts["settings"] = recording.settings();
  return facts;
}

UnicodeTable unicode_table(const std::vector<std::string>& texts) {
  std::vector<std::u32string> characters;
  std::size_t longest = 1;
  for (const std::string& text : texts) {
    std::u32string& decoded = characters.emplace_back();
    for (std::string_view rest = text; !rest.empty();) {
      decoded += take_code_point(rest);
    }
    longest = std::max(longest, decoded.size());
  }
  UnicodeTable table{fmt::format("<U{}", longest), {}};
  for (std::u32string& text : characters) {
    text.resize(longest, U'\0');
    const auto bytes = std::as_bytes(std::span(text));
    table.bytes.insert(table.bytes.end(), bytes.begin(), bytes.end());
  }
  return table;
}

std::vector<ExportKind> export_kinds() {
  return {std::begin(kFormats), std::end(kFormats)};
}

std::string export_endings(std::string_view before_last) {
  std::string endings;
  for (const ExportFormat& format : kFormats) {
    const std::string_view between = &format == &std::end(kFormats)[-1] ? before_last : ", ";
    endings.append(endings.empty() ? "" : between).append(format.ending);
  }
  return endings;
}

void check_export(std::span<const RecordingPart> recordings, const std::filesystem::path& file,
                  const ExportOptions& options) {
  static_cast<void>(checked(recordings, file, options));
}

void export_recordings(std::span<const RecordingPart> recordings, const std::filesystem::path& file,
                       const ExportOptions& options) {
  const Checked found = checked(recordings, file, options);
  found.format->write(found.sonars, found.file, options);
}

void export_recordings(std::span<const std::filesystem::path> recordings, const std::filesystem::path& file,
                       const ExportOptions& options) {
  std::vector<RecordingPart> parts;
  for (const std::filesystem::path& path : recordings) {
    parts.push_back({path});
  }
  export_recordings(std::span<const RecordingPart>(parts), file, options);
}

}  // namespace insonify
