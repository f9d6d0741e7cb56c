// path_footprint.h -- range interval over which an echo over a mirror is spread.

#pragma once

#include <algorithm>
#include <cmath>

#include "echo/model/triple.h"

namespace insonify {

/// The hit of a sample of the lattice on a mirror, and the reflected direction.
struct MirrorSample {
  Triple place;              ///< Position relative to the sonar [m].
  Triple normal, reflected;  ///< Unit vectors. The normal includes relief and may point to either side.
  float range;               ///< Distance from the sonar [m].

  [[gnu::always_inline]] static MirrorSample of(const Triple& direction, const Triple& normal, float range) {
    return {range * direction, normal, direction - 2 * direction.dot(normal) * normal, range};
  }
};

/// Differences between a neighbouring sample on the same mirror and a sample.
struct MirrorChange {
  float range = 0;    ///< [m]
  Triple place = {};  ///< Position [m].
  Triple turn = {};   ///< Reflected direction.
};

/// @return  Zeros if the neighbour `beside` is not on the same part of the surface: if it lies more than 30 degrees off
/// the
///          tangent plane, or the normals differ by more than 26 degrees.
[[gnu::always_inline]] inline MirrorChange mirror_change(const MirrorSample& here, const MirrorSample& beside) {
  const Triple place = beside.place - here.place, turn = beside.reflected - here.reflected;
  const float off = here.normal.dot(place), alike = here.normal.dot(beside.normal);
  const float same_surface = (off * off <= 0.25F * place.dot(place)) & (std::abs(alike) > 0.9F) ? 1.0F : 0.0F;
  return {same_surface * (beside.range - here.range), same_surface * place, same_surface * turn};
}

/// The MirrorChange of sixteen samples.
struct alignas(64) MirrorChanges {
  float range[16], place_x[16], place_y[16], place_z[16], turn_x[16], turn_y[16], turn_z[16];

  [[nodiscard, gnu::always_inline]] MirrorChange at(int lane) const {
    return {range[lane], {place_x[lane], place_y[lane], place_z[lane]}, {turn_x[lane], turn_y[lane], turn_z[lane]}};
  }
  [[gnu::always_inline]] void set(int lane, const MirrorChange& change) {
    range[lane] = change.range;
    place_x[lane] = change.place.x;
    place_y[lane] = change.place.y;
    place_z[lane] = change.place.z;
    turn_x[lane] = change.turn.x;
    turn_y[lane] = change.turn.y;
    turn_z[lane] = change.turn.z;
  }
};

/// The end of a path: from the mirror across to a second surface, and straight back to the sonar.
struct PathEnd {
  float across;       ///< Distance from the mirror to the second surface [m].
  Triple direction;   ///< Direction from the mirror to the second surface, unit length.
  Triple normal;      ///< Unit normal of the second surface, on either side.
  Triple from_sonar;  ///< Direction from the sonar to the second surface, unit length.
  float there, back;  ///< Length from the sonar by the mirror to the second surface, and of the way straight back [m].
};

/// Greatest length of the range interval, relative to that of the path. A convex mirror spreads the sound of one sample
/// over metres of the second surface: at its limb the reflected rays of neighbouring columns lie 17 degrees apart.
inline constexpr float kWidestFootprint = 0.05F;

/// The same where the change from one row to the next is extrapolated to the rows that the sample stands for.
inline constexpr float kWidestExtrapolation = 0.005F;

/// Half lengths of range intervals [m]. A uniform distribution over the interval has the variance of the range within
/// the solid angle of the sample.
struct PathFootprint {
  float once, twice;  ///< For echoes by the mirror one way, and both ways.
};

/// docs/concepts/multipath.md, "Footprints". The changes include the curvature and relief of the mirror; the second
/// surface is replaced by its tangent plane. Since neither extends to infinity, the grazing angle at the second surface
/// is taken as at least 12 degrees, and the interval is limited to kWidestFootprint of the path.
/// @param above  Change to the next sample of the same column.
/// @param rows   Number of samples that this one stands for, see HitColumn::selected.
/// @param aside  Change to the same row of a neighbouring column.
[[gnu::always_inline]] inline PathFootprint path_footprint(const MirrorChange& above, float rows,
                                                           const MirrorChange& aside, const PathEnd& end) {
  constexpr float kLeastGrazing = 0.2F;
  const float facing = end.direction.dot(end.normal);
  const float held = facing < 0 ? std::min(facing, -kLeastGrazing) : std::max(facing, kLeastGrazing);
  const float along = end.direction.dot(end.from_sonar);
  const auto change = [&](const MirrorChange& to) __attribute__((always_inline)) {
    const Triple moved = to.place + end.across * to.turn;
    const float shorter = moved.dot(end.normal) / held;
    return PathFootprint{to.range - shorter * (1 + along) + moved.dot(end.from_sonar), 2 * (to.range - shorter)};
  };
  const PathFootprint up = change(above), side = change(aside);
  const auto half_length = [&](float upward, float sideward, float path) __attribute__((always_inline)) {
    const float one_row = 0.25F * std::abs(upward);
    const float all_rows = std::max(one_row, std::min(rows * one_row, 0.5F * kWidestExtrapolation * path));
    const float across_columns = 0.25F * sideward;
    const float whole = std::sqrt(all_rows * all_rows + across_columns * across_columns);
    return std::min(whole, 0.5F * kWidestFootprint * path);
  };
  return {half_length(up.once, side.once, end.there + end.back), half_length(up.twice, side.twice, 2 * end.there)};
}

}  // namespace insonify
