// ping_plan.h -- constants of one sonar for the engines, the same for all pings.

#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "echo/laws/laws.h"
#include "echo/model/paper_shape.h"
#include "echo/model/scatter_table.h"
#include "insonify/array_pattern.h"
#include "insonify/engine.h"
#include "insonify/ground_truth.h"
#include "insonify/material.h"
#include "insonify/paper_model.h"
#include "insonify/sonar_config.h"
#include "insonify/water.h"
#include "sonar/elevation_pattern.h"
#include "sonar/fan_pattern.h"
#include "sonar/lattice.h"

namespace insonify {

/// What a PingPlan is made from.
struct PingPlanSettings {
  SonarConfig sonar = {};
  Water water = {};
  EchoModel model = EchoModel::kPaper;
  PaperModel paper = {};
  std::span<const Material> materials = {};  ///< The scene's, for the calibrated model; read only while planning.

  // For the calibrated model. Primaries can be rasterised only with these defaults.
  BeamShape beam_shape = BeamShape::kWedge;
  /// One-way pattern in elevation of transmitter and receiver; its half-power width is the elevation aperture. Absent:
  /// a top hat.
  std::optional<ArraySettings> elevation_array = {};
  /// Intensity gain of a scanning head's array, one way, at the centre of each cell; empty for other sonars.
  std::vector<float> head_gains = {};

  PrimaryEchoes primary = PrimaryEchoes::kAuto;
  SecondaryEchoes secondary = SecondaryEchoes::kSelective;
  int max_surfaces = kPathOrders;  ///< Most surfaces on a path, 1..3; at most two in the paper model.
  bool rough_mirrors = false;      ///< Whether mirrors reflect by facets alone; calibrated model only.
  std::uint64_t seed = 1;
  int stagger_phase = 0;  ///< Offset of the samples, >= 0: what changes with it is sampling error.
};

/// Everything about one sonar that does not change from ping to ping, computed once.
class PingPlan {
 public:
  explicit PingPlan(const PingPlanSettings& settings);

  SonarConfig sonar;
  std::optional<ElevationPattern> elevation_pattern;  ///< Absent: a top hat over the aperture.
  FanPattern transmitter;                             ///< Gain of a fan's transmitter across bearings.
  Lattice lattice;
  EchoModel model;
  PaperShape shape;      ///< `paper`
  ScatterTable scatter;  ///< `calibrated`
  PrimaryEchoes primary;
  SecondaryEchoes secondary;  ///< kNone if max_surfaces is 1.
  int max_surfaces;
  bool rough_mirrors;  ///< `calibrated`: mirrors have no coherent reflection.

  /// In the water [m].
  [[nodiscard]] float wavelength() const { return static_cast<float>(2 / turns_per_metre); }

  /// Whether any surface lets sound through: see see_through.h.
  [[nodiscard]] bool sees_through() const { return model == EchoModel::kCalibrated && scatter.any_passing(); }

  /// Whether facets reflect any rays: see facet_slope().
  [[nodiscard]] bool has_facets() const {
    return model == EchoModel::kCalibrated && (rough_mirrors || scatter.any_rough());
  }

  /// The argument of facet_slope() for a surface.
  [[nodiscard]] float mirror_roughness(SurfaceLabel surface) const {
    return rough_mirrors ? kAllRough : scatter.roughness(surface);
  }

  float neper_per_metre = 0;   ///< Absorption of pressure amplitude [Np/m].
  float range_per_metre = 1;   ///< Reported range / true range = assumed sound speed / true sound speed.
  float true_max_range = 0;    ///< True distance of the far edge of the last bin [m].
  float bins_per_metre = 0;    ///< Bins per true distance [1/m].
  float first_bin_at = 0;      ///< True distance of the near edge of bin 0 [m].
  float middle_elevation = 0;  ///< Middle of the elevation aperture [rad].
  double turns_per_metre = 0;  ///< Full turns of an echo's phase per metre of range [1/m].
  std::uint64_t seed = 0;
  std::uint32_t stagger = 0;  ///< Random offset of the selection of reflected rays and of facets, from the seed.

  /// Greatest range of a secondary echo whose footprint still overlaps the last bin: true distance [m].
  [[nodiscard]] float reach() const { return (1 + 0.5F * kWidestFootprint) * true_max_range; }

  /// Whether sound from a direction is received at all: inside the fan, and inside the elevation aperture or the limits
  /// of the elevation pattern.
  /// @param direction  Unit vector in the sonar frame.
  [[nodiscard]] bool receives(const Vec3f& direction) const;

  /// Whether a sphere lies above or below the fan. Never if a part of it is received. Frame of the sonar [m].
  [[nodiscard]] bool receives_nothing_of(const Vec3f& middle, float radius) const;

  /// How sound from a direction arrives.
  struct Arrival {
    float bearing, elevation;  ///< [rad]
    float pattern;             ///< |p|^2 of the elevation pattern, one way; 1 without one.
    float transmitted;         ///< Intensity gain of the transmitter across bearings; 1 without a transmit_width.

    /// Intensity gain of sound that leaves and arrives in this direction.
    [[nodiscard]] double both_ways() const { return double{pattern} * double{pattern} * double{transmitted}; }
  };
  /// @param direction  Unit vector in the sonar frame.
  [[nodiscard]] Arrival arrival_from(const Vec3f& direction) const;

  /// Gain of what is sent where an arrival comes from, re that of what is sent to a column: a path by a mirror leaves
  /// towards the one and arrives from the other.
  [[nodiscard]] float sent_beside(int column, const Arrival& arrival) const;

  /// Factor on an echo that leaves towards one direction and arrives from another, besides its gain of reception. A
  /// scanning head receives all with the gain of its array both ways, as if it had left where it arrives from.
  [[nodiscard]] double sent_gain(const Arrival& leaves, const Arrival& arrives) const;

  /// The same of an echo that leaves towards a column, re the gain of that.
  [[nodiscard]] float received_beside(int column, const Arrival& arrives) const {
    return is_head() ? 1 / sent_beside(column, arrives) : 1;
  }

  /// Beam that contains a bearing [rad]; -1 outside the fan.
  [[nodiscard]] int beam_of(float bearing) const;

  /// Bearing of the port edge of a beam; of the beam after the last one: the starboard edge of the fan [rad].
  [[nodiscard]] float beam_edge(int beam) const { return beam_edges_[beam]; }

  /// Bin that contains a true range [m]; -1 outside the window.
  [[nodiscard]] int bin_of(float range) const;

 private:
  [[nodiscard]] bool is_head() const { return sonar.type == SonarType::kMechanicallyScanned; }
  [[nodiscard]] float sent_to(const Arrival& arrival) const;

  // Azimuth [rad]; on a cone the angle from the array's broadside.
  [[nodiscard]] float bearing_of(const Vec3f& direction) const;

  std::vector<float> beam_edges_;     // In descending order [rad].
  float beams_per_radian_ = 0;        // On average.
  float tan_low_ = 0, tan_high_ = 0;  // Tangents of the lowest and highest elevation that are received.
};

[[nodiscard]] std::shared_ptr<const PingPlan> make_ping_plan(const PingPlanSettings& settings);

inline float PingPlan::bearing_of(const Vec3f& direction) const {
  return lattice.shape == BeamShape::kWedge ? std::atan2(direction.y(), direction.x())
                                            : std::asin(std::clamp(direction.y(), -1.0F, 1.0F));
}

inline bool PingPlan::receives(const Vec3f& direction) const {
  const float level = std::sqrt(direction.x() * direction.x() + direction.y() * direction.y());
  // A line array cannot tell front from back: on a cone what is behind has the bearing of a direction in front.
  const bool behind = lattice.shape == BeamShape::kCone && direction.x() < 0;
  return direction.z() >= tan_low_ * level && direction.z() <= tan_high_ * level && !behind &&
         beam_of(bearing_of(direction)) >= 0;
}

inline bool PingPlan::receives_nothing_of(const Vec3f& middle, float radius) const {
  const float level = std::sqrt(middle.x() * middle.x() + middle.y() * middle.y());
  return middle.z() - tan_high_ * level > radius * std::sqrt(1 + tan_high_ * tan_high_) ||
         tan_low_ * level - middle.z() > radius * std::sqrt(1 + tan_low_ * tan_low_);
}

inline PingPlan::Arrival PingPlan::arrival_from(const Vec3f& direction) const {
  const float elevation = std::atan2(direction.z(), std::hypot(direction.x(), direction.y()));
  const float pattern =
      elevation_pattern ? static_cast<float>(elevation_pattern->intensity(static_cast<double>(elevation))) : 1.0F;
  const float bearing = bearing_of(direction);
  const float transmitted =
      transmitter.is_flat() ? 1.0F : static_cast<float>(transmitter.intensity(std::sin(double{bearing})));
  return {bearing, elevation, pattern, transmitted};
}

inline int PingPlan::bin_of(float range) const {
  const float position = (range - first_bin_at) * bins_per_metre;
  return position >= 0 && position < static_cast<float>(sonar.bin_count) ? static_cast<int>(position) : -1;
}

inline int PingPlan::beam_of(float bearing) const {
  // First guess, exact but for rounding if all beams are equally wide; then a search.
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
