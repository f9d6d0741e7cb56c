// select_hits.h -- from which hits sound is followed on to a second surface.

#pragma once

#include "echo/model/hit_column.h"

namespace insonify {

/// Fills in `selected` of the first `rows` hits of a column. Where some are followed, a hit is followed with a
/// probability that grows with |facing| x reflectivity, within limits, and then counts for all of its kind, so that the
/// sums of energy and weight stay unbiased. Probabilities add up along the column and whoever completes a whole one is
/// taken (systematic sampling), from a start that differs from column to column and with the seed: the hits followed
/// lie evenly over a surface, and a still scene gives the same ping twice.
///
/// @param turned  Scratch, of a column's rows.
void select_hits(const PingPlan& plan, SecondarySampling sampling, int column, int rows, const HitColumn& hits,
                 std::uint32_t* turned);

}  // namespace insonify
