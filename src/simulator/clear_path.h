// clear_path.h -- whether anything is on the straight path between two places.

#pragma once

#include <cmath>

#include "echo/engine.h"
#include "echo/model/ray_limits.h"

namespace insonify {

/// Whether no surface lies between two places in the world, which differ.
inline bool is_clear(const Vec3& from, const Vec3& to, Engine& engine) {
  const Vec3 there = to - from;
  const double range = there.norm();
  const Ray ray{from, there / range, 0, range - double{kRayClearance}};
  Hit hit;
  engine.trace({&ray, 1}, {&hit, 1});
  return !std::isfinite(hit.distance);
}

}  // namespace insonify
