// same_pings.h -- whether two pings hold the same, to the bit or all but.

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "insonify/ping.h"

namespace insonify {

namespace detail {

template <typename Value>
std::string bytes_of(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

}  // namespace detail

/// Every byte of every table.
inline void expect_same(const Ping& ping, const Ping& expected) {
  const auto expect_same_table = [&](auto table, const char* name) {
    EXPECT_EQ((ping.*table).size(), (expected.*table).size()) << name;
    EXPECT_TRUE(detail::bytes_of(ping.*table) == detail::bytes_of(expected.*table)) << name;
  };
  expect_same_table(&Ping::intensity, "intensity");
  expect_same_table(&Ping::field, "field");
  expect_same_table(&Ping::counts, "counts");
  expect_same_table(&Ping::phase, "phase");
  expect_same_table(&Ping::instance, "instance");
  expect_same_table(&Ping::material, "material");
  expect_same_table(&Ping::elevation, "elevation");
  expect_same_table(&Ping::strongest_instance, "strongest_instance");
  expect_same_table(&Ping::strongest_share, "strongest_share");
  expect_same_table(&Ping::elevation_spread, "elevation_spread");
  expect_same_table(&Ping::path_order, "path_order");
  expect_same_table(&Ping::shadow, "shadow");
  expect_same_table(&Ping::direct_intensity, "direct_intensity");
  ASSERT_EQ(ping.soundings.size(), expected.soundings.size());
  for (std::size_t beam = 0; beam < ping.soundings.size(); ++beam) {
    const Sounding &a = ping.soundings[beam], &b = expected.soundings[beam];
    EXPECT_EQ(a.detection, b.detection) << beam;
    EXPECT_TRUE(a.range == b.range || !a.found()) << beam;
  }
}

/// Sum |a - b| over sum a of the intensities.
inline double apart(const Ping& a, const Ping& b) {
  double sum = 0, difference = 0;
  for (std::size_t i = 0; i < a.intensity.size(); ++i) {
    sum += double{a.intensity[i]};
    difference += std::abs(double{a.intensity[i]} - double{b.intensity[i]});
  }
  return difference / sum;
}

}  // namespace insonify
