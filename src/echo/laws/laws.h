// laws.h -- the formulas of echoes in single precision, for loops over lanes, and as `precise` in double precision.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/philox.h"
#include "base/vector_math.h"
#include "insonify/geometry.h"

#define LAW [[gnu::always_inline]] inline
#define CONSTANT inline constexpr

namespace insonify {

using Real = float;
#define REAL(literal) literal##F
#include "echo/laws/all.h"
#undef REAL

inline Triple triple_of(const Vec3f& v) {
  return {v.x(), v.y(), v.z()};
}

namespace precise {

// Functions of base/vector_math.h.
struct SineCosine {
  double sine, cosine;
};
inline SineCosine fast_sine_cosine(double turns) {
  constexpr double kFullTurn = 6.283185307179586;
  return {std::sin(kFullTurn * turns), std::cos(kFullTurn * turns)};
}
inline double fast_exp(double x) {
  return std::exp(x);
}
inline double fast_log(double x) {
  return std::log(x);
}

// Of base/philox.h.
inline double uniform_open(std::uint32_t word) {
  return double{insonify::uniform_open(word)};
}

using Real = double;
#define REAL(literal) literal
#include "echo/laws/all.h"
#undef REAL

inline Triple triple_of(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace precise

}  // namespace insonify

#undef LAW
#undef CONSTANT
