// check_effects.h -- rejects keys in a file that have no effect in its model of the echo.

#pragma once

#include "insonify/scenario.h"

namespace insonify {

/// @param scenario  With the places of what was read. Keys of a file whose model `--set model=...` changes are
/// accepted.
/// @throws Error with the key's place, naming what acts in this model.
void refuse_idle_keys(const Scenario& scenario);

/// Those keys of the file, in order, that have no effect in a model that `--set model=...` chose.
[[nodiscard]] std::vector<std::string> idle_keys(const Scenario& scenario);

/// A line for each key given of a receiver that another of its settings keeps from acting: "a.yaml:3:5:
/// receiver.pulse_bandwidth has no effect unless pulse is lfm". They may be there: a file can be meant for --set.
[[nodiscard]] std::vector<std::string> keys_idle_beside_others(const Scenario& scenario);

}  // namespace insonify
