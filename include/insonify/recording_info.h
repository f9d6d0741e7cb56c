// recording_info.h -- summary of a recording, without reading its pings.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/marker.h"
#include "insonify/messages.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Whether a recording was closed properly.
enum class RecordingState {
  kWhole,
  kGrowing,     ///< A run is writing it.
  kUnfinished,  ///< The run that wrote it was killed (of MCAP: or its disk was full); its pings can be read.
  kDiskFull     ///< It was closed properly, before the end of its run, because the disk was full.
};

/// Name of the state in files and Python: "whole", "growing", "unfinished", "disk_full".
[[nodiscard]] const char* state_word(RecordingState state);

/// The state in words: "unfinished: the run that wrote it was killed"; "" for a whole recording.
/// @param format  Format of the recording: RecordingInfo::format.
[[nodiscard]] const char* state_text(RecordingState state, std::string_view format);

/// Reads only the state of a recording.
/// @throws Error with the path for a file that is missing or not a recording.
[[nodiscard]] RecordingState recording_state(const std::filesystem::path& path);

/// Precision of a recording's intensities.
struct RecordedLevels {
  MessageLevels levels;
  int bits = 16;          ///< Bits per value, 8 or 16.
  std::string text = {};  ///< "-100 to -40 dB in steps of 0.00092 dB ...".
};

/// One sonar's part of a recording.
struct RecordedSonar {
  SonarConfig config;  ///< With everything filled in.
  std::uint64_t pings = 0;
  double first_time = 0, last_time = 0;       ///< Times of its first and last ping [s]; 0 without pings.
  std::optional<RecordedLevels> levels = {};  ///< Levels of an MCAP file's values; absent: 32-bit numbers (HDF5).
};

struct RecordingInfo {
  std::string format = {};  ///< "HDF5", "MCAP", or RecordedPings::foreign_format().
  RecordingState state = RecordingState::kWhole;
  std::uint64_t bytes = 0;   ///< Size of the file.
  std::string version = {};  ///< Version of insonify that wrote it.
  std::string model = {};    ///< "calibrated" or "paper".
  std::string engine = {};   ///< "cpu", "reference".
  std::optional<std::uint64_t> seed = {};
  std::optional<std::uint64_t> start_ns =
      {};                     ///< Time 0 of the pings, since 1970-01-01T00:00:00Z [ns]; absent: unknown.
  std::string scenario = {};  ///< Text of the scenario file.
  std::vector<RecordedSonar> sonars = {};
  std::vector<Marker> markers = {};
  std::vector<std::string> contents = {};  ///< Tables of an HDF5 file, topics of an MCAP file.
  std::vector<std::string> notes = {};     ///< RecordedPings::notes() of each sonar of a foreign file, each once.
};

/// Reads .h5, .hdf5 and .mcap files recorded by insonify, also unfinished ones (with names in .new), and foreign
/// recordings (recorded_pings.h); `contents` of whose several sonars are those of the first.
/// @throws Error with the path for anything else.
[[nodiscard]] RecordingInfo recording_info(const std::filesystem::path& path);

/// What verify_recording() has found.
struct RecordingCheck {
  std::uint64_t rows = 0;                   ///< Rows of tables, one a ping, and tables without pings that were read.
  std::vector<std::string> unchecked = {};  ///< Tables without checksums: "intensity". Damage in them is not seen.
  std::vector<std::string> damaged = {};    ///< "intensity of ping 3: data error detected by Fletcher32 checksum"
};

/// Reads all tables of a recording of HDF5 or MCAP, and so compares them with their checksums.
/// @throws Error with the path for a file whose tables cannot be listed.
[[nodiscard]] RecordingCheck verify_recording(const std::filesystem::path& path);

/// A warning about a recording that may end before its run did: "fls.h5 is unfinished: the run that wrote it was
/// killed; it has 12 pings"; "" for a whole recording.
[[nodiscard]] std::string unfinished_text(const std::filesystem::path& path, const RecordingInfo& info);

/// Whether a file starts like an MCAP file.
[[nodiscard]] bool is_mcap(const std::filesystem::path& path);

}  // namespace insonify
