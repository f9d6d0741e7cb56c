// read_sonar.h -- one entry of a scenario's `sonars`.

#pragma once

#include <string>

#include "insonify/sonar_config.h"
#include "insonify/water.h"
#include "io/scenario/yaml_read.h"

namespace insonify {

/// @param object  What messages call it: "sonars[0]".
/// @param water   Gives the speed of sound for the ping period of a preset.
/// @param places  Gains what the entry gives.
/// @throws Error with the place of the value that is wrong.
[[nodiscard]] SonarConfig read_sonar(const YamlValue& value, const std::string& object, const Water& water,
                                     Places& places);

}  // namespace insonify
