// cargo.h -- what the ferry carried and what fell off her. Each stands on z = 0, its front along +x.

#pragma once

#include "kit/modelling.h"

/// A saloon car, 4.3 m; `seed` varies its length and how far its roof is crushed.
[[nodiscard]] Shape make_car(std::uint32_t seed);
/// A small lorry with a box body, 6.4 m.
[[nodiscard]] Shape make_lorry();
/// A 20-foot container with corrugated walls, one door open, 6.06 x 2.44 x 2.59 m.
[[nodiscard]] Shape make_container();
/// An open wooden lifeboat, 5.6 m.
[[nodiscard]] Shape make_lifeboat();
/// Links along a path on the ground, every other one on edge. `link_length` is inside the bow [m].
[[nodiscard]] Shape make_chain(const std::vector<Vec3>& path, double link_length);
/// A stockless anchor, shank along +x, 1.6 m.
[[nodiscard]] Shape make_anchor();
