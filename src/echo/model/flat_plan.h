// flat_plan.h -- constants of one sonar for the engines, the same for all pings: plain numbers and tables.

#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <vector>

#include "echo/laws/laws.h"
#include "echo/model/paper_shape.h"
#include "echo/model/scatter_table.h"
#include "insonify/array_pattern.h"
#include "insonify/bearing_grid.h"
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

/// What a FlatPlan is made from.
struct FlatPlanSettings {
  SonarConfig sonar = {};
  BearingGrid cells = {};    ///< Slices of bearing that are sampled; none: the sonar's beams, of shape beam_shape.
  int columns_per_cell = 0;  ///< Lattice columns in each of `cells`.
  Water water = {};
  EchoModel model = EchoModel::kPaper;
  PaperModel paper = {};
  std::span<const Material> materials = {};  ///< The scene's, for the calibrated model; read only while planning.

  // For the calibrated model. Primaries can be rasterised only with these defaults.
  BeamShape beam_shape = BeamShape::kWedge;
  /// One-way pattern in elevation of the receiver; its half-power width is the elevation aperture. Absent: a top hat.
  std::optional<ArraySettings> elevation_array = {};
  std::optional<ElevationWay> sent_across = {};  ///< Transmitter across elevations; absent: as the receiver.
  /// Intensity gain, one way, at the centre of each cell of an array across bearings that transmits too; else empty.
  std::vector<float> array_gains = {};

  PrimaryEchoes primary = PrimaryEchoes::kAuto;
  SecondaryEchoes secondary = SecondaryEchoes::kSelective;
  int max_surfaces = kPathOrders;  ///< Most surfaces on a path, 1..3; at most two in the paper model.
  bool rough_mirrors = false;      ///< Whether mirrors reflect by facets alone; calibrated model only.
  std::uint64_t seed = 1;
  int stagger_phase = 0;  ///< Offset of the samples, >= 0: what changes with it is sampling error.
};

/// The numbers of a FlatPlan.
struct PlanNumbers {
  int beam_count = 0, bin_count = 0;                    ///< Size of the EchoGrid: slices of bearing x range bins.
  double frequency = 0;                                 ///< [Hz]
  double source_level_db = 0;                           ///< [dB re 1 uPa at 1 m]
  double elevation_center = 0, elevation_aperture = 0;  ///< [rad]
  double azimuth_aperture = 0;                          ///< For the choice of the primaries' method [rad].
  bool two_way = false;  ///< Whether the array across bearings transmits too: Lattice::transmitted is its gain.

  EchoModel model = EchoModel::kPaper;
  PaperShape shape{PaperModel()};  ///< `paper`
  bool sends_apart = false;        ///< Whether the transmitter's pattern across elevations differs from the receiver's.
  FanPattern transmitter{std::nullopt};  ///< Gain across bearings, where the array does not transmit.
  PrimaryEchoes primary = PrimaryEchoes::kAuto;
  SecondaryEchoes secondary = SecondaryEchoes::kSelective;  ///< kNone if max_surfaces is 1.
  int max_surfaces = kPathOrders;
  bool rough_mirrors = false;  ///< `calibrated`: mirrors have no coherent reflection.

  float neper_per_metre = 0;   ///< Absorption of pressure amplitude [Np/m].
  float range_per_metre = 1;   ///< Reported range / true range = assumed sound speed / true sound speed.
  float true_max_range = 0;    ///< True distance of the far edge of the last bin [m].
  float bins_per_metre = 0;    ///< Bins per true distance [1/m].
  float first_bin_at = 0;      ///< True distance of the near edge of bin 0 [m].
  float middle_elevation = 0;  ///< Middle of the elevation aperture [rad].
  double turns_per_metre = 0;  ///< Full turns of an echo's phase per metre of range [1/m].
  std::uint64_t seed = 0;
  std::uint32_t stagger = 0;  ///< Random offset of the selection of reflected rays and of facets, from the seed.

  float beams_per_radian = 0;       ///< On average.
  float tan_low = 0, tan_high = 0;  ///< Tangents of the lowest and highest elevation that are sent to and received.
  PatternAxis sent_axis = {}, received_axis = {};  ///< Elevations of the tables of gain, one way each.
};
static_assert(std::is_trivially_copyable_v<PlanNumbers>);

/// Everything about one sonar that does not change from ping to ping, computed once: numbers and tables of numbers.
class FlatPlan : public PlanNumbers {
 public:
  FlatPlan() = default;  ///< Empty: for visit_parts() to fill in.
  explicit FlatPlan(const FlatPlanSettings& settings);

  Lattice lattice;
  ScatterTable scatter;  ///< `calibrated`

  // [beam] Edges of the slices, falling [rad].
  std::vector<float> port_edges, starboard_edges;

  // |p|^2 across elevations of transmitter and receiver, at sent_axis and received_axis; empty for a top hat.
  std::vector<float> sent_across, received_across;

  /// Calls numbers(struct) on each part of a plan that is plain numbers and table(name, vector) on each table. A plan
  /// is rebuilt from copies of these.
  template <typename Self, typename Numbers, typename Table>
  static void visit_parts(Self& self, const Numbers& numbers, const Table& table) {
    numbers(static_cast<std::conditional_t<std::is_const_v<Self>, const PlanNumbers&, PlanNumbers&>>(self));
    table("port_edges", self.port_edges);
    table("starboard_edges", self.starboard_edges);
    table("sent_across", self.sent_across);
    table("received_across", self.received_across);
    Lattice::visit_parts(self.lattice, numbers, table);
    ScatterTable::visit_parts(self.scatter, numbers, table);
  }

  /// In the water [m].
  [[nodiscard]] float wavelength() const { return static_cast<float>(2 / turns_per_metre); }

  /// Whether any surface lets sound through: see see_through.h.
  [[nodiscard]] bool sees_through() const { return model == EchoModel::kCalibrated && scatter.any_passing(); }

  /// Whether facets reflect any rays: see facet_slope().
  [[nodiscard]] bool has_facets() const {
    return model == EchoModel::kCalibrated && (rough_mirrors || scatter.has_rough());
  }

  /// The argument of facet_slope() for a surface.
  [[nodiscard]] float mirror_roughness(SurfaceLabel surface) const {
    return rough_mirrors ? kAllRough : scatter.roughness(surface);
  }

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
    float sent, received;      ///< |p|^2 across elevations of the transmitter and of the receiver; 1 without one.
    float transmitted;         ///< Intensity gain of the transmitter across bearings; 1 without a transmit_width.

    /// Intensity gain of sound that leaves and arrives in this direction.
    [[nodiscard]] double both_ways() const { return double{sent} * double{received} * double{transmitted}; }
  };
  /// @param direction  Unit vector in the sonar frame.
  [[nodiscard]] Arrival arrival_from(const Vec3f& direction) const;

  /// Power of an echo that leaves towards a sample of the lattice and arrives from `arrival`, with the receiver's gain
  /// there. Its weight is that of the sample, and a two-way array applies to it as if it had left where it arrives.
  [[nodiscard]] float arriving_power(int column, float power, const Arrival& arrival) const {
    return power * arrival.received * (two_way ? 1 / sent_beside(column, arrival) : 1.0F);
  }

  /// Power of the reciprocal path, which leaves towards `arrival` and arrives from the sample, with the same weight.
  [[nodiscard]] float reciprocal_power(int column, int row, float power, const Arrival& arrival) const {
    return power * arrival.sent * sent_beside(column, arrival) * lattice.reciprocals(column)[row];
  }

  /// Factor on an echo that leaves towards one direction and arrives from another, and whose intensity has the
  /// receiver's gain across elevations in both. A two-way array receives all with its gain both ways, as if it had left
  /// where it arrives from.
  [[nodiscard]] double sent_gain(const Arrival& leaves, const Arrival& arrives) const;

  /// Beam that contains a bearing [rad]; -1 outside the fan and in a gap between beams.
  [[nodiscard]] int beam_of(float bearing) const {
    const int beam = nearest_beam(bearing);
    return bearing <= port_edges[beam] && bearing > starboard_edges[beam] ? beam : -1;
  }

  /// The same, but outside of all beams one beside it.
  [[nodiscard]] int nearest_beam(float bearing) const;

  /// Bin that contains a true range [m]; -1 outside the window.
  [[nodiscard]] int bin_of(float range) const;

 private:
  void set_sonar(const SonarConfig& sonar, const Water& water);
  void set_bearings(const BearingGrid& cells, const FlatPlanSettings& settings);
  void set_elevations(const ElevationPatterns& patterns);
  [[nodiscard]] float sent_to(const Arrival& arrival) const;

  // Gain of what is sent across bearings where an arrival comes from, re that of what is sent to a column.
  [[nodiscard]] float sent_beside(int column, const Arrival& arrival) const;

  // Azimuth [rad]; on a cone the angle from the array's broadside.
  [[nodiscard]] float bearing_of(const Vec3f& direction) const;
};

[[nodiscard]] std::shared_ptr<const FlatPlan> make_flat_plan(const FlatPlanSettings& settings);

inline float FlatPlan::bearing_of(const Vec3f& direction) const {
  return lattice.shape == BeamShape::kWedge ? std::atan2(direction.y(), direction.x())
                                            : std::asin(std::clamp(direction.y(), -1.0F, 1.0F));
}

inline bool FlatPlan::receives(const Vec3f& direction) const {
  const float level = std::sqrt(direction.x() * direction.x() + direction.y() * direction.y());
  // A line array cannot tell front from back: on a cone what is behind has the bearing of a direction in front.
  const bool behind = lattice.shape == BeamShape::kCone && direction.x() < 0;
  return direction.z() >= tan_low * level && direction.z() <= tan_high * level && !behind &&
         beam_of(bearing_of(direction)) >= 0;
}

inline bool FlatPlan::receives_nothing_of(const Vec3f& middle, float radius) const {
  const float level = std::sqrt(middle.x() * middle.x() + middle.y() * middle.y());
  return middle.z() - tan_high * level > radius * std::sqrt(1 + tan_high * tan_high) ||
         tan_low * level - middle.z() > radius * std::sqrt(1 + tan_low * tan_low);
}

inline FlatPlan::Arrival FlatPlan::arrival_from(const Vec3f& direction) const {
  const float elevation = std::atan2(direction.z(), std::hypot(direction.x(), direction.y()));
  const auto gain = [&](const PatternAxis& axis, const std::vector<float>& table) {
    return table.empty() ? 1.0F : static_cast<float>(axis.look_up(table, double{elevation}));
  };
  const float bearing = bearing_of(direction);
  const float transmitted =
      transmitter.is_flat() ? 1.0F : static_cast<float>(transmitter.intensity(std::sin(double{bearing})));
  const float received = gain(received_axis, received_across);
  return {bearing, elevation, sends_apart ? gain(sent_axis, sent_across) : received, received, transmitted};
}

inline int FlatPlan::bin_of(float range) const {
  const float position = (range - first_bin_at) * bins_per_metre;
  return position >= 0 && position < static_cast<float>(bin_count) ? static_cast<int>(position) : -1;
}

inline int FlatPlan::nearest_beam(float bearing) const {
  // First guess, exact but for rounding if all beams are equally wide; then a search.
  const float across = (port_edges.front() - bearing) * beams_per_radian;
  int beam = std::clamp(static_cast<int>(across), 0, beam_count - 1);
  while (beam > 0 && bearing > port_edges[beam]) {
    --beam;
  }
  while (beam + 1 < beam_count && bearing <= port_edges[beam + 1]) {
    ++beam;
  }
  return beam;
}

/// precise::coherent_share() of a surface; with rough_mirrors 0.
/// @param cosine  Cosine of the angle of incidence, of either sign.
inline double coherent_share(const FlatPlan& plan, SurfaceLabel surface, double cosine) {
  return plan.rough_mirrors ? 0 : precise::coherent_share(plan.scatter.scattering(surface).roughness, cosine);
}

/// Coherent reflectance |R|^2 e^-g.
/// @param cosine  Cosine of the angle of incidence, 0..1.
inline double coherent_reflectance(const FlatPlan& plan, SurfaceLabel surface, double cosine) {
  return plan.scatter.scattering(surface).reflectance(cosine) * coherent_share(plan, surface, cosine);
}

/// From which hits of a ping reflected rays are traced.
enum class SecondarySampling {
  kNone,
  kSome,  ///< From a sample of them, see select_hits().
  kAll
};

}  // namespace insonify
