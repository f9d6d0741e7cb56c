// clear_path.h -- transmission along the straight path between two positions.

#pragma once

#include <algorithm>
#include <cmath>

#include "echo/engine.h"
#include "echo/model/ray_limits.h"
#include "echo/model/see_through.h"

namespace insonify {

/// One-way transmission from one world position to another: 0 if an opaque surface blocks the path (see_through.h).
inline double passed_between(const PingPlan& plan, const Vec3& from, const Vec3& to, Engine& engine) {
  const Vec3 there = to - from;
  const double range = there.norm();
  Ray ray{from, there / range, 0, range - double{kRayClearance}};
  double share = 1;
  for (int surfaces = 0; surfaces <= kMostPassed; ++surfaces) {
    Hit hit;
    engine.trace({&ray, 1}, {&hit, 1});
    if (!std::isfinite(hit.distance)) {
      return share;
    }
    if (!plan.sees_through()) {
      return 0;
    }
    const double cosine = std::min(std::abs(hit.normal.dot(ray.direction)), 1.0);
    const double transmittance =
        plan.scatter.scattering(surface_label(hit.instance, hit.material)).transmittance(cosine);
    if (passed_on(share * share, transmittance) == 0) {
      return 0;
    }
    share *= transmittance;
    ray.min_distance = hit.distance + double{kRayClearance};
  }
  return 0;
}

/// Whether no surface, transparent or not, lies between two different world positions.
inline bool is_clear(const Vec3& from, const Vec3& to, Engine& engine) {
  const Vec3 there = to - from;
  const double range = there.norm();
  const Ray ray{from, there / range, 0, range - double{kRayClearance}};
  Hit hit;
  engine.trace({&ray, 1}, {&hit, 1});
  return !std::isfinite(hit.distance);
}

}  // namespace insonify
