// walk_draws.h -- random numbers of walks, and what their files have in common.

#pragma once

#include <cstdint>

#include "base/philox.h"
#include "echo/grid/echo.h"
#include "echo/laws/laws.h"
#include "echo/model/hit.h"

namespace insonify {

/// Four uniform random numbers for one bounce of a walk; bounce 0 is its launch.
struct WalkDraws {
  float a, b, c, d;

  WalkDraws(std::uint64_t seed, std::uint64_t number, std::uint32_t walk, int bounce) {
    const PhiloxCounter counter = {
        walk, static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32),
        (static_cast<std::uint32_t>(bounce) << 8) + static_cast<std::uint32_t>(RandomPurpose::kWalks)};
    const PhiloxCounter words = philox(counter, philox_key(seed));
    a = uniform_open(words[0]);
    b = uniform_open(words[1]);
    c = uniform_open(words[2]);
    d = uniform_open(words[3]);
  }
};

/// Half of the range interval that an echo is spread over, for a path of the given length: as the widest of the other
/// secondary echoes [m].
inline float half_spread(double path_length) {
  return 0.5F * kWidestFootprint * static_cast<float>(0.5 * path_length);
}

inline SurfaceLabel label_of(const Hit& hit) {
  return surface_label(hit.instance, hit.material);
}

}  // namespace insonify
