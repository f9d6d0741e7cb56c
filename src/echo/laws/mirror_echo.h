// mirror_echo.h -- echoes over a mirror in the `calibrated` model. Uses facet_lobe.h and facet_return.h.

/// Least ray-tube spreading relative to that of a plane mirror: bounds echoes near a focus.
CONSTANT Real kLeastSpread = REAL(0.01);

/// Length of a reflected ray beyond which its echo has a range of more than `max_range` [m]. The path out, across and
/// back is within twice the range as long as the second surface lies in an ellipsoid whose foci are the sonar and the
/// hit on the first surface.
/// @param range   Of the first surface [m].
/// @param cosine  Between the incident and the reflected direction.
LAW Real reflected_reach(Real range, Real cosine, Real max_range) {
  const Real kForRounding = REAL(1.0001);
  const Real kLeastDivisor = REAL(1e-6);  // [m]; avoids 0/0 for a hit at max_range and normal incidence.
  return kForRounding * 2 * max_range * (max_range - range) / (2 * max_range - range + range * cosine + kLeastDivisor);
}

/// Cosines at the second surface of a path.
struct SecondAngles {
  Real arriving;  ///< Between its normal and the direction the sound comes from.
  Real leaving;   ///< Between its normal and the direction to the sonar.
  Real between;   ///< Between its normal and the half vector of both directions.
  Real facet;     ///< Between the half vector and either direction: incidence on the facets.
};

/// @param normal  Of any length and side.
/// @param from    Direction the sound comes from, unit length.
/// @param back    Direction to the sonar, unit length.
LAW SecondAngles second_angles(Triple normal, Triple from, Triple back) {
  const Real kTiny = REAL(1e-20);
  const Triple middle = from + back;
  const Real normal_scale = 1 / sqrt(dot(normal, normal) + kTiny);
  const Real middle_scale = 1 / sqrt(dot(middle, middle) + kTiny);
  const SecondAngles cosines = {dot(normal, from) * normal_scale, dot(normal, back) * normal_scale,
                                dot(normal, middle) * (normal_scale * middle_scale), dot(from, middle) * middle_scale};
  return cosines;
}

/// A path from the sonar to a mirror, the first surface, and on to a second surface.
struct MirrorPath {
  Real reflectance;  ///< |R|^2 of the mirror at the angle of incidence, times its texture squared.
  Real share;        ///< MirrorFacet::share of the facet that reflects the sound; 1 for a smooth mirror.
  Real there;        ///< Length from the sonar to the mirror and on to the second surface [m].
  Real back;         ///< Length from the second surface straight to the sonar [m].
  Real spread;       ///< tube_spread()
  Real returned;     ///< face_return(): intensity that the mirror returns, relative to one without edges.
  SecondAngles at;   ///< At the second surface.
  Real texture;      ///< Factor on the amplitude of the second surface.
  FacetReturn over;  ///< Of the way back over the mirror; SecondAngles::arriving, 0 and 1 where no mirror has facets.
};

/// How the second surface of a path scatters.
struct SecondSurface {
  Scatterer towards;  ///< Back towards the mirror.
  Real on_top;        ///< AngularScattering::backscatter at the angle of arrival.
  Real mu;            ///< Between both directions: Lambert's parameter, and AngularScattering::diffuse of both.
  Real lobe;          ///< Between both directions: lobe_share() of Scatterer::lobe, or lobe_by_angle().
};

/// Share of the second surface's lobe that counts between both directions. Where both surfaces have a lobe, the same
/// reciprocal path is also found from the other end, with the second surface as the mirror. The lobe therefore counts
/// only where the mirror is the smoother of the two surfaces, and half where they are equally rough: two planes in a
/// corner give the echo of their one image.
LAW Real lobe_share(Real mirror_steepness, Real second_steepness) {
  return REAL(0.5) * (Real(mirror_steepness > second_steepness) + Real(mirror_steepness >= second_steepness));
}

/// SecondSurface::lobe where |R|^2 depends on the angle. What the surface does not reflect as a mirror always counts.
/// @param facets       1 / (8 pi s^2)
/// @param reflectance  |R|^2 at SecondAngles::facet.
/// @param mirrored     Share of it that is reflected as by a mirror.
/// @param share        lobe_share()
LAW Real lobe_by_angle(Real facets, Real reflectance, Real mirrored, Real share) {
  return facets * (reflectance - (1 - share) * mirrored);
}

/// Intensities relative to the source's at 1 m, per steradian of launched sound.
struct MirrorIntensities {
  Real once;   ///< By the mirror one way: of each of the two reciprocal echoes.
  Real twice;  ///< By the mirror both ways.
};

/// Lobe of the second surface towards the mirror, and what comes on top, per cosine of arrival: at FacetReturn::glint,
/// and for the share 1 - coherence with the variance of the facets' return added to that of the slopes.
LAW Real glint_over_mirror(SecondSurface second, FacetReturn over, Real arriving) {
  const Real kTiny = REAL(1e-20);
  const Real lobe = second.towards.lobe, steepness = second.towards.steepness;
  const Real glint = held_cosine(over.glint);
  const Real narrowed = 1 / (1 + 2 * over.variance * steepness);
  const Real along = (over.coherence * facet_lobe(lobe, steepness, glint) +
                      (1 - over.coherence) * facet_lobe(narrowed * lobe, narrowed * steepness, glint)) /
                     arriving;
  // The sea reflects less than its facets' lobe: by this factor, also where the lobe is widened.
  const Real whole = facet_lobe(lobe, steepness, arriving) / arriving + kTiny;
  const Real less = along * (1 + second.on_top / whole);
  return second.on_top < 0 ? (less > 0 ? less : REAL(0.0)) : along + second.on_top;
}

/// Intensities of the three echoes of a path by a mirror (docs/concepts/multipath.md, "Three echoes"). Sound that
/// leaves in dOmega falls on an area dA = dOmega A / in of the second surface, A being the area of the ray tube per
/// steradian. The way back by the mirror spreads by A too, by reciprocity:
///
///     once  = share |R|^2 s_b(in, out) / (in back^2)          e^(-2 gamma (there + back))
///     twice = share |R|^4 s_b(in, in)  / (in there^2 spread)  e^(-4 gamma there) returned
///
/// `in` is held at kLeastCosine and `spread` at kLeastSpread. There is no `once` where the angles of arrival and
/// leaving lie on opposite sides of the second surface.
LAW MirrorIntensities mirror_intensities(MirrorPath path, SecondSurface second, Real neper_per_metre) {
  const Real arriving = held_cosine(path.at.arriving), leaving = abs(path.at.leaving);
  const Real there = path.there, back = path.back;
  const Real spread = path.spread < kLeastSpread ? kLeastSpread : path.spread;
  const Real once_reflected = path.share * path.reflectance * path.texture * path.texture;
  const Real across = facet_lobe(second.lobe, second.towards.steepness, held_cosine(path.at.between)) / arriving;
  const Real once =
      once_reflected * (second.mu * leaving + across) / (back * back) * fast_exp(-2 * neper_per_metre * (there + back));
  const Real scattered_back = second.towards.lambert * arriving + glint_over_mirror(second, path.over, arriving);
  const Real twice = once_reflected * path.reflectance * path.returned * scattered_back / (there * there * spread) *
                     fast_exp(-4 * neper_per_metre * there);
  const MirrorIntensities intensities = {path.at.arriving * path.at.leaving > 0 ? once : REAL(0.0), twice};
  return intensities;
}
