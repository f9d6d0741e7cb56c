// value_noise.cpp -- value noise (Perlin's fractal sum of random values at grid points, blended between them).

#include "view/value_noise.h"

#include <cmath>
#include <cstdint>

namespace insonify {
namespace {

// Pseudo-random value in -1..1 at a grid point.
float value_at(std::int64_t x, std::int64_t y, std::int64_t z) {
  auto bits = static_cast<std::uint32_t>(x) * 0x9e3779b1U + static_cast<std::uint32_t>(y) * 0x85ebca77U +
              static_cast<std::uint32_t>(z) * 0xc2b2ae3dU;
  bits = (bits ^ (bits >> 15U)) * 0x2c1b3c6dU;
  bits = (bits ^ (bits >> 12U)) * 0x297a2d39U;
  bits ^= bits >> 15U;
  return static_cast<float>(bits >> 8U) / 8388608.0F - 1;
}

float octave(const Vec3& point) {
  const double fx = std::floor(point.x());
  const double fy = std::floor(point.y());
  const double fz = std::floor(point.z());
  const auto x = static_cast<std::int64_t>(fx);
  const auto y = static_cast<std::int64_t>(fy);
  const auto z = static_cast<std::int64_t>(fz);
  const auto smooth = [](double share) {
    const auto s = static_cast<float>(share);
    return s * s * (3 - 2 * s);
  };
  const float sx = smooth(point.x() - fx);
  const float sy = smooth(point.y() - fy);
  const float sz = smooth(point.z() - fz);
  const auto mix = [](float low, float high, float share) { return low + share * (high - low); };
  const auto row = [&](std::int64_t j, std::int64_t k) { return mix(value_at(x, j, k), value_at(x + 1, j, k), sx); };
  return mix(mix(row(y, z), row(y + 1, z), sy), mix(row(y, z + 1), row(y + 1, z + 1), sy), sz);
}

}  // namespace

float value_noise(const Vec3& point, double size) {
  const Vec3 place = point / size;
  // Octaves are shifted against each other, so that their grids do not coincide.
  return (octave(place) + 0.5F * octave(2 * place + Vec3::Constant(0.37)) +
          0.25F * octave(4 * place + Vec3::Constant(0.71))) /
         1.75F;
}

}  // namespace insonify
