// label_vote.h -- which surface a cell is labelled with.

#pragma once

#include "echo/grid/echo.h"

namespace insonify {

/// A majority vote weighted by energy (Boyer and Moore, 1981): whoever holds more than half of a cell leads it in the
/// end. Of one cell, or of as many as vectors have lanes.
template <typename Label, typename Value>
struct LabelVote {
  Label surface;
  Value lead;    ///< Energy by which it leads all others together.
  Value energy;  ///< Since it leads,
  Value moment;  ///< and the sum of energy x elevation.
};

/// The vote after a surface's energy. Nothing changes where `weight` is 0.
template <typename Label, typename Value>
[[gnu::always_inline]] inline LabelVote<Label, Value> counted(const LabelVote<Label, Value>& vote, Label surface,
                                                              Value energy, Value moment, Value weight) {
  const Value none = {};
  const Value lead = vote.surface == (kNoSurface | Label{}) ? none : vote.lead;
  const auto own = vote.surface == surface;
  const auto taken = (weight > none) & !(own | (lead > energy));
  const Value apart = lead > energy ? lead - energy : energy - lead;
  const auto gains = own | taken;
  return {taken ? surface : vote.surface, own ? lead + energy : apart,
          (taken ? none : vote.energy) + (gains ? energy : none),
          (taken ? none : vote.moment) + (gains ? moment : none)};
}

}  // namespace insonify
