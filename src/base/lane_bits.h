// lane_bits.h -- packs the tests x > 0 of 4 or 16 consecutive floats into bits.

#pragma once

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace insonify {

/// Bit i is set where values[i] > 0; i = 0..3.
inline unsigned positive_of_four(const float* values) {
#ifdef __SSE__
  return static_cast<unsigned>(_mm_movemask_ps(_mm_cmpgt_ps(_mm_loadu_ps(values), _mm_setzero_ps())));
#else
  unsigned bits = 0;
  for (unsigned i = 0; i < 4; ++i) {
    bits |= (values[i] > 0 ? 1U : 0U) << i;
  }
  return bits;
#endif
}

/// The same for i = 0..15.
inline unsigned positive_of_sixteen(const float* values) {
  return positive_of_four(values) | positive_of_four(values + 4) << 4 | positive_of_four(values + 8) << 8 |
         positive_of_four(values + 12) << 12;
}

}  // namespace insonify
