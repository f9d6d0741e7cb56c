// path_footprint.h -- range interval over which an echo over a mirror is spread.

/// Length at both ends of a reflected ray or return leg within which it hits nothing [m]: more than the rounding error
/// of single precision at sonar ranges, less than any detail that a sonar resolves.
CONSTANT Real kRayClearance = REAL(1e-3);

/// The hit of a sample of the lattice on a mirror, and the reflected direction.
struct MirrorSample {
  Triple place;              ///< Position relative to the sonar [m].
  Triple normal, reflected;  ///< Unit vectors. The normal includes relief and may point to either side.
  Real range;                ///< Distance from the sonar [m].
};

/// @param direction  Of the ray, unit length.
LAW MirrorSample mirror_sample(Triple direction, Triple normal, Real range) {
  const MirrorSample hit = {range * direction, normal, reflect(direction, normal), range};
  return hit;
}

/// Differences between a neighbouring sample on the same mirror and a sample.
struct MirrorChange {
  Real range;    ///< [m]
  Triple place;  ///< Position [m].
  Triple turn;   ///< Reflected direction.
};

/// @return  Zeros if the neighbour `beside` is not on the same part of the surface: if it lies more than 30 degrees off
///          the tangent plane, or the normals differ by more than 26 degrees.
LAW MirrorChange mirror_change(MirrorSample here, MirrorSample beside) {
  const Triple place = beside.place - here.place, turn = beside.reflected - here.reflected;
  const Real off = dot(here.normal, place), alike = dot(here.normal, beside.normal);
  const bool near_plane = off * off <= REAL(0.25) * dot(place, place);
  const Real same_surface = both(near_plane, abs(alike) > REAL(0.9)) ? REAL(1.0) : REAL(0.0);
  const MirrorChange change = {same_surface * (beside.range - here.range), same_surface * place, same_surface * turn};
  return change;
}

/// The end of a path: from the mirror across to a second surface, and straight back to the sonar.
struct PathEnd {
  Real across;        ///< Distance from the mirror to the second surface [m].
  Triple direction;   ///< Direction from the mirror to the second surface, unit length.
  Triple normal;      ///< Unit normal of the second surface, on either side.
  Triple from_sonar;  ///< Direction from the sonar to the second surface, unit length.
  Real there, back;   ///< Length from the sonar by the mirror to the second surface, and of the way straight back [m].
};

/// Greatest length of the range interval, relative to that of the path. A convex mirror spreads the sound of one sample
/// over metres of the second surface: at its limb the reflected rays of neighbouring columns lie 17 degrees apart.
CONSTANT Real kWidestFootprint = REAL(0.05);

/// The same where the change from one row to the next is extrapolated to the rows that the sample stands for.
CONSTANT Real kWidestExtrapolation = REAL(0.005);

/// Half lengths of range intervals [m]. A uniform distribution over the interval has the variance of the range within
/// the solid angle of the sample.
struct PathFootprint {
  Real once, twice;  ///< For echoes by the mirror one way, and both ways.
};

/// Change of the lengths of a path with one to a neighbouring sample [m]. The changes include the curvature and relief
/// of the mirror; the second surface is replaced by its tangent plane. Since neither extends to infinity, the grazing
/// angle at the second surface is taken as at least 12 degrees.
LAW PathFootprint path_change(MirrorChange change, PathEnd end) {
  const Real kLeastGrazing = REAL(0.2);
  const Real facing = dot(end.direction, end.normal);
  const Real held = facing < 0 ? min(facing, -kLeastGrazing) : max(facing, kLeastGrazing);
  const Real along = dot(end.direction, end.from_sonar);
  const Triple moved = change.place + end.across * change.turn;
  const Real shorter = dot(moved, end.normal) / held;
  const PathFootprint changes = {change.range - shorter * (1 + along) + dot(moved, end.from_sonar),
                                 2 * (change.range - shorter)};
  return changes;
}

/// Half length of the interval for the changes of a path's length to the next row and column, limited to
/// kWidestFootprint of the path [m].
/// @param path  Its length [m].
LAW Real half_footprint(Real upward, Real sideward, Real rows, Real path) {
  const Real one_row = REAL(0.25) * abs(upward);
  const Real all_rows = max(one_row, min(rows * one_row, REAL(0.5) * kWidestExtrapolation * path));
  const Real across_columns = REAL(0.25) * sideward;
  const Real whole = sqrt(all_rows * all_rows + across_columns * across_columns);
  return min(whole, REAL(0.5) * kWidestFootprint * path);
}

/// docs/concepts/multipath.md, "Footprints".
/// @param above  Change to the next sample of the same column.
/// @param rows   Number of samples that this one stands for, see HitColumn::selected.
/// @param aside  Change to the same row of a neighbouring column.
LAW PathFootprint path_footprint(MirrorChange above, Real rows, MirrorChange aside, PathEnd end) {
  const PathFootprint up = path_change(above, end), side = path_change(aside, end);
  const PathFootprint footprint = {half_footprint(up.once, side.once, rows, end.there + end.back),
                                   half_footprint(up.twice, side.twice, rows, 2 * end.there)};
  return footprint;
}
