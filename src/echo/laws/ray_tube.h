// ray_tube.h -- ray-tube spreading after reflection by a mirror that may be curved.

/// Cross section of a ray tube per unit of solid angle at the sonar, at the distance `across` behind the mirror:
/// |constant + linear across + quadratic across^2| [m^2].
struct RayTube {
  Real constant, linear, quadratic;
};

/// That of a plane mirror.
LAW RayTube plane_tube(Real range) {
  const RayTube tube = {range * range, 2 * range, 1};
  return tube;
}

/// Area of a ray tube at the second surface, relative to that by a plane mirror.
/// @param there  Length from the sonar to the mirror and on to the second surface [m].
LAW Real tube_spread(RayTube tube, Real across, Real there) {
  return abs(tube.constant + across * (tube.linear + across * tube.quadratic)) / (there * there);
}

/// A triangle with vertex normals.
struct CurvedTriangle {
  Triple edge1, edge2;               ///< From its first corner to the others [m].
  Triple normal0, normal1, normal2;  ///< Unit length, on either side.
};

/// Derivatives of the hit and of the reflected direction with respect to the ray's direction [1/rad].
struct RayDifferential {
  Triple place, turn;
};

/// dot(), summed in another order: the last bits of pings depend on it.
LAW Real tube_dot(Triple a, Triple b) {
  return a.x * b.x + (a.y * b.y + a.z * b.z);
}

/// @param aside   Change of the ray's direction, unit length, at right angles to it.
/// @param about   Normal at the hit, on the side of the vertex normals.
LAW RayDifferential ray_differential(CurvedTriangle mirror, Triple direction, Triple about, Real range, Triple aside) {
  const Triple flat_normal = cross(mirror.edge1, mirror.edge2);
  const Real facing = tube_dot(direction, flat_normal), doubled = tube_dot(flat_normal, flat_normal);
  const Triple place = range * (aside - (tube_dot(aside, flat_normal) / facing) * direction);
  // Barycentric coordinates of `place`, from ratios of areas.
  const Real along1 = tube_dot(cross(place, mirror.edge2), flat_normal) / doubled;
  const Real along2 = tube_dot(cross(mirror.edge1, place), flat_normal) / doubled;
  const Triple change = along1 * (mirror.normal1 - mirror.normal0) + along2 * (mirror.normal2 - mirror.normal0);
  const Triple bend = change - tube_dot(about, change) * about;
  const Real cosine = tube_dot(direction, about);
  const RayDifferential differential = {
      place, aside - 2 * ((tube_dot(aside, about) + tube_dot(direction, bend)) * about + cosine * bend)};
  return differential;
}

/// A unit vector at right angles to another.
LAW Triple orthogonal(Triple v) {
  const Real kNone = REAL(1e-5);
  const bool upright = both(abs(v.x) <= kNone * abs(v.z), abs(v.y) <= kNone * abs(v.z));
  const Real a = upright ? v.y : v.x, b = upright ? v.z : v.y;
  const Real scale = 1 / sqrt(a * a + b * b);
  return triple(upright ? REAL(0.0) : -b * scale, upright ? -b * scale : a * scale, upright ? a * scale : REAL(0.0));
}

/// Ray tube of a mirror given by a triangle with vertex normals, which are interpolated linearly: Igehy, "Tracing ray
/// differentials", SIGGRAPH 1999. For a sphere of radius a, hit at an angle t from its normal at the range r, the area
/// is r^2 (1 + across (1/r + 2/(a cos t))) (1 + across (1/r + 2 cos t/a)). Equal normals make a plane.
/// @param direction  Direction of the incident sound, unit length.
/// @param normal     Unit normal at the hit with relief, on either side.
/// @param range      Distance from the sonar to the hit [m].
LAW RayTube ray_tube(CurvedTriangle mirror, Triple direction, Triple normal, Real range) {
  const Triple change1 = mirror.normal1 - mirror.normal0, change2 = mirror.normal2 - mirror.normal0;
  const Triple flat_normal = cross(mirror.edge1, mirror.edge2);
  const Real facing = tube_dot(direction, flat_normal), doubled = tube_dot(flat_normal, flat_normal);
  if ((change1 == triple(0, 0, 0) && change2 == triple(0, 0, 0)) || facing * facing <= REAL(1e-8) * doubled) {
    return plane_tube(range);
  }
  const Triple sum = mirror.normal0 + mirror.normal1 + mirror.normal2;
  const Triple about = tube_dot(normal, sum) < 0 ? REAL(-1.0) * normal : normal;
  const Triple aside = orthogonal(direction);
  const RayDifferential a = ray_differential(mirror, direction, about, range, aside);
  const RayDifferential b = ray_differential(mirror, direction, about, range, cross(direction, aside));
  const Triple reflected = direction - (2 * tube_dot(direction, about)) * about;
  const RayTube tube = {tube_dot(cross(a.place, b.place), reflected),
                        tube_dot(cross(a.place, b.turn) + cross(a.turn, b.place), reflected),
                        tube_dot(cross(a.turn, b.turn), reflected)};
  return tube;
}
