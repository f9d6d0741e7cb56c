// glint_window.h -- the part of a plane face that its glint comes from, and what of the glint is left where that part
// is hidden in places.

#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <span>

namespace insonify {

/// One side of a rectangle, in Fresnel's argument u from the point of stationary phase: docs/concepts/scattering.md,
/// "Glints of plane faces".
struct GlintSide {
  double low, high;   ///< Ends of the side.
  double scale;       ///< u per metre.
  double stationary;  ///< Point of stationary phase, from the middle of the side [m].
  double bend;        ///< b.

  /// @param foot     Foot of the perpendicular from the sonar, from the middle [m].
  /// @param half     Half length [m].
  /// @param nearest  Point of the side that is nearest to the sonar, from the middle [m].
  /// @param range    Of the face's nearest point [m].
  [[nodiscard]] static GlintSide of(double foot, double half, double nearest, double range, double wavelength);
};

/// A face that a sonar may see partly. Its window is what lies within kWindow of the point of stationary phase along
/// both sides, divided into kCells x kCells; the outermost cells reach to the ends of the sides.
struct GlintWindow {
  static constexpr int kCells = 16;
  static constexpr double kWindow = 3;
  static constexpr int kCount = kCells * kCells;

  std::array<GlintSide, 2> sides;

  /// Middle of a cell, from the middle of the face along both sides [m].
  [[nodiscard]] Eigen::Vector2d middle(int cell) const;

  /// Intensity of the glint relative to that of the whole face.
  /// @param passed  [cell] Share of the intensity that passes what lies before it, one way; 0 where it is hidden.
  [[nodiscard]] double visible(std::span<const double, kCount> passed) const;
};

/// Beyond this argument u of Fresnel's integrals outside a face, its echo is that of its edges alone.
inline constexpr double kFresnelReach = 1.5;

/// Distance beyond an end at which the specular echo has fallen to the level of the ends' echoes [m].
/// @param half  Half the length [m].
[[gnu::always_inline]] inline float fresnel_reach(float half, float distance, float wavelength) {
  const float zone = 0.5F * static_cast<float>(kFresnelReach) * std::sqrt(wavelength * distance);
  const float lobe = 0.25F * wavelength * distance / half;  // First zero of sinc, for a side shorter than a zone.
  return zone > lobe ? zone : lobe;
}

}  // namespace insonify
