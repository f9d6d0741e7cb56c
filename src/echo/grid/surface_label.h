// surface_label.h -- adds an echo to the strongest surface of a cell, or tells that it belongs to another.

#pragma once

#include "echo/grid/echo.h"

namespace insonify {

/// The strongest surface of a cell, or of as many as vectors have lanes; see EchoGrid::Cells.
template <typename Label, typename Value>
struct StrongestSurface {
  Label surface;
  Value energy, moment;
};

/// The cells after an echo, and where its surface is another than the strongest: all ones there, else 0. There nothing
/// was added; EchoGrid::add_further() takes the echo. Nothing changes where `weight` is 0.
template <typename Label, typename Value>
struct LabelledEcho {
  StrongestSurface<Label, Value> cell;
  Label elsewhere;
};

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
