// decibels.h -- intensities to decibels and back.

#pragma once

#include <cmath>

namespace insonify::validation {

inline double db(double intensity) {
  return 10 * std::log10(intensity);
}

inline double linear(double level_db) {
  return std::pow(10, level_db / 10);
}

}  // namespace insonify::validation
