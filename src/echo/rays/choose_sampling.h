// choose_sampling.h -- decides by probe rays whether a ping traces reflected rays from all of its hits or from a
// sample.

#pragma once

#include <span>
#include <vector>

#include "echo/model/flat_plan.h"
#include "echo/model/hit.h"
#include "echo/rays/box_cut.h"

namespace insonify {

/// The probes of one ping: 8 to 64 rays, evenly spaced over the fan. With SecondaryEchoes::kSelective a ping uses all
/// hits if BoxCut excludes most reflected rays, that is, if at most 40 % of the probes that hit something have a
/// reflected ray that may hit something else. Probes are reflected by the relief, but not by the facets of rough
/// mirrors. The choice changes the variance of a ping, not its expected value.
class SamplingProbes {
 public:
  /// Sets up the probes of a ping. Allocates only at the first call.
  /// @return Rays for the engine to trace; none if the plan alone decides.
  [[nodiscard]] std::span<const Ray> aim(const FlatPlan& plan, const Pose& world_from_sonar);

  /// The engine writes the hits of the rays here.
  [[nodiscard]] std::span<Hit> hits() { return hits_; }

  /// The choice for the ping that aim() was called for.
  /// @param origin  World position that the boxes are relative to.
  [[nodiscard]] SecondarySampling choose(const FlatPlan& plan, const Vec3& origin, const BoxCut& boxes) const;

  /// The choice of the plan alone, instead of aim() and choose(), where rays are bent and boxes tell nothing.
  [[nodiscard]] SecondarySampling choose_blindly(const FlatPlan& plan);

 private:
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
};

}  // namespace insonify
