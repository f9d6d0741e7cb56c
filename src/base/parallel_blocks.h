// parallel_blocks.h -- loops over many small things, and sorting, on all workers.

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/parallel.h"

namespace insonify {

/// Calls run(first, last) for blocks of the numbers [0, count).
template <typename Run>
void for_each_block(Workers& workers, std::size_t count, std::size_t block, const Run& run) {
  workers.for_each(static_cast<int>((count + block - 1) / block), [&](int task, int) {
    const std::size_t first = static_cast<std::size_t>(task) * block;
    run(first, std::min(first + block, count));
  });
}

/// Sorts values: parts of them side by side, which are then merged in pairs.
/// @param less  A total order, so that the result does not depend on the number of parts.
template <typename Value, typename Less>
void parallel_sort(Workers& workers, std::vector<Value>& values, const Less& less) {
  constexpr std::size_t kLeast = 1 << 14;  // Values that one thread sorts faster alone.
  std::size_t part = values.size();
  for (int parts = workers.count(); parts > 1 && part > kLeast; parts = (parts + 1) / 2) {
    part = (part + 1) / 2;
  }
  const auto at = [&](std::size_t i) {
    return values.begin() + static_cast<std::ptrdiff_t>(std::min(i, values.size()));
  };
  for_each_block(workers, values.size(), std::max<std::size_t>(part, 1),
                 [&](std::size_t first, std::size_t last) { std::sort(at(first), at(last), less); });
  for (; part < values.size(); part *= 2) {
    for_each_block(workers, values.size(), 2 * part, [&](std::size_t first, std::size_t last) {
      std::inplace_merge(at(first), at(first + part), at(last), less);
    });
  }
}

}  // namespace insonify
