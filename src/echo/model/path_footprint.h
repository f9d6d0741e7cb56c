// path_footprint.h -- how much the length of a path by way of a mirror differs within the sample it stands for.

#pragma once

#include <algorithm>
#include <cmath>

#include "echo/model/triple.h"

namespace insonify {

/// Where a sample of the lattice met a mirror, and where its sound goes on to.
struct MirrorSample {
  Triple place;              ///< From the sonar [m].
  Triple normal, reflected;  ///< Of unit length; the normal with relief, on either side.
  float range;               ///< [m]

  [[gnu::always_inline]] static MirrorSample of(const Triple& direction, const Triple& normal, float range) {
    return {range * direction, normal, direction - 2 * direction.dot(normal) * normal, range};
  }
};

/// From a sample to one beside it on the same mirror: how much farther that is, where it lies, and how its way on
/// turns.
struct MirrorChange {
  float range = 0;
  Triple place = {}, turn = {};
};

/// @return  No change where the other is not on the same segment of surface: where the way there leaves the surface at
///          more than 30 degrees, or normals differ by more than 26.
[[gnu::always_inline]] inline MirrorChange mirror_change(const MirrorSample& here, const MirrorSample& beside) {
  const Triple place = beside.place - here.place, turn = beside.reflected - here.reflected;
  const float off = here.normal.dot(place), alike = here.normal.dot(beside.normal);
  const float same_surface = (off * off <= 0.25F * place.dot(place)) & (std::abs(alike) > 0.9F) ? 1.0F : 0.0F;
  return {same_surface * (beside.range - here.range), same_surface * place, same_surface * turn};
}

/// Those of sixteen samples.
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

/// How a path ends: across from the mirror to a second surface, and straight back.
struct PathEnd {
  float across;       ///< From the mirror [m].
  Triple direction;   ///< In which it comes from the mirror, of unit length.
  Triple normal;      ///< Of the second surface, of unit length, on either side.
  Triple from_sonar;  ///< Unit vector to the second surface from the sonar.
  float there, back;  ///< Out and across, and straight back [m].
};

/// No footprint is longer than this share of the path. A convex mirror spreads the sound of one sample over metres of
/// the second surface: at its limb the reflected rays of neighbouring columns lie 17 degrees apart.
inline constexpr float kWidestFootprint = 0.05F;

/// The same where the change from one row to the next is extrapolated to the rows that the sample stands for.
inline constexpr float kWidestExtrapolation = 0.005F;

/// Half lengths, in range, of the even segments with the variance of what a sample hears [m].
struct PathFootprint {
  float once, twice;  ///< By the mirror one way, and both ways.
};

/// Both changes follow the mirror's curvature and relief; the second surface is taken for its tangent plane, at no less
/// than 12 degrees of grazing, and the segment for no more than kWidestFootprint of the path, since neither goes on for
/// ever.
/// @param above, rows  Change to the next sample of the same column, and how many of them this one stands for.
/// @param aside        To that of a neighbouring column.
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
