// export_recordings.cpp -- checks recordings and file, and hands them to the format of the file's ending.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/utf8.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/export/export_format.h"
#include "io/file/input_file.h"

namespace insonify {
namespace {

constexpr std::string_view kEndings = ".mcap, .npz, .zarr, .mp4 or .gif";

// Replacing something that is no export would be a mistake of the user's, not what --force means.
void check_place(const std::filesystem::path& file, const std::string& ending, bool replace) {
  std::error_code ignored;
  const std::filesystem::file_status there = std::filesystem::symlink_status(file, ignored);
  if (!std::filesystem::exists(there)) {
    return;
  }
  if (!replace) {
    throw Error(fmt::format("{}: cannot create: it is there already", file.string()));
  }
  const bool folder = std::filesystem::is_directory(there);
  if (ending == ".zarr" ? !folder || !std::filesystem::exists(file / ".zgroup", ignored) : folder) {
    throw Error(fmt::format("{}: cannot replace: it is {}", file.string(),
                            folder && ending == ".zarr" ? "a folder without .zgroup, no Zarr group"
                            : folder                    ? "a folder"
                                                        : "no folder"));
  }
}

std::string name_of(const RecordedTables& recording) {
  const std::string sonar = recording.text("sonar");
  return sonar.empty() ? recording.path().stem().string() : sonar;
}

void check_names(std::span<const RecordedTables> recordings) {
  std::map<std::string, std::filesystem::path> seen;
  for (const RecordedTables& recording : recordings) {
    // Names become those of folders and of entries in archives.
    if (const std::string name = name_of(recording);
        name == "." || name == ".." || name.find_first_of(std::string_view("/\\\0", 3)) != std::string::npos) {
      throw Error(fmt::format("{}: its sonar is called {}, which cannot be the name of a folder",
                              recording.path().string(), printable(name)));
    }
    const auto [other, is_new] = seen.emplace(name_of(recording), recording.path());
    if (!is_new) {
      throw Error(fmt::format("{} and {} are both of a sonar called {}; one file holds one recording of each",
                              other->second.string(), recording.path().string(), other->first));
    }
  }
}

}  // namespace

std::string prefix_of(std::span<const RecordedTables> recordings, std::size_t index) {
  return recordings.size() == 1 ? "" : name_of(recordings[index]) + "/";
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

void export_recordings(std::span<const std::filesystem::path> recordings, const std::filesystem::path& place,
                       const ExportOptions& options) {
  // A folder may be named with a slash at its end.
  const std::filesystem::path file = place.has_filename() ? place : place.parent_path();
  const std::string ending = ending_of(file);
  const bool video = ending == ".mp4" || ending == ".gif";
  if (!video && ending != ".mcap" && ending != ".npz" && ending != ".zarr") {
    throw Error(fmt::format("{}: its ending must be {}, which says the format", file.string(), kEndings));
  }
  if (recordings.empty()) {
    throw Error(fmt::format("{}: there is no recording to export", file.string()));
  }
  if (video && recordings.size() > 1) {
    throw Error(
        fmt::format("{}: a video shows one sonar, and there are {} recordings", file.string(), recordings.size()));
  }
  check_place(file, ending, options.replace);
  std::vector<RecordedTables> tables;
  for (const std::filesystem::path& recording : recordings) {
    if (tables.emplace_back(recording).ping_count() == 0) {
      throw Error(fmt::format("{}: there is no ping in it", recording.string()));
    }
  }
  check_names(tables);
  if (ending == ".mcap") {
    export_mcap(tables, file, options);
  } else if (ending == ".npz") {
    export_npz(tables, file, options);
  } else if (ending == ".zarr") {
    export_zarr(tables, file, options);
  } else {
    export_video(tables.front(), file, options);
  }
}

}  // namespace insonify
