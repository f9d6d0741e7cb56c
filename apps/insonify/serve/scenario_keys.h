// scenario_keys.h -- the settings of a scenario with their values and limits, for controls.

#pragma once

#include <nlohmann/json_fwd.hpp>

#include "insonify/scenario.h"

namespace insonify {

/// Numbers, words and switches by their paths as `--set` takes them: {"sonars[0].max_range": {"value": 30, "least": 0,
/// "most": 100000, "help": ..., "unit": "m"}}. Those that have no effect in the scenario's model are left out.
[[nodiscard]] nlohmann::ordered_json scenario_keys(const Scenario& scenario);

}  // namespace insonify
