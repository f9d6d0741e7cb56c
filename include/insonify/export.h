// export.h -- writes recordings in the formats of other tools: MCAP, NumPy, Zarr and video.

#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "insonify/log.h"
#include "insonify/messages.h"
#include "insonify/picture.h"

namespace insonify {

/// How a video shows pings.
struct VideoOptions {
  /// Pictures a second, in (0, 120]; absent: so that the video lasts as long as the pings took, with at most 50.
  std::optional<double> rate = {};

  /// Levels of the darkest and the brightest colour [dB], as on the colour bar; absent: what fits the first ping of a
  /// fan, or all pings of a scanning sonar.
  std::optional<double> low_db = {}, high_db = {};

  ColourMap colour_map = ColourMap::kInferno;
  int height = 720;         ///< [pixels], 240..8192; the video's is the next even number.
  bool annotations = true;  ///< Rings, axes and colour bar.
};

struct ExportOptions {
  bool replace = false;          ///< Whether the export may take the place of what is there already.
  bool compress = true;          ///< Whether tables in .npz files are deflated; .zarr and .mcap always are compressed.
  MessageOptions messages = {};  ///< How messages of .mcap and .bag are made.
  VideoOptions video = {};       ///< How .mp4 and .gif are made.

  /// Is told of values of sonar images that are cut: SonarMessages::cut_text().
  Log log = {};

  /// While `*stop` is true, export_recordings() throws Interrupted and leaves nothing behind. Null: never.
  const std::atomic<bool>* stop = nullptr;
};

/// A recording, or one sonar of it.
struct RecordingPart {
  std::filesystem::path path;
  std::string sonar = {};  ///< "" for all that it holds.
};

/// Writes recordings of one run to a file in the format of its ending:
///
/// - `.mcap`: ROS 2 messages, all sonars in the order of their pings' times (McapRecording).
/// - `.bag`: the same as ROS 1 messages, in a bag of version 2.0, chunks without compression.
/// - `.npz`: NumPy arrays with the names that the recording's tables have; of several sonars NAME/intensity.
///   `attributes` is a text, a JSON object with the recording's attributes and settings.
/// - `.zarr`: a folder, Zarr version 2, one chunk a ping, compressed by zlib; of several sonars a group each. `.zattrs`
///   has attributes and settings.
/// - `.mp4`, `.gif`: the fan of one sonar, or what a scanning one has seen, made by the program ffmpeg.
///
/// The file appears under its name once it is whole.
/// @param recordings  HDF5 as Recording writes it, MCAP as McapRecording does, also unfinished ones. At least one. Of
///                    MCAP, intensities are as exact as its levels (RecordedPings), and there is no ground truth.
/// @throws Error with the path: for another ending, several sonars in a video, sonars with the same name, recordings of
///         different runs or without a ping, a file that is there already, a full disk; where ffmpeg is not installed.
void export_recordings(std::span<const RecordingPart> recordings, const std::filesystem::path& file,
                       const ExportOptions& options = {});
void export_recordings(std::span<const std::filesystem::path> recordings, const std::filesystem::path& file,
                       const ExportOptions& options = {});

/// Finds all that is wrong with recordings and file, and writes nothing.
/// @throws Error as export_recordings() does before it begins to write.
void check_export(std::span<const RecordingPart> recordings, const std::filesystem::path& file,
                  const ExportOptions& options = {});

/// Endings that export_recordings() knows, in lower case, with their dots.
[[nodiscard]] std::span<const std::string_view> export_endings();

}  // namespace insonify
