// export.h -- writes recordings in the formats of other tools: MCAP, NumPy, Zarr, survey files and video.

#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/acoustics/sound_speed_profile.h"
#include "insonify/log.h"
#include "insonify/messages.h"
#include "insonify/picture.h"
#include "insonify/survey/geographic.h"

namespace insonify {

/// Options for videos of pings.
struct VideoOptions {
  /// Frames per second, in (0, 120]; absent: so that the video lasts as long as the pings took, at most 50.
  std::optional<double> rate = {};

  /// Levels of the darkest and the brightest colour [dB], as on the colour bar; absent: fitted to the first ping of a
  /// fan, or all pings of a scanning sonar.
  std::optional<double> low_db = {}, high_db = {};

  ColourMap colour_map = ColourMap::kInferno;
  int height = 720;         ///< [pixels], 240..8192; the video's is the next even number.
  bool annotations = true;  ///< Rings, axes and colour bar.
};

struct ExportOptions {
  bool replace = false;          ///< Whether an existing file is replaced.
  bool compress = true;          ///< Whether tables in .npz files are compressed; .zarr and .mcap always are.
  MessageOptions messages = {};  ///< For .mcap and .bag; start_ns for survey files too.
  VideoOptions video = {};       ///< For .mp4 and .gif.

  /// Where the world's origin is, for .xtf, .jsf and .xyz: their positions are then latitudes and longitudes, by the
  /// plane that touches the ellipsoid there, x to the east and y to the north. Absent: metres. .gsf and .kmall need it.
  std::optional<GeographicPoint> origin = {};

  bool uncertainty = false;  ///< Whether lines of .xyz end with the standard deviation of the depth.

  /// Sound-speed profile of the processing, along whose rays soundings in .xyz, .gsf and .kmall are placed, whether or
  /// not it is that of the water. Depth 0 is the surface of the recording's scenario. Empty: along straight rays.
  std::vector<ProfilePoint> profile = {};

  /// Receives warnings of clipped values in sonar images: SonarMessages::cut_text().
  Log log = {};

  /// While `*stop` is true, export_recordings() throws Interrupted and leaves nothing behind. Null: never.
  const std::atomic<bool>* stop = nullptr;
};

/// A recording, or one sonar of it.
struct RecordingPart {
  std::filesystem::path path;
  std::string sonar = {};  ///< "": all of its sonars.
};

/// Writes recordings of one run to a file in the format of its extension:
///
/// - `.mcap`: ROS 2 messages, all sonars in order of time (McapRecording).
/// - `.bag`: the same as ROS 1 messages, in a bag of version 2.0 with uncompressed chunks.
/// - `.npz`: NumPy arrays with the names of the recording's tables, or NAME/intensity etc. for several sonars.
///   `attributes` is a JSON text with the recording's attributes and settings.
/// - `.zarr`: a folder in Zarr version 2, one chunk per ping, compressed by zlib, a group per sonar if there are
/// several. `.zattrs` has attributes and settings.
/// - `.xtf`, `.jsf`: up to three side-scan sonars with their navigation, as survey programs read them.
/// - `.xyz`: soundings of multibeams as lines of text, x y z of the world; with an origin longitude, latitude and depth
///   below z = 0. Positions are those that the instrument would write: by the sound speed that it assumes, or along the
///   rays of ExportOptions::profile.
/// - `.gsf`, `.kmall`: soundings of one multibeam with its navigation, as survey programs read them.
/// - `.mp4`, `.gif`: the fan of one sonar, or the scan of a scanning one, made by the program ffmpeg.
///
/// The file appears under its name once it is complete.
/// @param recordings  HDF5 as Recording writes it, MCAP as McapRecording does, also unfinished ones. At least one. Of
///                    MCAP, intensities are as exact as its levels (RecordedPings), and there is no ground truth.
/// @throws Error with the path: for another ending, several sonars in a video, other than side-scan sonars in
///         .xtf and .jsf and than multibeams in .xyz, .gsf and .kmall, an origin out of limits or missing, sonars with
///         the same name, recordings of different runs or without a ping, a file that exists already, a full disk;
///         where ffmpeg is not installed.
void export_recordings(std::span<const RecordingPart> recordings, const std::filesystem::path& file,
                       const ExportOptions& options = {});
void export_recordings(std::span<const std::filesystem::path> recordings, const std::filesystem::path& file,
                       const ExportOptions& options = {});

/// Finds all that is wrong with recordings and file, and writes nothing.
/// @throws Error as export_recordings() before writing.
void check_export(std::span<const RecordingPart> recordings, const std::filesystem::path& file,
                  const ExportOptions& options = {});

/// A format of export_recordings().
struct ExportKind {
  std::string_view ending;    ///< In lower case, with its dot.
  std::string_view contents;  ///< For users, one line.
};

/// All formats.
[[nodiscard]] std::vector<ExportKind> export_kinds();

/// Their endings for messages: ".mcap, .bag or .gif".
[[nodiscard]] std::string export_endings(std::string_view before_last);

}  // namespace insonify
