// xtf_navigation.h -- poses and altitudes of a side-scan's pings, from the heads of XTF packets.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/foreign/foreign_tables.h"

namespace insonify {

/// What a packet's head says of the fish, in the file's units.
struct XtfFix {
  double y = 0, x = 0;                      ///< Latitude and longitude [deg], or metres.
  double depth = 0, altitude = 0;           ///< [m]; 0 where unknown.
  double pitch = 0, roll = 0, heading = 0;  ///< Nose up, starboard down, from north to east [deg].
  double sound_speed = 0;                   ///< [m/s], or half of it.

  [[nodiscard]] bool has_place() const { return x != 0 || y != 0; }
};

/// @param head  256 bytes of a sonar packet. Numbers that are not finite are taken as 0.
[[nodiscard]] XtfFix xtf_fix(std::span<const std::uint8_t> head);

/// Sound speed with which a ping's time becomes range [m/s]: Triton's own programs store half of it, 750, others 1500.
/// NaN if it is neither.
[[nodiscard]] double xtf_sound_speed(const XtfFix& fix);

/// Adds `world_from_sonar` and, where there are any, `altitude` and `sound_speed`. The world's origin is the first fix
/// with a place, its x east and y north; the attribute `origin` has its latitude and longitude. A ping without a place
/// has that of the next one with a place, or of the last.
/// @param degrees  Whether places are latitudes and longitudes.
void add_navigation(ForeignTables& tables, std::vector<XtfFix> fixes, bool degrees);

}  // namespace insonify
