// lanes.h -- vectors of four floats or labels, for loops over neighbouring cells of a beam.

#pragma once

#include <cstring>

#include "echo/grid/echo.h"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace insonify {

inline constexpr int kLanes = 4;
using Floats = float __attribute__((vector_size(4 * kLanes)));
using Labels = SurfaceLabel __attribute__((vector_size(4 * kLanes)));

template <typename Value>
[[gnu::always_inline]] inline Value load(const void* from) {
  Value value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

template <typename Value>
[[gnu::always_inline]] inline void store(void* to, const Value& value) {
  std::memcpy(to, &value, sizeof value);
}

template <typename Value>
[[gnu::always_inline]] inline void add_to(float* to, const Value& value) {
  store(to, load<Value>(to) + value);
}

template <typename Value>
[[gnu::always_inline]] inline Value larger(Value a, Value b) {
  return a > b ? a : b;
}
template <typename Value>
[[gnu::always_inline]] inline Value smaller(Value a, Value b) {
  return a < b ? a : b;
}

// One instruction each; GCC 12 does not find them by itself.
#ifdef __SSE__
template <>
[[gnu::always_inline]] inline Floats larger(Floats a, Floats b) {
  return _mm_max_ps(a, b);
}
template <>
[[gnu::always_inline]] inline Floats smaller(Floats a, Floats b) {
  return _mm_min_ps(a, b);
}
#endif

}  // namespace insonify
