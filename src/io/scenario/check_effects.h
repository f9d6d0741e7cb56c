// check_effects.h -- finds keys without effect: in the model of the echo, or beside other settings.

#pragma once

#include <string>
#include <vector>

#include "insonify/scenario.h"

namespace insonify {

/// @param scenario  With the places of what was read. Keys of a file whose model `--set model=...` changes are
/// accepted.
/// @throws Error with the key's place, naming what acts in this model.
void refuse_idle_keys(const Scenario& scenario);

/// Those keys of the file, in order, that have no effect in a model that `--set model=...` chose.
[[nodiscard]] std::vector<std::string> idle_keys(const Scenario& scenario);

/// A line for each setting that is probably a mistake: a key without effect beside other settings ("a.yaml:3:5:
/// receiver.pulse_bandwidth has no effect unless pulse is lfm"), a source above the water's surface, a pulse longer
/// than its ping. These are not errors: a file can be meant for --set.
/// @param scenario  Valid, with the places of what was read.
[[nodiscard]] std::vector<std::string> odd_settings(const Scenario& scenario);

/// Adds a line for each value of a scenario's file that is valid but likely in another unit or order: an orientation in
/// radians, a salinity in kg/kg, a quaternion with its scalar last; and for motions that do not move.
void add_odd_values(const Scenario& scenario, std::vector<std::string>& lines);

}  // namespace insonify
