// edge_echoes.h -- diffraction echoes of straight edges at broadside.

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/batch/echo_source.h"
#include "echo/targets/straight_edges.h"

namespace insonify {

/// Amplitude and phase of an edge's echo. The phase excludes that of the two-way path to the nearest point.
struct EdgeEcho {
  double amplitude;  ///< Pressure re the source's at 1 m, divided by S of wedge_backscatter(); of either sign.
  double turns;      ///< [full turns]
};

/// Integral of e^(2ikr)/r^2 along an edge in Fresnel's approximation, without the phase of the path to its nearest
/// point.
/// @param foot        Coordinate along the edge of the foot of the perpendicular from the sonar, from the middle [m].
/// @param half        Half the edge's length [m].
/// @param distance    From the sonar to the edge's line [m], > 0.
/// @param wavelength  [m]
[[nodiscard]] EdgeEcho edge_integral(double foot, double half, double distance, double wavelength);

/// Echoes of StraightEdges at broadside, as discrete echoes: wedge_backscatter() times
/// edge_integral(), with |R| of each face at its angle of incidence, e^-g of their roughness, absorption, and the
/// two-way elevation pattern (docs/concepts/scattering.md, "Edges"). Calibrated model only. An edge whose nearest point
/// is hidden gives no echo.
class EdgeEchoes final : public EchoSource {
 public:
  static constexpr std::size_t kMostTogether = 4096;  ///< Most edges per ping at broadside; later ones are dropped.
  static constexpr std::size_t kMostEchoes = 1024;    ///< Most echoes per ping; the strongest are used.

  /// @param glints  Source of the same ping, before this one. The glint of a face includes diffraction at its edges, so
  ///                their terms are left out here. Null: there are no glints.
  EdgeEchoes(std::shared_ptr<const StraightEdges> edges, const FaceGlints* glints);

  void ask(const PingView& view, Workers& workers, RayList& rays) override;
  void answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList& more, EchoList& found) override;

 private:
  // An edge at broadside; its line of sight may be blocked.
  struct Broadside {
    double range;
    double intensity;
    double turns;
    FlatPlan::Arrival arrival;
  };

  void find_all(const PingView& view, RayList& rays);
  void find(const FlatPlan& plan, const Pose& world_from_sonar, const Pose& world_from_group,
            const StraightEdges::Group& group, RayList& rays);

  std::shared_ptr<const StraightEdges> edges_;
  const FaceGlints* glints_;
  bool asked_ = false;                // Whether this ping's rays have been asked for.
  std::vector<Broadside> broadside_;  // [sight]
  std::vector<std::uint8_t> near_;    // [edge of a group] 1 at broadside.
};

}  // namespace insonify
