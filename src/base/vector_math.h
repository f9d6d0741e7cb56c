// vector_math.h -- branch-free elementary functions that the compiler can vectorize, and its target clones.

#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

// A function marked INSONIFY_VECTOR_CLONES is compiled for several instruction sets, and the best one is chosen when
// the program starts. Contraction into fused multiply-adds is off (CMakeLists.txt), so that all clones give the same
// bits. INSONIFY_FUSED_CLONES is for the one file where contraction is on (gain_matrix.cpp); there the AVX2 clone has
// fused multiply-adds too. Processors without them round differently, and so do builds without clones (clang, or with
// sanitizers).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#if __GNUC__ >= 12
#define INSONIFY_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#define INSONIFY_FUSED_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else  // GCC 11 has no dispatch by architecture levels.
#define INSONIFY_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#define INSONIFY_FUSED_CLONES __attribute__((target_clones("arch=haswell", "default")))
#endif
#else
#define INSONIFY_VECTOR_CLONES
#define INSONIFY_FUSED_CLONES
#endif

namespace insonify {

/// x held at 0..1. In integers, by the order of their bits: compilers turn comparisons of floats into branches that
/// they then do not vectorize.
[[gnu::always_inline]] inline float held_in_unit(float x) {
  constexpr std::int32_t kOne = 0x3f800000;
  const auto bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t positive = bits > 0 ? bits : 0;
  return std::bit_cast<float>(positive < kOne ? positive : kOne);
}

/// e^x, relative error below 2e-7 for x in -87..88; clamped there. After Moshier's Cephes library (expf).
[[gnu::always_inline]] inline float fast_exp(float x) {
  x = x < -87.0F ? -87.0F : x > 88.0F ? 88.0F : x;
  // Adding and subtracting 1.5 x 2^23 rounds to the nearest integer.
  constexpr float kRounder = 12582912.0F;
  const float n = (x * 1.44269504088896341F + kRounder) - kRounder;
  const float r = (x - n * 0.693359375F) - n * -2.12194440e-4F;
  float p = 1.9875691500e-4F;
  p = p * r + 1.3981999507e-3F;
  p = p * r + 8.3334519073e-3F;
  p = p * r + 4.1665795894e-2F;
  p = p * r + 1.6666665459e-1F;
  p = p * r + 5.0000001201e-1F;
  const float e = p * r * r + r + 1;
  return e * std::bit_cast<float>((static_cast<std::int32_t>(n) + 127) << 23);
}

/// ln x for normal x > 0, absolute error below 3e-7. After Cephes (logf).
[[gnu::always_inline]] inline float fast_log(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  // Mantissa in sqrt(1/2)..sqrt(2).
  const std::uint32_t shifted = bits - 0x3f3504f3U;
  const auto exponent = static_cast<float>(static_cast<std::int32_t>(shifted) >> 23);
  const float m = std::bit_cast<float>((shifted & 0x007fffffU) + 0x3f3504f3U) - 1;
  float p = 7.0376836292e-2F;
  p = p * m - 1.1514610310e-1F;
  p = p * m + 1.1676998740e-1F;
  p = p * m - 1.2420140846e-1F;
  p = p * m + 1.4249322787e-1F;
  p = p * m - 1.6668057665e-1F;
  p = p * m + 2.0000714765e-1F;
  p = p * m - 2.4999993993e-1F;
  p = p * m + 3.3333331174e-1F;
  const float square = m * m;
  return m + (p * m * square - 0.5F * square) + exponent * 0.693147180559945F;
}

/// Sine and cosine of `turns` full turns, 0..1, absolute error below 3e-7.
struct SineCosine {
  float sine, cosine;
};
[[gnu::always_inline]] inline SineCosine fast_sine_cosine(float turns) {
  constexpr float kRounder = 12582912.0F;
  const float quarters = (4 * turns + kRounder) - kRounder;
  const auto quadrant = static_cast<std::int32_t>(quarters);
  const float x = (4 * turns - quarters) * 1.57079632679489662F;
  const float square = x * x;
  const float s = x + x * square * (-1.6666654611e-1F + square * (8.3321608736e-3F - square * 1.9515295891e-4F));
  const float c =
      1 - 0.5F * square + square * square * (4.166664568e-2F + square * (-1.388731625e-3F + square * 2.443315711e-5F));
  const bool swapped = (quadrant & 1) != 0;
  const float sine = swapped ? c : s;
  const float cosine = swapped ? s : c;
  return {(quadrant & 2) != 0 ? -sine : sine, ((quadrant + 1) & 2) != 0 ? -cosine : cosine};
}

}  // namespace insonify
