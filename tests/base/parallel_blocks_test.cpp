// parallel_blocks_test.cpp -- blocks cover their range once, and sorting in parts is sorting.

#include "base/parallel_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

namespace insonify::parallel_blocks_test {
namespace {

TEST(ParallelBlocksTest, CoverEachNumberOnce) {
  Workers workers(3);
  for (const std::size_t count : {0, 1, 99, 100, 101, 1234}) {
    std::vector<int> visits(count, 0);
    for_each_block(workers, count, 100, [&](std::size_t first, std::size_t last) {
      EXPECT_LE(last - first, 100U);
      for (std::size_t i = first; i < last; ++i) {
        ++visits[i];
      }
    });
    EXPECT_EQ(visits, std::vector<int>(count, 1));
  }
}

TEST(ParallelSortTest, IsTheSortOfAllValues) {
  std::mt19937 random(3);
  for (const int threads : {1, 2, 3, 7}) {
    Workers workers(threads);
    for (const std::size_t count : {0, 1, 1000, 100'003}) {
      std::vector<unsigned> values(count);
      std::ranges::generate(values, [&] { return random() % 5000; });
      std::vector<unsigned> expected = values;
      std::ranges::sort(expected, std::greater());
      parallel_sort(workers, values, std::greater());
      EXPECT_EQ(values, expected) << threads << " " << count;
    }
  }
}

}  // namespace
}  // namespace insonify::parallel_blocks_test
