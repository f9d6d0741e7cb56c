// triple.h -- a vector of three floats for loops over lanes.

#pragma once

namespace insonify {

/// Plain floats instead of an Eigen vector, so that the compiler vectorises loops over lanes.
struct Triple {
  float x, y, z;

  [[nodiscard, gnu::always_inline]] float dot(const Triple& other) const {
    return x * other.x + y * other.y + z * other.z;
  }
  [[gnu::always_inline]] friend Triple operator+(const Triple& a, const Triple& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  [[gnu::always_inline]] friend Triple operator-(const Triple& a, const Triple& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  [[gnu::always_inline]] friend Triple operator*(float scale, const Triple& a) {
    return {scale * a.x, scale * a.y, scale * a.z};
  }
};

}  // namespace insonify
