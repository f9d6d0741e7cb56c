// mattress.h -- concrete mattresses and other things laid on and under pipelines.

#pragma once

#include "kit/modelling.h"

/// Block mattresses are 6 x 3 m and 0.3 m thick as a rule, their blocks roped together 0.3 m apart [m].
inline constexpr double kMattressLength = 6.0;
inline constexpr double kMattressWidth = 3.0;
inline constexpr double kMattressThickness = 0.3;

/// A mattress of double-bevelled concrete blocks, about x = y = 0 in plan: `world_from_plan` says where its middle lies
/// and how it is turned, `drape` the height of what it lies on, in the world.
[[nodiscard]] Shape make_mattress(const Pose& world_from_plan, const Ground& drape);

/// A pre-cast sleeper, its length along y, that carries a pipe across its middle: foot at z = 0, a cradle of two horns
/// round the pipe, whose underside is at `height`.
[[nodiscard]] Shape make_sleeper(double height, double pipe_radius);

/// A bag of grout, slumped: about 1.5 m along y and 0.9 m along x, `height` high, its foot a little below z = 0.
[[nodiscard]] Shape make_grout_bag(double height, std::uint32_t seed);
