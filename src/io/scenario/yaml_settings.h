// yaml_settings.h -- "key=value" from the command line, put into a scenario's tree before it is read.

#pragma once

#include <span>
#include <string>

#include "io/scenario/yaml_value.h"

namespace insonify {

/// Applies one setting: "pings=3", "water.depth=4", "sonars[0].max_range=30", "sonars.fls.max_range=30", or a sonar's
/// field alone, which means every sonar's. Messages on its value begin with `--set key=value: `.
/// @param scenario_keys  Keys of a scenario.
/// @param sonar_keys     Keys of a sonar.
/// @param part_keys      Those of their parts, as paths such as "water.depth".
/// @throws Error "--set key=value: ..." for a key that names nothing; for an unknown one with the nearest known
/// key.
void apply_setting(YamlValue& scenario, const std::string& setting, std::span<const std::string> scenario_keys,
                   std::span<const std::string> sonar_keys, std::span<const std::string> part_keys);

}  // namespace insonify
