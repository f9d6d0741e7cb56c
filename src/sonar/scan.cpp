// scan.cpp -- angles of a scanning head.

#include "insonify/scan.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
// Tolerance for angles written in degrees, which conversion rounds.
constexpr double kAngleRounding = radians_from_degrees(1e-6);

}  // namespace

double RotatingScan::angle(std::uint64_t ping) const {
  if (sector_width > kTurn - kAngleRounding) {
    return sector_center + static_cast<double>(ping) * step;
  }
  // To and fro over `steps` steps: 0 1 2 .. steps .. 2 1 0 1 ..
  const auto steps = static_cast<std::uint64_t>((sector_width + kAngleRounding) / std::abs(step));
  const std::uint64_t phase = ping % (2 * steps);
  const std::uint64_t position_in_sector = std::min(phase, 2 * steps - phase);
  const double start = sector_center - std::copysign(sector_width / 2, step);
  return start + static_cast<double>(position_in_sector) * step;
}

std::uint64_t RotatingScan::pings_per_turn() const {
  if (sector_width > kTurn - kAngleRounding) {
    return static_cast<std::uint64_t>(std::ceil(kTurn / std::abs(step) - kAngleRounding));
  }
  return 1 + static_cast<std::uint64_t>((sector_width + kAngleRounding) / std::abs(step));
}

}  // namespace insonify
