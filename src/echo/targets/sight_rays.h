// sight_rays.h -- lines of sight, through surfaces that let sound through.

#pragma once

#include <limits>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/model/ping_plan.h"

namespace insonify {

/// Where a line of sight ends: at the first surface of this instance from this distance on, whatever it lets through.
struct SightEnd {
  double from = std::numeric_limits<double>::infinity();  ///< [m]
  std::uint16_t instance = kNoLabel;                      ///< kNoLabel: any.
};

/// Traces lines of sight: engine.trace() where all surfaces are opaque, else on behind each that lets sound through, as
/// primary rays go on (see_through.h).
class SightRays {
 public:
  /// @param most  Greatest number of rays of a call. Only the first call in a scene that lets sound through allocates.
  explicit SightRays(std::size_t most = 0) : most_(most) {}

  /// @param rays  All from the sonar, or to it: a share below kLeastPassed there and back blocks.
  /// @param hits  Receives the first surface along each ray that blocks it or is its end; of the length of `rays`.
  /// @param ends  One per ray; empty: rays have none.
  void trace(const PingPlan& plan, Engine& engine, std::span<const Ray> rays, std::span<Hit> hits,
             std::span<const SightEnd> ends = {});

  /// Share of the intensity that passes the surfaces before the hit of a ray of the last call, one way.
  [[nodiscard]] double passed(std::size_t ray) const { return opaque_ ? 1 : passed_[ray]; }

 private:
  std::size_t most_;
  bool opaque_ = true;
  std::vector<double> passed_;   // [ray]
  std::vector<std::size_t> of_;  // The rays that go on.
  std::vector<Ray> onward_;
  std::vector<Hit> met_;
};

}  // namespace insonify
