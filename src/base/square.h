#pragma once

namespace insonify {

inline double square(double x) {
  return x * x;
}

}  // namespace insonify
