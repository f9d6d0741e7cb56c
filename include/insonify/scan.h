// scan.h -- how the beams of a sonar turn from ping to ping.

#pragma once

#include <cstdint>
#include <numbers>
#include <variant>

#include "insonify/geometry.h"
#include "insonify/words.h"

namespace insonify {

/// Axis about which a scanning head turns: the housing's z (a plan view), or its y, rolled by 90 degrees (a slice).
enum class Mounting { kHorizontal, kVertical };
template <>
constexpr auto words_of<Mounting>() {
  return EnumWords<Mounting, 2>{{{"horizontal", Mounting::kHorizontal}, {"vertical", Mounting::kVertical}}};
}

/// Beams that do not turn in their housing.
struct FixedScan {
  [[nodiscard]] double angle(std::uint64_t /*ping*/) const { return 0; }  ///< [rad]
  [[nodiscard]] std::uint64_t pings_per_turn() const { return 1; }
};

/// A head that turns by a step after each ping.
struct RotatingScan {
  double step = radians_from_degrees(0.9);     ///< Turn of the head between pings, positive to port [rad], not 0.
  double sector_center = 0;                    ///< Middle of the scanned sector [rad].
  double sector_width = 2 * std::numbers::pi;  ///< Full circle: keeps turning; less: sweeps to and fro [rad], in
                                               ///< (0, 2 pi].
  Mounting mounting = Mounting::kHorizontal;

  /// Angle of the head at a ping [rad]. On a full circle the head starts at sector_center and keeps turning, and the
  /// angle is not wrapped. In a sector it starts at one edge, steps away from it, and turns back at the last whole step
  /// inside the sector.
  [[nodiscard]] double angle(std::uint64_t ping) const;

  /// Pings in which the head turns once round, or sweeps once across its sector.
  [[nodiscard]] std::uint64_t pings_per_turn() const;
};

using Scan = std::variant<FixedScan, RotatingScan>;

}  // namespace insonify
