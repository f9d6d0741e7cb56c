// reference_column.h -- computes the echoes of one lattice column, ray by ray.

#pragma once

#include <optional>
#include <vector>

#include "base/parallel.h"
#include "echo/grid/echo.h"
#include "echo/model/deposit.h"
#include "echo/model/flat_plan.h"
#include "echo/model/left_out.h"
#include "echo/model/precise_echoes.h"
#include "echo/model/see_through.h"
#include "echo/reference/triangle_scene.h"
#include "insonify/engine.h"

namespace insonify {

/// ColumnAxes in double precision, in the world frame.
struct ColumnFrame {
  Vec3 along, across, up, beside;

  ColumnFrame(const Lattice& lattice, int column, const Pose& world_from_sonar);

  /// Direction of the ray of a row, unit length.
  [[nodiscard]] Vec3 direction(const Lattice& lattice, int column, int row) const;
};

/// Traces the rays of one column, and in a second step reflects them and deposits the echoes.
class ReferenceColumn {
 public:
  /// @param left_out  What of primary echoes is left out; null: nothing.
  ReferenceColumn(const TriangleScene& scene, const LeftOut* left_out, const FlatPlan& plan, SecondarySampling sampling,
                  int column, const Pose& world_from_sonar);

  /// Traces the primary rays. The normals of the hits are unit length.
  void trace_primary_rays(const Workers& workers);
  [[nodiscard]] HitColumn& hits() { return hits_; }

  /// Whether sound passes on from any hit, after insonify() or deposit_primary_echoes().
  [[nodiscard]] bool passes_on() const { return hits_.passing && any_passes_on(plan_, hits_); }

  /// Replaces the hits by those behind the surfaces that let sound through.
  void trace_behind(const Workers& workers);

  /// Adds the primary echoes of the hits to the grid, after NormalTurns::find().
  /// @param sampling  For the selection of hits that insonify() reflects.
  void deposit_primary_echoes(SecondarySampling sampling, EchoGrid& grid);

  /// Number of rays traced.
  [[nodiscard]] const RayCounts& counts() const { return counts_; }

  /// Adds the column's echoes to the grid, after NormalTurns::find().
  /// @param arrivals  Takes echoes that may arrive in beams of other columns.
  void insonify(EchoGrid& grid, std::vector<Echo>& arrivals, const Workers& workers);

 private:
  // A path from the sonar by way of a mirror, the first surface, to a second one.
  struct Reflection {
    int row = 0;                // Row of the hit on the mirror.
    float share = 1;            // See MirrorPath.
    Ray ray = {};               // The reflected ray.
    RayHit second = {};         // Its hit on the second surface.
    Vec3 point = Vec3::Zero();  // World position of that hit [m].
    Vec3 back = Vec3::Zero();   // Vector from there to the sonar [m].
    float there = 0;            // Length out and across [m].
    float path_length = 0;      // Length out, across and straight back [m].
    PathFootprint footprint = {};
    FaceEdges edges = {};  // `calibrated`: of the mirror.
  };

  [[nodiscard]] Ray ray_of(int column, int row) const;
  void store_hit(int row);
  [[nodiscard]] precise::LobeWidening widening(int row) const;
  void compute_powers();
  [[nodiscard]] MirrorChange change_along(int row) const;
  [[nodiscard]] MirrorChange change_across(int row) const;
  [[nodiscard]] std::optional<Reflection> reflect(int row);
  [[nodiscard]] bool return_leg_is_clear(const Reflection& path);
  void deposit_paper_echo(const Reflection& path, EchoGrid& grid);
  [[nodiscard]] precise::MirrorIntensities intensities(const Reflection& path) const;
  [[nodiscard]] double interference(const Reflection& path, const Vec3& smooth, const precise::FacetReturn& over) const;
  void deposit_echoes_by_water(const Reflection& path, EchoGrid& grid, std::vector<Echo>& arrivals);
  void deposit_mirror_echoes(const Reflection& path, EchoGrid& grid, std::vector<Echo>& arrivals);

  const TriangleScene& scene_;
  const LeftOut* left_out_;
  const FlatPlan& plan_;
  SecondarySampling sampling_;
  int column_, rows_;
  Pose world_from_sonar_;
  ColumnFrame frame_;
  std::vector<Ray> rays_;      // [row]
  std::vector<RayHit> first_;  // [row] First hit of each ray.
  HitStrip strip_;
  HitColumn hits_;  // The hits in single precision, for deposit_column() and select_hits().
  FootprintSegments segments_;
  RayCounts counts_;
};

}  // namespace insonify
