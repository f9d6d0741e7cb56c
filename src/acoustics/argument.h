// argument.h -- how a public function of formulas refuses a number that its formula has no meaning for.

#pragma once

#include <string_view>

#include "insonify/field.h"

namespace insonify {

/// @throws Error "bent_path.distance = -3 m must be at least 0 m"; an angle ("rad") is told in degrees.
inline void check_argument(std::string_view function, std::string_view name, std::string_view unit,
                           const Limits& limits, double value) {
  check_field(function, Field{name, unit, limits, ""}, value);
}

}  // namespace insonify
