// corner_echoes.h -- echoes of corners of three mirrors.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "echo/batch/echo_source.h"
#include "echo/targets/corners.h"

namespace insonify {

/// Echoes of corners of three mirrors, as discrete echoes at their apexes, of path order 3.
/// Calibrated model only. The intensity is Corner::reflected() times |R|^2 e^-g of each mirror at its angle of
/// incidence (g: Rayleigh parameter of its roughness), times absorption and the two-way elevation pattern. A corner
/// gives no echo if its apex is hidden or the sonar is outside its octant.
class CornerEchoes final : public EchoSource {
 public:
  explicit CornerEchoes(std::shared_ptr<const std::vector<Corner>> corners);

  /// Whether there are corners, and `secondary` and `max_surfaces` of the plan allow paths over three surfaces.
  [[nodiscard]] static bool act(const std::vector<Corner>& corners, const FlatPlan& plan);

  void ask(const PingView& view, Workers& workers, RayList& rays) override;
  void answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList& more, EchoList& found) override;

 private:
  // A corner whose octant holds the sonar; its line of sight may be blocked.
  struct Opening {
    const Corner* corner;
    Vec3 sight;  // Unit vector from the apex to the sonar, along the corner's axes.
    double range;
    FlatPlan::Arrival arrival;
  };

  std::shared_ptr<const std::vector<Corner>> corners_;
  std::vector<Opening> openings_;  // [sight]
};

}  // namespace insonify
