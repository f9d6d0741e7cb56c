// recording_formats.h -- table of the formats that pings are recorded in.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/files.h"
#include "insonify/mcap_recording.h"
#include "insonify/ping_sink.h"

namespace insonify {

/// Options of recordings; each format takes its own.
struct RecordOptions {
  RecordingOptions h5 = {};
  McapOptions mcap = {};  ///< Its run is filled in.
};

/// The run that a recording is of.
struct RunToRecord {
  const Scenario& scenario;
  const Scene& scene;
  std::span<const SonarConfig> sonars;  ///< Those that are recorded, with everything filled in.
};

/// A format of recordings.
struct RecordingFormat {
  std::string_view name;      ///< "h5"; with a dot before it, the ending of its files in lower case.
  std::string_view title;     ///< Its name for users: "HDF5".
  std::string_view contents;  ///< What its files hold, for the help of `insonify run`.
  bool holds_all;             ///< Whether one file holds several sonars; else each has a file of its own.
  bool has_messages;          ///< Whether it holds pings as messages, by MessageOptions.
  bool can_compress;          ///< Whether it can be compressed or not, as RecordingOptions::compress says.
  bool readable;              ///< Whether RecordedPings reads it.

  /// Opens a recording. @throws Error when the file cannot be made, or is there and may not be replaced.
  std::unique_ptr<PingSink> (*open)(const std::filesystem::path& path, const RunToRecord& run,
                                    const RecordOptions& options);

  /// Bytes on the disk that so many pings of one sonar need at most.
  std::uint64_t (*bytes)(const Scenario& scenario, const SonarConfig& sonar, std::uint64_t pings,
                         const MessageOptions& messages);

  [[nodiscard]] std::string ending() const { return "." + std::string(name); }
};

/// All formats. The first is the usual one, and exact.
[[nodiscard]] std::span<const RecordingFormat> recording_formats();

/// The format of a file by its ending, in capitals or not; null for no recording.
[[nodiscard]] const RecordingFormat* recording_format(const std::filesystem::path& file);

/// Whether a file is a recording that can be read, by its ending: that of a format, or .hdf5.
[[nodiscard]] bool is_recording(const std::filesystem::path& file);

/// Names or endings of formats with a text between them: "h5, mcap".
/// @param which  A property that they have; null: all formats.
[[nodiscard]] std::string recording_names(std::string_view before, std::string_view between,
                                          bool RecordingFormat::*which = nullptr);

/// Endings of the formats that RecordedPings reads: ".h5, .mcap".
[[nodiscard]] inline std::string readable_recordings() {
  return recording_names(".", ", ", &RecordingFormat::readable);
}

}  // namespace insonify
