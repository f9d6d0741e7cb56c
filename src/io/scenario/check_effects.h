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

}  // namespace insonify
