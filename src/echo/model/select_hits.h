// select_hits.h -- selects the hits from which reflected rays are traced.

#pragma once

#include "echo/model/hit_column.h"

namespace insonify {

/// Fills in HitColumn::selected of the first `rows` hits of a column. With SecondarySampling::kSome the probability p
/// of a hit grows, within limits, with |facing| x reflectivity in the `paper` model, and with the energy that it
/// reflects in the `calibrated` one; a selected hit has the weight 1/p, so that expected sums of energy and weight are
/// those of kAll. Selection is systematic sampling: p is summed along the column, from a
/// start that depends on the column and the seed, and a hit is selected where the sum passes a whole number. So
/// selected hits are evenly spaced over a surface, and a static scene gives the same ping again.
///
/// @param turned  Scratch memory for `rows` values: the sum of p modulo 1, in units of 2^-32.
void select_hits(const FlatPlan& plan, SecondarySampling sampling, int column, int rows, const HitColumn& hits,
                 std::uint32_t* turned);

}  // namespace insonify
