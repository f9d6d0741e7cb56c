// reference_column.h -- the echoes of one lattice column, worked out one ray at a time.

#pragma once

#include <optional>
#include <vector>

#include "echo/grid/echo.h"
#include "echo/model/deposit.h"
#include "echo/model/echo_laws.h"
#include "echo/model/path_footprint.h"
#include "echo/model/secondary_sampling.h"
#include "echo/reference/triangle_scene.h"
#include "insonify/engine.h"

namespace insonify {

/// ColumnAxes in double precision, in the world.
struct ColumnFrame {
  Vec3 along, across, up, beside;

  ColumnFrame(const Lattice& lattice, int column, const Pose& world_from_sonar);

  /// Unit vector of the ray in a row.
  [[nodiscard]] Vec3 direction(const Lattice& lattice, int column, int row) const;
};

class ReferenceColumn {
 public:
  ReferenceColumn(const TriangleScene& scene, const PingPlan& plan, SecondarySampling sampling, int column,
                  const Pose& world_from_sonar);

  /// Adds the column's echoes to the grid.
  /// @param arrivals  Takes echoes that may arrive in beams of other columns.
  /// @return          Rays it took.
  RayCounts insonify(EchoGrid& grid, std::vector<Echo>& arrivals);

 private:
  // A path from the sonar by way of a mirror, the first surface, to a second one.
  struct Reflection {
    int row = 0;                // Of the hit on the mirror.
    float share = 1;            // See MirrorPath.
    Ray ray = {};               // From the mirror on.
    RayHit second = {};         // What it meets,
    Vec3 point = Vec3::Zero();  // where,
    Vec3 back = Vec3::Zero();   // and the way from there to the sonar [m].
    float there = 0;            // Out and across [m].
    float path_length = 0;      // Out, across and straight back [m].
    PathFootprint footprint = {};
  };

  [[nodiscard]] Ray ray_of(int column, int row) const;
  void trace_primary_rays();
  void store_hit(int row);
  void compute_powers();
  void deposit_primary_echoes(EchoGrid& grid);
  [[nodiscard]] MirrorChange change_along(int row) const;
  [[nodiscard]] MirrorChange change_across(int row) const;
  [[nodiscard]] std::optional<Reflection> reflect(int row);
  [[nodiscard]] bool return_leg_is_clear(const Reflection& path);
  void deposit_paper_echo(const Reflection& path, EchoGrid& grid);
  [[nodiscard]] MirrorIntensities intensities(const Reflection& path) const;
  void deposit_mirror_echoes(const Reflection& path, EchoGrid& grid, std::vector<Echo>& arrivals);

  const TriangleScene& scene_;
  const PingPlan& plan_;
  SecondarySampling sampling_;
  int column_, rows_;
  Pose world_from_sonar_;
  ColumnFrame frame_;
  std::vector<Ray> rays_;      // Of each row.
  std::vector<RayHit> first_;  // What each meets first.
  HitStrip strip_;
  HitColumn hits_;  // The same in single precision, as the model's formulas take it.
  FootprintSegments segments_;
  RayCounts counts_;
};

}  // namespace insonify
