// sdf_sonars.h -- the sonars in an SDF file, each in the link or model that carries it.

#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "insonify/error.h"
#include "insonify/geometry.h"
#include "insonify/log.h"

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

/// Reads the sonars of all worlds and models of a file, in order. docs/reference/sdf.md says how they are
/// written.
/// @throws Error "path:line:column: ..." for faults, and as load_sdf_scene().
[[nodiscard]] std::vector<SdfSonar> load_sdf_sonars(const std::filesystem::path& path, const Log& log);

}  // namespace insonify
