// wedge.cpp -- Keller's backscatter coefficient of a wedge, one term per face.

#include "acoustics/wedge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insonify {
namespace {

double cotangent(double angle) {
  return std::cos(angle) / std::sin(angle);
}

}  // namespace

double wedge_backscatter(double exterior, const std::array<WedgeFace, 2>& faces, double mirror) {
  double sum = 2 * cotangent(0.5 * std::numbers::pi / exterior);
  for (const WedgeFace& face : faces) {
    const double off =
        0.5 * std::numbers::pi - face.angle;  // < 0 if the edge is the end of the face nearest to the source.
    const double held = off < 0 ? std::min(off, -mirror) : std::max(off, mirror);
    sum += face.reflection * cotangent(held / exterior);
  }
  return -sum / (4 * std::numbers::pi * exterior);
}

}  // namespace insonify
