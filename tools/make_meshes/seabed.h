// seabed.h -- the sand and the boulders on it.

#pragma once

#include "shape.h"

namespace modelling {

/// The bed as a grid, finest where the shipped sonar looks: 0.1 m across the ripples, 0.3 m along them.
[[nodiscard]] Shape make_seabed();

/// Weathered stones, partly buried.
[[nodiscard]] Shape make_boulders();

}  // namespace modelling
