// range_followers.h -- settings of a sonar that follow from its range window, kept up when the window changes.

#pragma once

#include <functional>

#include "held.h"

namespace insonify::python {

/// Whether bin_count, ping_period, pulse_duration and sampling.rows may depend on a sonar's field.
[[nodiscard]] bool is_of_range(std::string_view field);

/// Calls change(), which sets such a field of a sonar, then sets the settings that were those that followed from its
/// range: the bins, ping period and pulse of its preset (the one with the title `model`), a ping period that was the
/// shortest possible, and sampling.rows by the rule.
void change_range(Held<SonarConfig>& sonar, const std::function<void()>& change);

}  // namespace insonify::python
