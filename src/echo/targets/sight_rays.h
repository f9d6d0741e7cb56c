// sight_rays.h -- lines of sight, which continue through surfaces that transmit sound.

#pragma once

#include <limits>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/model/ping_plan.h"

namespace insonify {

/// End of a line of sight: the first surface of `instance` at a distance of at least `from`, even if it transmits
/// sound.
struct SightEnd {
  double from = std::numeric_limits<double>::infinity();  ///< [m]
  std::uint16_t instance = kNoLabel;                      ///< kNoLabel: any.
};

/// Traces lines of sight with engine.trace(), and continues each behind surfaces that transmit sound, as primary rays
/// are (see_through.h).
class SightRays {
 public:
  /// @param most  Most rays per call. Only the first call with a material that transmits sound allocates.
  explicit SightRays(std::size_t most = 0) : most_(most) {}

  /// @param rays  All from the sonar or all to it. A ray is blocked where its two-way transmittance falls below
  ///              kLeastPassed.
  /// @param hits  [ray] Receives the surface that blocks the ray or is its end.
  /// @param ends  [ray] Empty: no ray has an end.
  void trace(const PingPlan& plan, Engine& engine, std::span<const Ray> rays, std::span<Hit> hits,
             std::span<const SightEnd> ends = {});

  /// Product of the transmittances of the surfaces in front of a ray's hit in the last call, one way.
  [[nodiscard]] double passed(std::size_t ray) const { return opaque_ ? 1 : passed_[ray]; }

 private:
  std::size_t most_;
  bool opaque_ = true;
  std::vector<double> passed_;   // [ray]
  std::vector<std::size_t> of_;  // Indices of the rays in continued_.
  std::vector<Ray> continued_;
  std::vector<Hit> met_;
};

}  // namespace insonify
