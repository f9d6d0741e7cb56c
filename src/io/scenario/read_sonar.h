// read_sonar.h -- one entry of a scenario's `sonars`.

#pragma once

#include <string>

#include "insonify/scenario.h"
#include "io/scenario/yaml_read.h"

namespace insonify {

/// @param object    Its name in messages: "sonars[0]".
/// @param scenario  Its water, surface and trajectory give the speed of sound for the ping period of a preset.
/// @param places    Receives the places of the entry's settings.
/// @param log       Receives a warning for each value that a preset's instrument cannot have.
/// @throws Error with the place of the invalid value.
[[nodiscard]] SonarConfig read_sonar(const YamlValue& value, const std::string& object, const Scenario& scenario,
                                     Places& places, const Log& log);

}  // namespace insonify
