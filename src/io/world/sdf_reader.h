// sdf_reader.h -- what reads SDF files: a library of its own, which is opened at the first of them.

#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/geometry.h"
#include "insonify/log.h"
#include "insonify/scene.h"

namespace insonify {

/// One `<insonify:sonar>`, or `<sonar>` in the plugin called insonify.
struct SdfSonar {
  std::string name;
  std::string carrier;  ///< Full name of the link or model: "rov::base_link".
  Pose world_from_carrier;
  Pose carrier_from_sonar;                                    ///< Its <pose>.
  std::vector<std::pair<std::string, std::string>> settings;  ///< Keys of a scenario's sonar, with their text.
  Place place;
};

/// The functions of src/io/sdf. They are apart from the library because libsdformat, on which they stand, takes two
/// thirds of the time in which a process starts, and may be absent.
struct SdfReader {
  /// Reads all worlds and models of a file: every visual, or every collision, becomes an instance named
  /// "model::link::visual". docs/reference/sdf.md lists what is read and what is not.
  /// @throws Error "path:line:column: ..." for faults, and if there is nothing to insonify.
  Scene (*load_scene)(const std::filesystem::path& path, const WorldOptions& options, const Log& log);

  /// Reads the sonars of all worlds and models of a file, in order. docs/reference/sdf.md says how they are
  /// written.
  /// @throws Error "path:line:column: ..." for faults, and as load_scene.
  std::vector<SdfSonar> (*load_sonars)(const std::filesystem::path& path, const Log& log);
};

/// The reader: linked into a static library, and opened at the first call beside a shared one.
/// @param path  The file to be read, for messages.
/// @throws Error if insonify was built without libsdformat, or the reader's library cannot be opened.
[[nodiscard]] const SdfReader& sdf_reader(const std::filesystem::path& path);

/// The reader's own functions, and the name of this constant in its library.
extern "C" const SdfReader insonify_sdf_reader;
inline constexpr const char* kSdfReaderSymbol = "insonify_sdf_reader";

}  // namespace insonify
