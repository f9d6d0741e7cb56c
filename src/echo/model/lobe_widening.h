// lobe_widening.h -- widening of the facets' lobe by the curvature of a surface within a sample's footprint.

#pragma once

namespace insonify {

/// Variance of the place within a footprint along one side, in squares of the sample spacing: that of a tent, which
/// falls to 0 at the next sample. The sum of Gaussians of this variance on a square lattice is constant within 0.7 dB.
inline constexpr float kFootprintVariance = 1.0F / 6;

/// A wider lobe, in terms of the lobe of a flat surface.
template <typename Value>
struct LobeWidening {
  Value share = 1;   ///< Square of the factor on the lobe's height, 0..1; 1 where the surface is flat.
  Value spared = 0;  ///< Decrease of the squared sine of incidence at which the lobe is evaluated, 0..1.
};

/// The turns u and v of a unit normal n over the footprint of a sample, from row to row and from column to column, by
/// their products with each other and with the ray d.
template <typename Value>
struct TurnProducts {
  Value up_up, side_side, up_side;  ///< u . u, v . v, u . v
  Value up_ray, side_ray;           ///< u . d, v . d
  Value up_normal, side_normal;     ///< u . n, v . n
};

/// Facets of slope s along each axis on a surface whose normal turns by u and v have slopes of the covariance
///
///     S = s^2 1 + k (u u' + v v'),     k = kFootprintVariance
///
/// in the plane across the ray, all vectors being their parts in that plane. The lobe of the footprint is that of flat
/// facets at the angle whose sine is s sqrt(w' S^-1 w), w being the part of the normal, times sqrt(s^4 / det S).
/// docs/concepts/scattering.md, "Curved surfaces".
/// @param cosine     n . d
/// @param steepness  1 / (2 s^2)
template <typename Value>
[[gnu::always_inline]] inline LobeWidening<Value> widen_lobe(const TurnProducts<Value>& turns, Value cosine,
                                                             Value steepness) {
  const Value scale = 2 * Value{kFootprintVariance} * steepness;  // k / s^2
  const Value uu = scale * (turns.up_up - turns.up_ray * turns.up_ray);
  const Value vv = scale * (turns.side_side - turns.side_ray * turns.side_ray);
  const Value uv = scale * (turns.up_side - turns.up_ray * turns.side_ray);
  const Value uw = turns.up_normal - cosine * turns.up_ray;
  const Value vw = turns.side_normal - cosine * turns.side_ray;
  const Value gram = uu * vv - uv * uv;
  const Value share = 1 / (1 + uu + vv + gram);
  return {share, share * (gram * (1 - cosine * cosine) + scale * (uw * uw + vw * vw))};
}

}  // namespace insonify
