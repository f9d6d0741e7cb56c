// followed_hits.h -- whether a ping follows all of its hits, or some that count for all.

#pragma once

#include "echo/box_cut.h"
#include "insonify/engine.h"

namespace insonify {

/// From which hits of a ping sound is followed on to a second surface.
enum class Followed {
  kNone,
  kSome,  ///< See select_hits().
  kAll
};

/// What the plan says. With SecondaryEchoes::kSelective all are followed where boxes spare the rays of most: where of
/// some sixty hits, spread evenly over the fan, no more than three in ten would send rays that may meet anything.
/// @param origin  World position that the boxes are relative to.
/// @param probes  How many rays it took.
[[nodiscard]] Followed followed_hits(Engine& engine, const PingPlan& plan, const Pose& world_from_sonar,
                                     const Vec3& origin, const BoxCut& boxes, std::uint64_t& probes);

}  // namespace insonify
