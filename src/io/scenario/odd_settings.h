// odd_settings.h -- finds settings of a file that other settings keep from acting, and pulses that outlast a ping.

#pragma once

#include <string>
#include <vector>

#include "insonify/scenario.h"

namespace insonify {

/// A line for each setting that can hardly be meant: a key that another setting keeps from acting ("a.yaml:3:5:
/// receiver.pulse_bandwidth has no effect unless pulse is lfm"), a source above the water's surface, a pulse that is
/// longer than its ping. They may be there: a file can be meant for --set.
/// @param scenario  Valid, with the places of what was read.
[[nodiscard]] std::vector<std::string> odd_settings(const Scenario& scenario);

}  // namespace insonify
