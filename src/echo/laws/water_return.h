// water_return.h -- the way from a second surface to the sonar over the water's surface, a level mirror. Uses
// path_footprint.h.

/// Points above this depth count as on the water's surface [m].
CONSTANT Real kLeastDepth = REAL(1e-2);

/// Paths over the water's surface are not followed where its coherent reflectance is less.
CONSTANT Real kLeastWaterShare = REAL(1e-6);

/// It is as long as the straight way from the point to the sonar's image above the surface.
struct WaterLeg {
  Triple rising;       ///< Unit vector from the point to where the surface reflects.
  Real first, second;  ///< Lengths from the point to the surface and from there to the sonar [m].
  Real cosine;         ///< Cosine of the angle of incidence on the surface.
};

/// @param level  z of the surface; point and sonar lie below [m].
LAW WaterLeg water_leg(Real level, Triple sonar, Triple point) {
  const Real depth = level - point.z, sonar_depth = level - sonar.z;
  const Triple straight = triple(sonar.x - point.x, sonar.y - point.y, sonar_depth + depth);
  const Real whole = sqrt(dot(straight, straight)), share = depth / (sonar_depth + depth);
  const WaterLeg leg = {(1 / whole) * straight, share * whole, (1 - share) * whole, straight.z / whole};
  return leg;
}

/// Length at the surface within which neither ray of such a way hits anything: where they graze it, they are near it
/// for longer than kRayClearance [m].
LAW Real water_clearance(WaterLeg leg) {
  const Real kLeastRise = REAL(0.02);
  return kRayClearance / max(leg.rising.z, kLeastRise);
}
