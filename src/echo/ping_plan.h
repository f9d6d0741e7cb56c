// ping_plan.h -- everything about one sonar that does not change from ping to ping, as the engines need it.

#pragma once

#include <algorithm>
#include <cmath>

#include "echo/paper_shape.h"
#include "echo/scatter_table.h"
#include "insonify/engine.h"
#include "sonar/lattice.h"

namespace insonify {

class PingPlan {
 public:
  explicit PingPlan(const PingPlanSettings& settings);

  SonarConfig sonar;
  Lattice lattice;
  EchoModel model;
  PaperShape shape;      ///< `paper`
  ScatterTable scatter;  ///< `calibrated`
  PrimaryEchoes primary;
  SecondaryEchoes secondary;  ///< kNone where paths end at one surface.
  int max_surfaces;

  float neper_per_metre = 0;   ///< Absorption of pressure amplitude [Np/m].
  float range_per_metre = 1;   ///< Reported range over true range: assumed over true sound speed.
  float true_max_range = 0;    ///< True distance of the far edge of the last bin [m].
  float bins_per_metre = 0;    ///< Bins over true distance [1/m].
  float first_bin_at = 0;      ///< True distance of the near edge of bin 0 [m].
  float middle_elevation = 0;  ///< Of the aperture [rad].
  double turns_per_metre = 0;  ///< Of the phase of an echo, over one-way distance [1/m].
  std::uint64_t seed = 0;
  std::uint32_t stagger = 0;  ///< Turns the selection of secondary rays, from the seed.

  /// Whether sound from a direction of the sonar frame is heard at all: in the fan and the elevation aperture.
  [[nodiscard]] bool in_aperture(const Vec3f& direction) const;

  /// Beam whose edges hold an azimuth; -1 outside the fan.
  [[nodiscard]] int beam_of(float azimuth) const;

  /// Bin that holds a true range [m]; -1 outside the window.
  [[nodiscard]] int bin_of(float range) const;

 private:
  std::vector<float> beam_edges_;     // Falling [rad].
  float beams_per_radian_ = 0;        // On average.
  float tan_low_ = 0, tan_high_ = 0;  // Of the elevation aperture's edges.
};

inline bool PingPlan::in_aperture(const Vec3f& direction) const {
  const float level = std::sqrt(direction.x() * direction.x() + direction.y() * direction.y());
  return direction.z() >= tan_low_ * level && direction.z() <= tan_high_ * level &&
         beam_of(std::atan2(direction.y(), direction.x())) >= 0;
}

inline int PingPlan::bin_of(float range) const {
  const float position = (range - first_bin_at) * bins_per_metre;
  return position >= 0 && position < static_cast<float>(sonar.bin_count) ? static_cast<int>(position) : -1;
}

inline int PingPlan::beam_of(float azimuth) const {
  // Where beams are even this guess is right but for rounding at the edges; elsewhere it is where the search begins.
  const float across = (beam_edges_.front() - azimuth) * beams_per_radian_;
  int beam = std::clamp(static_cast<int>(across), 0, sonar.beam_count - 1);
  while (beam > 0 && azimuth > beam_edges_[beam]) {
    --beam;
  }
  while (beam + 1 < sonar.beam_count && azimuth <= beam_edges_[beam + 1]) {
    ++beam;
  }
  return azimuth <= beam_edges_[beam] && azimuth > beam_edges_[beam + 1] ? beam : -1;
}

}  // namespace insonify
