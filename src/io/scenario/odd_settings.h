// odd_settings.h -- finds settings without effect beside others, and pulses that outlast a ping.

#pragma once

#include <string>
#include <vector>

#include "insonify/scenario.h"

namespace insonify {

/// A line for each setting that is probably a mistake: a key without effect beside other settings ("a.yaml:3:5:
/// receiver.pulse_bandwidth has no effect unless pulse is lfm"), a source above the water's surface, a pulse longer
/// than its ping. These are not errors: a file can be meant for --set.
/// @param scenario  Valid, with the places of what was read.
[[nodiscard]] std::vector<std::string> odd_settings(const Scenario& scenario);

}  // namespace insonify
