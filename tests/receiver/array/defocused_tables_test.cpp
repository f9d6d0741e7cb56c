// defocused_tables_test.cpp -- tables of defocused patterns against the patterns themselves, and how many there are.

#include "receiver/array/defocused_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace insonify::defocused_tables_test {
namespace {

constexpr double kReach = 150, kFloor = 1e-6;

// Phases that have a table of their own: even steps of 0.02 rad, and above 1 rad even ratios e^0.02.
std::vector<double> tabulated_phases() {
  return {0.02, -0.3, std::exp(1.0), -std::exp(3.0), std::exp(5.0)};
}

// The pattern of 96 elements repeats after x = 96, out of focus too. Where the side lobes in focus begin, patterns have
// a step, of up to their level where elements have errors.
TEST(DefocusedTablesTest, AreThePatterns) {
  const ArraySettings settings[] = {
      {},
      {.window = ArrayWindow::kTaylor, .two_way = true},
      {.window = ArrayWindow::kHann, .elements = 96, .element_error = 0.3, .dead_elements = {0, 1, 50}},
      {.window = ArrayWindow::kDolphChebyshev, .elements = 41}};
  for (const ArraySettings& array : settings) {
    const ArrayPattern pattern(array, 7);
    DefocusedTables tables(pattern, array.elements, kReach, kFloor);
    for (const double phase : tabulated_phases()) {
      const int table = tables.table_for(phase);
      const ArrayPattern defocused = pattern.defocused(phase);
      for (double x = -kReach; x <= kReach; x += 0.0517) {
        const std::complex<double> found = tables.amplitude(table, x);
        const double within = array.elements > 0 ? std::remainder(x, array.elements) : x;
        const double edge = std::abs(std::abs(within) - ArrayPattern::kExactReach - 4 * std::abs(phase));
        const double most = edge > 3 ? DefocusedTables::kError : array.element_error > 0 ? 0.1 : 5e-3;
        ASSERT_NEAR(std::abs(found - defocused.amplitude(x)), 0, most) << phase << " " << x;
      }
    }
  }
}

TEST(DefocusedTablesTest, NothingIsLeftOutAboveTheFloor) {
  const ArrayPattern pattern({.window = ArrayWindow::kHann});
  DefocusedTables tables(pattern, 0, kReach, kFloor);
  for (const double phase : tabulated_phases()) {
    const int table = tables.table_for(phase);
    const auto [low, high] = tables.extent_of(table);
    EXPECT_GT(high - low, 2);
    for (double x = -kReach; x <= kReach; x += 0.01) {
      if (x < low || x > high) {
        ASSERT_LT(std::norm(tables.amplitude(table, x)), 1.01 * kFloor) << phase << " " << x;
      }
    }
  }
}

TEST(DefocusedTablesTest, NearlyEqualPhasesShareATable) {
  const ArrayPattern pattern;
  DefocusedTables tables(pattern, 0, kReach, kFloor);
  int last = -1;
  for (double phase = 0; phase < 100; phase += 0.001) {
    last = std::max(last, tables.table_for(phase));
  }
  EXPECT_EQ(last, 50 + 230);  // 50 steps to 1 rad, then ln(100) / 0.02 = 230.3.
  for (const double phase : {0.7, 5.0, 77.0}) {
    const double near = phase < 1 ? phase + 0.009 : phase * 1.009;
    EXPECT_LE(std::abs(tables.table_for(near) - tables.table_for(phase)), 1);
  }
}

}  // namespace
}  // namespace insonify::defocused_tables_test
