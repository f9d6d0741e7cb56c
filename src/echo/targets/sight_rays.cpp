// sight_rays.cpp -- continues lines of sight behind surfaces that transmit sound, all rays together.

#include "echo/targets/sight_rays.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "echo/model/ray_limits.h"
#include "echo/model/see_through.h"

namespace insonify {
namespace {

bool ends_here(const SightEnd& end, const Hit& hit) {
  return hit.distance >= end.from && (end.instance == kNoLabel || end.instance == hit.instance);
}

}  // namespace

void SightRays::trace(const PingPlan& plan, Engine& engine, std::span<const Ray> rays, std::span<Hit> hits,
                      std::span<const SightEnd> ends) {
  assert(rays.size() == hits.size() && rays.size() <= most_);
  engine.trace(rays, hits);
  opaque_ = !plan.sees_through();
  if (opaque_) {
    return;
  }
  if (met_.size() < most_) {
    passed_.reserve(most_);
    of_.reserve(most_);
    continued_.reserve(most_);
    met_.resize(most_);
  }
  passed_.assign(rays.size(), 1);
  for (int surfaces = 0; surfaces < kMostPassed; ++surfaces) {
    of_.clear();
    continued_.clear();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit& hit = hits[i];
      if (!std::isfinite(hit.distance) || (!ends.empty() && ends_here(ends[i], hit))) {
        continue;
      }
      const double cosine = std::min(std::abs(hit.normal.dot(rays[i].direction)), 1.0);
      const double transmittance =
          plan.scatter.scattering(surface_label(hit.instance, hit.material)).transmittance(cosine);
      if (passed_on(passed_[i] * passed_[i], transmittance) > 0) {
        passed_[i] *= transmittance;
        of_.push_back(i);
        continued_.push_back(rays[i]);
        continued_.back().min_distance = hit.distance + double{kRayClearance};
      }
    }
    if (of_.empty()) {
      return;
    }
    const std::span<Hit> met = std::span(met_).first(of_.size());
    engine.trace(continued_, met);
    for (std::size_t k = 0; k < of_.size(); ++k) {
      hits[of_[k]] = met[k];
    }
  }
}

}  // namespace insonify
