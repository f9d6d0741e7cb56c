// echo_grid.cpp -- the cells of one ping.

#include "insonify/echo_grid.h"

#include <algorithm>

namespace insonify {

EchoGrid::EchoGrid(int beam_count, int bin_count, int order_count)
    : beam_count_(beam_count),
      bin_count_(bin_count),
      order_count_(order_count),
      energy_(static_cast<std::size_t>(order_count) * beam_count * bin_count),
      weight_(energy_.size()),
      labels_(static_cast<std::size_t>(beam_count) * bin_count) {}

std::span<EchoGrid::Label> EchoGrid::labels(int beam) {
  return std::span(labels_).subspan(static_cast<std::size_t>(beam) * bin_count_, bin_count_);
}

std::span<const EchoGrid::Label> EchoGrid::labels(int beam) const {
  return std::span(labels_).subspan(static_cast<std::size_t>(beam) * bin_count_, bin_count_);
}

void EchoGrid::clear(int first_beam, int last_beam) {
  for (int beam = first_beam; beam < last_beam; ++beam) {
    for (int order = 1; order <= order_count_; ++order) {
      std::ranges::fill(energy(order, beam), 0.0F);
      std::ranges::fill(weight(order, beam), 0.0F);
    }
    std::ranges::fill(labels(beam), Label{});
  }
}

}  // namespace insonify
