// noise.h -- value noise for rough surfaces, the same on every run.

#pragma once

#include <cstdint>

#include "kit/shape.h"

/// A number in [0, 1) that depends on its arguments alone.
[[nodiscard]] double chance(std::uint32_t seed, std::int32_t i, std::int32_t j = 0, std::int32_t k = 0);

/// Smooth noise, about -1..1 with features of size 1: random values on a lattice, smoothly interpolated.
[[nodiscard]] double noise(const Vec3& position, std::uint32_t seed);

/// Octaves of noise, each twice as fine and `roughness` times as strong as the one before; about -1..1.
[[nodiscard]] double fractal_noise(const Vec3& position, std::uint32_t seed, int octaves, double roughness = 0.5);
