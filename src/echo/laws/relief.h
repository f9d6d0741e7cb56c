// relief.h -- how a tile of slopes is mapped onto a surface, and the gradient of the surface there.

/// Product of two vectors, summed as Eigen does.
LAW Real inner(Triple a, Triple b) {
  return a.x * b.x + (a.y * b.y + a.z * b.z);
}

/// The direction of a vector; 0 for 0.
LAW Triple direction_of(Triple a) {
  const Real square = inner(a, a);
  const Real length = square > 0 ? sqrt(square) : REAL(1.0);
  return triple(a.x / length, a.y / length, a.z / length);
}

/// Unit normal of a surface with relief.
/// @param normal  Normal without relief, any length but zero.
LAW Triple bent_normal(Triple normal, Triple gradient) {
  return direction_of(direction_of(normal) - gradient);
}

/// Solid angle of a facet of the relief as the sonar sees it, re that of the flat surface beneath: (n - g).d / n.d, of
/// mean 1 over a relief whose slopes have mean 0. A facet that is turned away has none. No facet has more than twice as
/// much, for which as many others are hidden: so the mean over a symmetric relief stays 1.
/// @param facing  Cosine of incidence on the facet, of either sign.
LAW Real facet_share(Triple gradient, Triple direction, Real facing) {
  const Real along = inner(gradient, direction);
  const Real seen = facing * sqrt(1 + inner(gradient, gradient));
  const Real beneath = seen + along;  // Cosine on the flat surface, in the same measure.
  const Real share = beneath == 0 ? REAL(0.0) : seen / beneath;
  return share < 0 ? REAL(0.0) : (share > 2 ? REAL(2.0) : share);
}

/// The four texels around a point of a tile, and its shares of the right and the lower ones.
struct TexelPlace {
  int left, right, top, bottom;
  Real right_share, bottom_share;
};

/// The column or row of a whole number within one tile of 0..count.
LAW int wrapped(Real at, int count) {
  const int index = int(at);
  return index < 0 ? index + count : (index >= count ? index - count : index);
}

/// @param u,v  Any finite numbers; the tile covers 0..1 to the right and up, and is repeated.
LAW TexelPlace texel_place(Real u, Real v, int columns, int rows) {
  const Real x = (u - floor(u)) * Real(columns) - REAL(0.5);
  const Real y = (1 - (v - floor(v))) * Real(rows) - REAL(0.5);
  const Real left = floor(x), top = floor(y);
  const TexelPlace place = {wrapped(left, columns),
                            wrapped(left + 1, columns),
                            wrapped(top, rows),
                            wrapped(top + 1, rows),
                            x - left,
                            y - top};
  return place;
}

/// Bilinear value between four texels.
LAW Real texel_mean(Real top_left, Real top_right, Real bottom_left, Real bottom_right, Real right_share,
                    Real bottom_share) {
  const Real upper = (1 - right_share) * top_left + right_share * top_right;
  const Real lower = (1 - right_share) * bottom_left + right_share * bottom_right;
  return (1 - bottom_share) * upper + bottom_share * lower;
}

/// Texture coordinates of a triangle: of its first corner, and their changes along the edges to the other two.
struct TriangleTexture {
  Real u, v, u1, v1, u2, v2;
};

/// Texture coordinates at a point of a triangle, and their derivatives.
struct TextureFrame {
  Real u, v;
  Triple right, up;  ///< Derivatives of position by the two texture coordinates [m per tile].
  bool usable;       ///< False if the texture coordinates are degenerate on the triangle.
};

/// @param edge1,edge2  From the first corner.
/// @param point        Relative to it.
LAW TextureFrame texture_frame(Triple edge1, Triple edge2, TriangleTexture texture, Triple point) {
  // Triangles that cover less than this area of the picture have no usable texture coordinates.
  const Real kLeast = REAL(1e-12), kMost = REAL(3.4e38);
  const Real determinant = texture.u1 * texture.v2 - texture.u2 * texture.v1;
  const Triple across = cross(edge1, edge2);
  const Real scale = 1 / inner(across, across);
  const Real weight1 = scale * inner(across, cross(point, edge2));
  const Real weight2 = scale * inner(across, cross(edge1, point));
  const Real u = texture.u + weight1 * texture.u1 + weight2 * texture.u2;
  const Real v = texture.v + weight1 * texture.v1 + weight2 * texture.v2;
  const bool defined = both(abs(determinant) > kLeast, abs(determinant) <= kMost);
  const Triple right = texture.v2 * edge1 - texture.v1 * edge2, up = texture.u1 * edge2 - texture.u2 * edge1;
  const TextureFrame frame = {u, v, triple(right.x / determinant, right.y / determinant, right.z / determinant),
                              triple(up.x / determinant, up.y / determinant, up.z / determinant),
                              both(defined, both(abs(u) <= kMost, abs(v) <= kMost))};
  return frame;
}

/// Surface gradient of slopes that are metres of rise per side of the tile, by the reciprocal basis of `right` and
/// `up`.
LAW Triple gradient_of_rise(Real slope_right, Real slope_up, Triple right, Triple up, Triple normal) {
  const Real volume = inner(normal, cross(right, up));
  const Triple sum = slope_right * cross(up, normal) + slope_up * cross(normal, right);
  return triple(sum.x / volume, sum.y / volume, sum.z / volume);
}

/// Surface gradient of slopes that are rise over run. The right of the tile is the direction in which the first texture
/// coordinate grows fastest, and its top is normal to that: the tangent frame of Mikkelsen, "Simulation of wrinkled
/// surfaces revisited" (2008), for one triangle.
LAW Triple gradient_of_slopes(Real slope_right, Real slope_up, Triple right, Triple up, Triple normal) {
  const Triple along = direction_of(right - inner(normal, right) * normal);
  const Triple across = cross(normal, along);
  const Real side = inner(across, up) < 0 ? -slope_up : slope_up;
  return slope_right * along + side * across;
}

/// The gradient, or 0 where it is not finite.
LAW Triple finite_gradient(Triple gradient) {
  const Real kMost = REAL(3.4e38);
  const bool finite = both(abs(gradient.x) <= kMost, both(abs(gradient.y) <= kMost, abs(gradient.z) <= kMost));
  const Real none = REAL(0.0);
  return triple(finite ? gradient.x : none, finite ? gradient.y : none, finite ? gradient.z : none);
}

/// Shares of the three projections along the axes in a tile that is mapped by position, not yet of the sum 1: those of
/// Mikkelsen, "Surface gradient-based bump mapping framework", JCGT 9(3), 2020. Small ones are 0.
/// @param normal  Unit length.
LAW Triple projection_shares(Triple normal) {
  const Real kLeast = REAL(0.01), none = REAL(0.0);
  const Real x = normal.x * normal.x * (normal.x * normal.x), y = normal.y * normal.y * (normal.y * normal.y),
             z = normal.z * normal.z * (normal.z * normal.z);
  const Real sum = x + (y + z);
  return triple(x / sum < kLeast ? none : x / sum, y / sum < kLeast ? none : y / sum,
                z / sum < kLeast ? none : z / sum);
}

/// Mean of a value in the three projections.
/// @param shares  projection_shares()
LAW Real mean_of_projections(Triple values, Triple shares) {
  return (shares.x * values.x + shares.y * values.y + shares.z * values.z) / (shares.x + shares.y + shares.z);
}

/// Slopes in the three projections: seen along x, right is y and up is z; along y, x and z; along z, x and y.
struct ProjectedSlopes {
  Real x_right, x_up, y_right, y_up, z_right, z_up;
};

/// Surface gradient of the slopes of three projections.
/// @param shares  projection_shares()
/// @param scale   Rise over run of a slope of 1.
LAW Triple gradient_of_projections(ProjectedSlopes slopes, Triple shares, Real scale, Triple normal) {
  const Triple sum =
      triple(shares.y * slopes.y_right + shares.z * slopes.z_right, shares.x * slopes.x_right + shares.z * slopes.z_up,
             shares.x * slopes.x_up + shares.y * slopes.y_up);
  const Triple gradient = scale / (shares.x + shares.y + shares.z) * sum;
  return gradient - inner(normal, gradient) * normal;
}
