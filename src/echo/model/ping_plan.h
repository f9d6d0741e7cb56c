// ping_plan.h -- everything about one sonar that does not change from ping to ping, as the engines need it.

#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "echo/model/paper_shape.h"
#include "echo/model/path_footprint.h"
#include "echo/model/scatter_table.h"
#include "insonify/array_pattern.h"
#include "insonify/engine.h"
#include "insonify/ground_truth.h"
#include "insonify/material.h"
#include "insonify/paper_model.h"
#include "insonify/sonar_config.h"
#include "insonify/water.h"
#include "sonar/elevation_pattern.h"
#include "sonar/lattice.h"

namespace insonify {

/// What a plan is made from.
struct PingPlanSettings {
  SonarConfig sonar = {};
  Water water = {};
  EchoModel model = EchoModel::kPaper;
  PaperModel paper = {};
  std::span<const Material> materials = {};  ///< The scene's, for the calibrated model; read only while planning.

  // Of the calibrated model; others than these are not for kRaster.
  BeamShape beam_shape = BeamShape::kWedge;
  std::optional<ArraySettings> elevation_array = {};  ///< One way, as wide at half power as the elevation aperture;
                                                      ///< sends and hears. A top hat when absent.

  PrimaryEchoes primary = PrimaryEchoes::kAuto;
  SecondaryEchoes secondary = SecondaryEchoes::kSelective;
  int max_surfaces = kPathOrders;  ///< Of a path, 1..3; the paper model knows two.
  bool rough_mirrors = false;      ///< Send sound on about facets drawn from their slopes; calibrated model only.
  std::uint64_t seed = 1;
  int stagger_phase = 0;  ///< >= 0. Others put the samples elsewhere: what changes with it is the sampling's own.
};
/// Everything about one sonar that does not change from ping to ping, worked out once.
class PingPlan {
 public:
  explicit PingPlan(const PingPlanSettings& settings);

  SonarConfig sonar;
  std::optional<ElevationPattern> elevation_pattern;  ///< None: a top hat over the aperture.
  Lattice lattice;
  EchoModel model;
  PaperShape shape;      ///< `paper`
  ScatterTable scatter;  ///< `calibrated`
  PrimaryEchoes primary;
  SecondaryEchoes secondary;  ///< kNone where paths end at one surface.
  int max_surfaces;
  bool rough_mirrors;  ///< `calibrated`

  float neper_per_metre = 0;   ///< Absorption of pressure amplitude [Np/m].
  float range_per_metre = 1;   ///< Reported range over true range: assumed over true sound speed.
  float true_max_range = 0;    ///< True distance of the far edge of the last bin [m].
  float bins_per_metre = 0;    ///< Bins over true distance [1/m].
  float first_bin_at = 0;      ///< True distance of the near edge of bin 0 [m].
  float middle_elevation = 0;  ///< Of the aperture [rad].
  double turns_per_metre = 0;  ///< Of the phase of an echo, over one-way distance [1/m].
  std::uint64_t seed = 0;
  std::uint32_t stagger = 0;  ///< Turns the selection of secondary rays and the facets of rough mirrors, from the seed.

  /// How far the middle of an echo by way of a mirror may lie, of which the last bin still hears the near end: true
  /// distance [m].
  [[nodiscard]] float reach() const { return (1 + 0.5F * kWidestFootprint) * true_max_range; }

  /// Whether sound from a direction of the sonar frame, of unit length, is heard at all: in the fan and the elevation
  /// aperture, or all that the elevation pattern hears.
  [[nodiscard]] bool receives(const Vec3f& direction) const;

  /// How sound from a direction of the sonar frame, of unit length, arrives.
  struct Arrival {
    float bearing, elevation;  ///< [rad]
    float pattern;             ///< |p|^2 of the elevation pattern, one way; 1 without one.
  };
  [[nodiscard]] Arrival arrival_from(const Vec3f& direction) const;

  /// Beam whose edges hold a bearing; -1 outside the fan.
  [[nodiscard]] int beam_of(float bearing) const;

  /// Bin that holds a true range [m]; -1 outside the window.
  [[nodiscard]] int bin_of(float range) const;

 private:
  // Azimuth, or the angle off the array's broadside.
  [[nodiscard]] float bearing_of(const Vec3f& direction) const;

  std::vector<float> beam_edges_;     // Falling [rad].
  float beams_per_radian_ = 0;        // On average.
  float tan_low_ = 0, tan_high_ = 0;  // Of the edges of the elevations that are heard.
};

[[nodiscard]] std::shared_ptr<const PingPlan> make_ping_plan(const PingPlanSettings& settings);

inline float PingPlan::bearing_of(const Vec3f& direction) const {
  return lattice.shape == BeamShape::kWedge ? std::atan2(direction.y(), direction.x())
                                            : std::asin(std::clamp(direction.y(), -1.0F, 1.0F));
}

inline bool PingPlan::receives(const Vec3f& direction) const {
  const float level = std::sqrt(direction.x() * direction.x() + direction.y() * direction.y());
  const bool behind = lattice.shape == BeamShape::kCone && direction.x() < 0;  // At the bearing of what is before it.
  return direction.z() >= tan_low_ * level && direction.z() <= tan_high_ * level && !behind &&
         beam_of(bearing_of(direction)) >= 0;
}

inline PingPlan::Arrival PingPlan::arrival_from(const Vec3f& direction) const {
  const float elevation = std::atan2(direction.z(), std::hypot(direction.x(), direction.y()));
  const float pattern =
      elevation_pattern ? static_cast<float>(elevation_pattern->intensity(static_cast<double>(elevation))) : 1.0F;
  return {bearing_of(direction), elevation, pattern};
}

inline int PingPlan::bin_of(float range) const {
  const float position = (range - first_bin_at) * bins_per_metre;
  return position >= 0 && position < static_cast<float>(sonar.bin_count) ? static_cast<int>(position) : -1;
}

inline int PingPlan::beam_of(float bearing) const {
  // Where beams are even this guess is right but for rounding at the edges; elsewhere it is where the search begins.
  const float across = (beam_edges_.front() - bearing) * beams_per_radian_;
  int beam = std::clamp(static_cast<int>(across), 0, sonar.beam_count - 1);
  while (beam > 0 && bearing > beam_edges_[beam]) {
    --beam;
  }
  while (beam + 1 < sonar.beam_count && bearing <= beam_edges_[beam + 1]) {
    ++beam;
  }
  return bearing <= beam_edges_[beam] && bearing > beam_edges_[beam + 1] ? beam : -1;
}

}  // namespace insonify
