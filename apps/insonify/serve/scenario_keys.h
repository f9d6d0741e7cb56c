// scenario_keys.h -- the settings of a scenario with their values and limits, for the page's controls.

#pragma once

#include <nlohmann/json_fwd.hpp>

#include "insonify/scenario.h"

namespace insonify {

/// Numbers, words and switches by their `--set` paths: {"sonars[0].max_range": {"value": 30, "least": 0, "most":
/// 100000, "help": ..., "unit": "m"}}. Without those that have no effect in the scenario's model.
[[nodiscard]] nlohmann::ordered_json scenario_keys(const Scenario& scenario);

}  // namespace insonify
