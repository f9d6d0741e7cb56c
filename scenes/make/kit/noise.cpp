// noise.cpp -- lattice noise from an integer hash.

#include "kit/noise.h"

#include <cmath>

namespace {

// The finaliser of MurmurHash3 (A. Appleby, public domain): every input bit changes half of the output bits.
std::uint32_t scrambled(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x85EBCA6BU;
  x = (x ^ (x >> 13)) * 0xC2B2AE35U;
  return x ^ (x >> 16);
}

// With zero first and second derivative at both ends, so that no lattice line shows.
double fade(double t) {
  return t * t * t * (10 + t * (6 * t - 15));
}

double mix(double a, double b, double t) {
  return a + (b - a) * t;
}

}  // namespace

double chance(std::uint32_t seed, std::int32_t i, std::int32_t j, std::int32_t k) {
  std::uint32_t hash = scrambled(seed + 0x9E3779B9U);
  for (const std::int32_t value : {i, j, k}) {
    hash = scrambled(hash + 0x9E3779B9U + static_cast<std::uint32_t>(value));
  }
  return hash / 4294967296.0;
}

double noise(const Vec3& position, std::uint32_t seed) {
  const Vec3 low = position.array().floor();
  const Vec3 t = (position - low).unaryExpr(&fade);
  const auto corner = [&](int i, int j, int k) {
    return 2 * chance(seed, static_cast<int>(low.x()) + i, static_cast<int>(low.y()) + j,
                      static_cast<int>(low.z()) + k) -
           1;
  };
  const auto along_x = [&](int j, int k) { return mix(corner(0, j, k), corner(1, j, k), t.x()); };
  const auto along_y = [&](int k) { return mix(along_x(0, k), along_x(1, k), t.y()); };
  return mix(along_y(0), along_y(1), t.z());
}

double fractal_noise(const Vec3& position, std::uint32_t seed, int octaves, double roughness) {
  double sum = 0;
  double strength = 1 - roughness;
  double scale = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += strength * noise(position * scale, seed + octave);
    strength *= roughness;
    scale *= 2;
  }
  return sum;
}
