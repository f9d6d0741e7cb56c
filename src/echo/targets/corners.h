// corners.h -- inside corners of three perpendicular mirrors: how to find them, and their echo.

#pragma once

#include <array>
#include <optional>
#include <vector>

#include "echo/targets/plane_mirrors.h"

namespace insonify {

/// An inside corner of three perpendicular mirrors (a trihedral, as of a radar reflector or a tank): sound that all
/// three reflect returns to its source. Axes a, b and c point from the apex along the three edges; mirror k is
/// perpendicular to axis k, and only its quarter between the other two axes counts.
struct Corner {
  static constexpr int kSteps = 64;  ///< Directions in each mirror.
  static constexpr std::size_t kMost =
      1024;  ///< Most corners of the world or of one moving instance; the largest are taken.
  static constexpr double kPerpendicular = 2e-3;  ///< Largest cosine between the normals of two of its mirrors.
  static constexpr double kLeastEdge = 5e-3;      ///< Smaller mirrors make no corner [m].
  static constexpr double kGap = 2e-3;            ///< Largest gap between triangles of one mirror that is ignored [m].
  static constexpr float kEndless = 1e5F;         ///< Extent of the water's surface [m].

  int instance = -1;  ///< Instance in whose mesh frame the corner is given; -1: the world frame.
  Vec3 apex = Vec3::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< Unit vectors a, b and c as columns.
  std::array<SurfaceLabel, 3> surfaces = {};           ///< Labels of the mirrors at the apex.

  /// [mirror][step] Extent of mirror k from the apex [m], as the sum u + v of the coordinates u along edge k + 1 and v
  /// along edge k + 2 (cyclic) of the point where it first ends, in the direction v / (u + v) = step / kSteps.
  std::array<std::array<float, kSteps + 1>, 3> extents = {};

  bool from_behind = false;  ///< Whether the triangles of all three mirrors face away from the octant.

  /// Radius of the corner's effective aperture, seen along the line of sight, in one direction [m]: farther off, sound
  /// is not reflected by all three mirrors.
  ///
  /// Unfolded by reflection in the mirrors, a path over all three is a straight line that crosses each plane once. It
  /// exists if each crossing, reflected back into the octant, lies on its mirror. So the aperture is the common outline
  /// of the three mirrors and their images, projected along the line of sight; it is symmetric about the apex (Spencer,
  /// "Optical theory of the corner reflector", MIT Radiation Laboratory report 433 (1944)).
  /// @param sight   From the apex to the sonar, along the axes; unit length, all components > 0.
  /// @param across  Unit vector perpendicular to `sight`, along the axes: the direction of the radius.
  [[nodiscard]] double radius(const Vec3& sight, const Vec3& across) const;

  /// Intensity at the sonar relative to the source's at 1 m, for perfect mirrors without absorption: Kirchhoff's
  /// integral over the aperture with radius R(phi),
  ///
  ///     1/(4 r^2) | 1 - mean over phi of e^(i k R^2 / r) |^2
  ///
  /// In the far field it is A^2/(lambda^2 r^4) with the aperture's area A (Knott, Shaeffer and Tuley, Radar Cross
  /// Section, ch. 6). Close to the corner it approaches 1/(4 r^2), the intensity of the sonar's image in the apex.
  /// @param range       r, to the apex [m], > 0.
  /// @param wavelength  [m]
  [[nodiscard]] double reflected(const Vec3& sight, double range, double wavelength) const;
};

/// Finds the corners of a scene: those between PlaneMirrors of static instances and the water's surface, and those
/// within each moving instance.
/// @param still  find_plane_mirrors() of the static instances. The water's is added while this runs.
[[nodiscard]] std::vector<Corner> find_corners(const Scene& scene, std::vector<PlaneMirror>& still,
                                               const std::optional<WaterMirror>& water, Workers& workers);

}  // namespace insonify
