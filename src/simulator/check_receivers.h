// check_receivers.h -- checks each sonar of a scenario together with its receiver.

#pragma once

#include "insonify/scenario.h"

namespace insonify {

/// @param scenario  Of the calibrated model; its sonars and receivers are valid by themselves.
/// @throws Error for the first beam pattern, focus, pulse or gain that the sonar cannot have.
void check_receivers(const Scenario& scenario);

}  // namespace insonify
