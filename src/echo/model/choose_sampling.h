// choose_sampling.h -- decides by a few probe rays whether a ping samples all of its hits or some that stand for all.

#pragma once

#include <span>
#include <vector>

#include "echo/model/box_cut.h"
#include "echo/model/hit.h"
#include "echo/model/ping_plan.h"
#include "echo/model/secondary_sampling.h"

namespace insonify {

/// The probes of one ping. With SecondaryEchoes::kSelective all hits are sampled where boxes cull most reflected rays:
/// where of 8 to 64 probes, spread evenly over the fan, no more than four in ten of those that meet something have a
/// reflected ray that may meet anything else. Probes are mirrored by the relief, but not by the facets of rough
/// mirrors. The choice changes how exact a ping is, not what it is on average.
class SamplingProbes {
 public:
  /// Aims the probes of a ping.
  /// @return Rays for the engine to trace; none where the plan alone decides. Allocates at the first call only.
  [[nodiscard]] std::span<const Ray> aim(const PingPlan& plan, const Pose& world_from_sonar);

  /// Where the engine writes what they met.
  [[nodiscard]] std::span<Hit> hits() { return hits_; }

  /// The choice for the ping that aim() was called for.
  /// @param origin  World position that the boxes are relative to.
  [[nodiscard]] SecondarySampling choose(const PingPlan& plan, const Vec3& origin, const BoxCut& boxes) const;

 private:
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
};

}  // namespace insonify
