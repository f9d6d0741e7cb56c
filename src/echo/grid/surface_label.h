// surface_label.h -- adds an echo to the strongest surface of a cell, or reports that it belongs to another surface.

#pragma once

#include "echo/grid/echo.h"

namespace insonify {

/// The strongest surface of one cell, or of kLanes cells if Label and Value are vectors; see EchoGrid::Cells.
template <typename Label, typename Value>
struct StrongestSurface {
  Label surface;
  Value energy, moment;
};

/// What add_to_strongest() returns.
template <typename Label, typename Value>
struct LabelledEcho {
  StrongestSurface<Label, Value> cell;  ///< The cell, with the echo added where it belongs to the strongest surface.
  Label elsewhere;  ///< All bits set where it belongs to another, so that EchoGrid::add_further() must add it; else 0.
};

/// Adds an echo where the cell has no surface yet or the same one. Nothing changes where `weight` is 0.
template <typename Label, typename Value>
[[gnu::always_inline]] inline LabelledEcho<Label, Value> add_to_strongest(const StrongestSurface<Label, Value>& cell,
                                                                          Label surface, Value energy, Value moment,
                                                                          Value weight) {
  const Value none = {};
  const auto echoes = weight > none;
  const auto first = (cell.surface == (kNoSurface | Label{})) & echoes;
  const auto own = (cell.surface == surface) & echoes;
  return {{first ? surface : cell.surface, first ? energy : cell.energy + (own ? energy : none),
           first ? moment : cell.moment + (own ? moment : none)},
          (echoes & !(first | own)) ? ~Label{} : Label{}};
}

}  // namespace insonify
