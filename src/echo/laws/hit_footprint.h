// hit_footprint.h -- what follows from one hit and from two neighbouring ones: cosine of incidence, relief, and the
// interval of ranges between them.

/// Change of a hit's position from the middle of its column to its edge, from the tangent plane: there
/// d(range)/d(azimuth) = -range (normal . d(direction)/d(azimuth)) / (normal . direction). Bounded at grazing
/// incidence.
/// @param scale     Half width of the column [rad] times bins per metre.
/// @param sideways  |normal . d(direction)/d(azimuth)|
LAW Real footprint_reach(Real scale, Real range, Real sideways, Real facing) {
  const Real kLeast = REAL(0.1);
  return scale * range * sideways / max(abs(facing), kLeast);
}

/// footprint_reach()'s `sideways` in a wedge.
/// @param across  Product of the normal with ColumnAxes::across.
LAW Real sideways_in_wedge(Real across, Real cos_t) {
  return abs(across) * cos_t;
}

/// The same on a cone, at constant elevation as in a wedge, so that a level seabed has the same range over the whole
/// footprint. With sin(elevation) = cos a sin t, d(direction)/da = across - along tan a / cos t. Towards the end of the
/// cone's arc the bearing no longer changes with the direction across it.
LAW Real sideways_on_cone(Real across, Real along, Real tan_bearing, Real cos_t) {
  const Real kLeast = REAL(0.2);
  const Real held = cos_t > kLeast ? cos_t : kLeast;
  return abs(across - tan_bearing / held * along);
}

/// A surface with its relief, as a ray hits it.
struct BentSurface {
  Triple normal;  ///< Unit length.
  Real facing;    ///< Cosine between ray and normal; 0 where the facet faces away.
  Real escapes;   ///< 0 where the ray is reflected into the surface, else 1.
};

/// Tilts a unit normal by the relief. A facet that faces away is in the shadow of its own surface and gives no echo. A
/// ray that is reflected into the surface would hit it again at once, in a trough that the triangles do not have.
/// @param level     Unit normal without relief.
/// @param gradient  ReliefPoint::gradient
/// @param facing    Cosine between ray and `level`.
LAW BentSurface bent_surface(Triple direction, Triple level, Triple gradient, Real facing) {
  const Real kTiny = REAL(1e-20);
  const Triple tilted = level - gradient;
  const Real scale = 1 / sqrt(dot(tilted, tilted) + kTiny);
  const Triple normal = scale * tilted;
  const Real bent = dot(normal, direction);
  // Product of the reflected ray and the normal without relief: d . n - 2 (d . b) (b . n).
  const Real reflected = facing - 2 * bent * dot(normal, level);
  const BentSurface surface = {normal, bent * facing > 0 ? bent : REAL(0.0),
                               reflected * facing < 0 ? REAL(1.0) : REAL(0.0)};
  return surface;
}

/// Whether two neighbouring hits on one surface lie on an unbroken part of it: the range of each differs from that of
/// the other's tangent plane by at most one bin plus a share of the difference of their ranges. Curved surfaces pass,
/// edges and shadows do not.
/// @param facing_a  Cosine between the normal and the ray of a.
/// @param b_from_a  Cosine between the normal of a and the ray of b.
/// @param bin       Length of a bin [m].
LAW bool unbroken(Real range_a, Real facing_a, Real b_from_a, Real range_b, Real facing_b, Real a_from_b, Real bin) {
  const Real kBend = REAL(0.3);
  const Real apart = abs(range_a - range_b);
  const Real tolerance = bin + kBend * apart;
  // Both sides are multiplied by the cosine of incidence, instead of divided.
  const bool forth = abs(range_a * facing_a - range_b * b_from_a) < tolerance * abs(b_from_a);
  const bool back = abs(range_b * facing_b - range_a * a_from_b) < tolerance * abs(a_from_b);
  return either(apart < bin, both(forth, back));
}

/// Least half length of a segment at a position, which may be negative [bins]: keeps its density finite in single
/// precision.
LAW Real least_half_length(Real position) {
  return REAL(1e-7) * max(position < 0 ? -position : position, REAL(500.0));
}

/// Factor on the power of an echo of whose weight only a share is kept, so that its energy stays as it is; 0 where
/// nothing is kept. Behind and on surfaces that let sound through, a weight is the solid angle whose sound goes no
/// further.
LAW Real per_kept(Real kept) {
  return kept > 0 ? 1 / kept : REAL(0.0);
}

/// The echo of the surface between two neighbouring samples: its weight is spread evenly over an interval of positions,
/// over which its power changes linearly. Positions are in bins from the near edge of bin 0.
struct FootprintSegment {
  Real low, high;  ///< Ends of the interval [bins]. An empty interval, low >= high, adds nothing.
  Real power;      ///< Power at position 0, by extrapolation.
  Real half_rise;  ///< Half the change of power per bin.
  Real density;    ///< Weight per bin [sr].
  Real elevation;  ///< Elevation of the echo [rad].
};

/// Position of the end of a segment that extends beyond the last sample of a surface: at most 1.5 times as far as that
/// sample is from its neighbour on the surface.
/// @param here    Position of the sample [bins].
/// @param behind  Position of the neighbour.
/// @param wished  Position of the sample's tangent plane at the end; anything where the plane is parallel to it.
LAW Real extended_to(Real here, Real behind, Real wished) {
  const Real most = REAL(1.5) * abs(here - behind);
  return wished > here - most ? min(wished, here + most) : here - most;
}

/// A sample at the end of a segment.
struct SegmentEnd {
  Real position;  ///< [bins]
  Real reach;     ///< footprint_reach() [bins]
  Real power;     ///< Energy per unit of weight.
};

/// @param weight  Solid angle between both samples [sr].
/// @param bins    Number of bins, which the interval is limited to.
LAW FootprintSegment segment_between(SegmentEnd a, SegmentEnd b, Real weight, Real bins, Real elevation) {
  const bool rising = a.position < b.position;
  const Real beyond = REAL(0.5) * (a.reach + b.reach) + least_half_length(b.position);
  const Real near = (rising ? a.position : b.position) - beyond;
  const Real far = (rising ? b.position : a.position) + beyond;
  const Real per_bin = 1 / (far - near);
  const Real near_power = rising ? a.power : b.power;
  const Real rise = ((rising ? b.power : a.power) - near_power) * per_bin;
  const FootprintSegment segment = {near < 0 ? REAL(0.0) : (near < bins ? near : bins),
                                    far < bins ? far : bins,
                                    near_power - near * rise,
                                    REAL(0.5) * rise,
                                    weight * per_bin,
                                    elevation};
  return segment;
}
