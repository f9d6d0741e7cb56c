// choose_sampling.h -- whether a ping follows all of its hits, or some that count for all.

#pragma once

#include "echo/model/box_cut.h"
#include "echo/model/secondary_sampling.h"
#include "insonify/engine.h"

namespace insonify {

/// What the plan says. With SecondaryEchoes::kSelective all are followed where boxes spare the rays of most: where of 8
/// to 64 probes, spread evenly over the fan, no more than four in ten that meet something would send rays that may meet
/// anything else. Probes are mirrored by the relief, but not by the facets of rough mirrors. What is followed changes
/// how exact a ping is, not what it is on average.
/// @param origin  World position that the boxes are relative to.
/// @param probes  How many rays it took.
[[nodiscard]] SecondarySampling choose_sampling(Engine& engine, const PingPlan& plan, const Pose& world_from_sonar,
                                                const Vec3& origin, const BoxCut& boxes, std::uint64_t& probes);

}  // namespace insonify
