// edge_echoes.h -- echoes of straight edges that are seen broadside.

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/targets/sight_rays.h"
#include "echo/targets/straight_edges.h"

namespace insonify {

/// The echo of an edge: its amplitude and its phase beyond that of the way there and back.
struct EdgeEcho {
  double amplitude;  ///< Pressure relative to that of the source at 1 m, of either sign, over WedgeFace's S.
  double turns;      ///< [full turns]
};

/// Integral of e^(2ikr)/r^2 along an edge, less the phase of the way to its nearest point, in Fresnel's approximation.
/// @param foot        Foot of the perpendicular from the sonar, from the edge's middle [m].
/// @param half        Half the edge's length [m].
/// @param distance    From the sonar to the edge's line [m], > 0.
/// @param wavelength  [m]
[[nodiscard]] EdgeEcho edge_integral(double foot, double half, double distance, double wavelength);

/// Adds the echoes of StraightEdges that are seen broadside to a grid of the calibrated model as discrete echoes:
/// wedge_backscatter() times edge_integral(), with |R| of each face at its angle, e^-g of their roughness, absorption,
/// and the elevation pattern both ways (docs/concepts/scattering.md, "Edges"). Edges whose nearest point is hidden give
/// none.
class EdgeEchoes {
 public:
  static constexpr std::size_t kMostTogether = 4096;  ///< Most edges of one ping that may be seen: the first found.
  static constexpr std::size_t kMostEchoes = 1024;    ///< Most echoes of one ping: the strongest.

  explicit EdgeEchoes(std::shared_ptr<const StraightEdges> edges = {});

  /// Allocates nothing.
  /// @param world_from_mesh  [instance]
  /// @param shown            [face] FaceGlints::shown() of this ping: their glints contain what their edges add to
  /// them.
  void add(const PingPlan& plan, const Pose& world_from_sonar, std::span<const Pose> world_from_mesh,
           std::span<const std::uint8_t> shown, Engine& engine, EchoGrid& grid);

 private:
  // An edge that is seen broadside, unless something hides it.
  struct View {
    double range;
    double intensity;
    double turns;
    PingPlan::Arrival arrival;
  };

  void find(const PingPlan& plan, const Pose& world_from_sonar, const Pose& world_from_group,
            const StraightEdges::Group& group, std::span<const std::uint8_t> shown);

  std::shared_ptr<const StraightEdges> edges_;
  std::vector<View> views_;
  std::vector<Ray> rays_;  // [view]
  std::vector<Hit> hits_;
  SightRays sight_rays_;
  std::vector<std::uint8_t> near_;  // [edge of a group] Whether it is seen broadside.
};

}  // namespace insonify
