// agreement.h -- by how much echoes of two engines, or of two methods, may differ.

#pragma once

#include <algorithm>

#include "engines/random_scene.h"

namespace insonify::testing_scenes {

/// Sum |a - b| / sum a by which engines may differ: single precision moves this share of the energy to neighbouring
/// bins.
inline constexpr double kEnergyTolerance = 1e-4;

/// The same per path order. Orders 2 and 3 may differ more: footprints of reflected paths are computed from differences
/// of ranges, of which single precision leaves four digits, and levels change steeply within specular lobes and near
/// foci.
inline constexpr double kOrderTolerances[] = {kEnergyTolerance, 5 * kEnergyTolerance, 50 * kEnergyTolerance};

/// Path orders with less than this share of the energy are not compared alone: they are far out on a lobe's tail, where
/// single precision leaves two digits.
inline constexpr double kLeastShare = 1e-8;

inline void expect_agreement(const EchoGrid& a, const EchoGrid& b, int seed) {
  double apart = 0, sum = 0;  // Sum |a - b| and sum a over all path orders.
  for (int order = 1; order <= kPathOrders; ++order) {
    const double whole = total(a, order);
    apart += whole > 0 ? difference(a, b, order) * whole : total(b, order);
    sum += whole;
  }
  EXPECT_LE(apart, kEnergyTolerance * sum) << "seed " << seed;
  for (int order = 1; order <= kPathOrders; ++order) {
    if (std::max(total(a, order), total(b, order)) > kLeastShare * sum) {
      EXPECT_LE(difference(a, b, order), kOrderTolerances[order - 1]) << "order " << order << ", seed " << seed;
    }
  }
}

}  // namespace insonify::testing_scenes
