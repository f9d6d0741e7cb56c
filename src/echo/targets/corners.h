// corners.h -- finds the corners of three perpendicular mirrors in a scene, and computes how much they reflect back.

#pragma once

#include <array>
#include <optional>
#include <vector>

#include "echo/targets/plane_mirrors.h"

namespace insonify {

/// An inside corner of three perpendicular mirrors (a trihedral, as of a radar reflector or a tank): sound that all
/// three reflect goes back where it came from. Axes a, b and c point from the apex along the three edges; mirror k is
/// perpendicular to axis k and has the shape of its part between the other two.
struct Corner {
  static constexpr int kSteps = 64;               ///< Directions in each mirror.
  static constexpr std::size_t kMost = 1024;      ///< Most corners of a frame: the largest are taken.
  static constexpr double kPerpendicular = 2e-3;  ///< Most of the cosine between two of its mirrors.
  static constexpr double kLeastEdge = 5e-3;      ///< What is smaller is no corner [m].
  static constexpr double kGap = 2e-3;            ///< Gap between neighbouring triangles that does not count [m].
  static constexpr float kEndless = 1e5F;         ///< Extent of the water's surface [m].

  int instance = -1;  ///< The instance whose mesh frame this is; -1: the world.
  Vec3 apex = Vec3::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< Unit vectors a, b and c as columns.
  std::array<SurfaceLabel, 3> surfaces = {};           ///< Labels of the mirrors at the apex.

  /// [mirror][step] Sum of the coordinates along the mirror's two edges, k + 1 and k + 2 (cyclic), at which it first
  /// ends, in the direction in which edge k + 2 has the share step / kSteps of that sum [m].
  std::array<std::array<float, kSteps + 1>, 3> extents = {};

  bool from_behind = false;  ///< Whether all three mirrors are wound away from its inside: rarely seen.

  /// Distance from the line of sight at which sound is no longer reflected by all three mirrors [m].
  ///
  /// A path that all three reflect becomes a straight line where space is mirrored in them, which crosses each plane
  /// once. It exists where each crossing, mirrored back into the octant, lies on the mirror. So the outline is that of
  /// the three mirrors and their images, projected along the line of sight; it is symmetric about the apex (Spencer,
  /// "Optical theory of the corner reflector", MIT Radiation Laboratory report 433 (1944)).
  /// @param sight   From the apex to the sonar, along the axes; unit length, all components > 0.
  /// @param across  Unit vector perpendicular to it, along the axes.
  [[nodiscard]] double radius(const Vec3& sight, const Vec3& across) const;

  /// Intensity at the sonar relative to the source's at 1 m, by perfect mirrors and without absorption: Kirchhoff's
  /// integral over the outline, with its radius R by the angle phi,
  ///
  ///     1/(4 r^2) | 1 - mean over phi of e^(i k R^2 / r) |^2
  ///
  /// Far off it is A^2/(lambda^2 r^4) with the outline's area A (Knott, Shaeffer and Tuley, Radar Cross Section, ch.
  /// 6). Near the corner it comes to 1/(4 r^2), that of the sonar's image in the apex.
  /// @param range       r, to the apex [m], > 0.
  /// @param wavelength  [m]
  [[nodiscard]] double reflected(const Vec3& sight, double range, double wavelength) const;
};

/// The corners of a scene: those of the instances that do not move, with each other and with the water's surface, and
/// those of each moving instance by itself. Mirrors are PlaneMirrors.
/// @param still  find_plane_mirrors() of all that does not move.
[[nodiscard]] std::vector<Corner> find_corners(const Scene& scene, const std::vector<PlaneMirror>& still,
                                               const std::optional<WaterMirror>& water);

}  // namespace insonify
