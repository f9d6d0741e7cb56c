// survey_order.h -- how exact the depths of a hydrographic survey must be.

#pragma once

#include <algorithm>
#include <cmath>

#include "insonify/words.h"

namespace insonify {

/// Orders of IHO Standards for Hydrographic Surveys S-44, edition 6 (2020).
enum class SurveyOrder { kExclusive, kSpecial, k1a };
template <>
constexpr auto words_of<SurveyOrder>() {
  return EnumWords<SurveyOrder, 3>{
      {{"exclusive", SurveyOrder::kExclusive}, {"special", SurveyOrder::kSpecial}, {"1a", SurveyOrder::k1a}}};
}

/// Greatest total vertical uncertainty that an order allows, at the 95 % confidence level: sqrt(a^2 + (b d)^2) with a
/// and b of S-44, table 1 [m].
/// @param depth  d [m]; above the datum, < 0, as 0.
[[nodiscard]] inline double allowed_uncertainty(SurveyOrder order, double depth) {
  const double a = order == SurveyOrder::kExclusive ? 0.15 : order == SurveyOrder::kSpecial ? 0.25 : 0.5;
  const double b = order == SurveyOrder::k1a ? 0.013 : 0.0075;
  return std::hypot(a, b * std::max(depth, 0.0));
}

}  // namespace insonify
