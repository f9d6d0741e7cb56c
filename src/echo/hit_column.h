// hit_column.h -- what the rays of one lattice column met, and what follows from it sample by sample.

#pragma once

#include <vector>

#include "echo/echo.h"
#include "echo/ping_plan.h"

namespace insonify {

/// One lattice column, row by row from the lower edge of the aperture up. An engine fills in the first group; a sample
/// without a hit has kNoSurface, range 0, reflectivity 0 and any normal. evaluate_column() works out the second.
struct HitColumn {
  explicit HitColumn(int rows = 0) { resize(rows); }

  /// Every row may be written up to kPadding values beyond its end; what is written there is never read.
  void resize(int rows);
  static constexpr int kPadding = 4;

  // From the engine.
  std::vector<SurfaceLabel> surface;
  std::vector<float> range;                         ///< True distance [m].
  std::vector<float> normal_x, normal_y, normal_z;  ///< Of any length, in the frame of the ColumnAxes.
  std::vector<float> reflectivity;                  ///< Of the surface's material.

  // Worked out.
  std::vector<float> facing;    ///< Of ray and unit normal: the cosine of incidence, of either sign.
  std::vector<float> strength;  ///< `paper`: |facing| x reflectivity x absorption there and back, 0..1.
  std::vector<float> power;     ///< What is deposited per unit of weight. `paper`: S(strength).
  std::vector<float> selected;  ///< How many hits the onward ray stands for; 0 when none is sent or nothing was hit.
};

/// How the samples of a column hang together: what lies between each and the next.
struct Stretches {
  explicit Stretches(int rows = 0) { resize(rows); }
  void resize(int rows);

  // Of each sample.
  std::vector<float> normal_along, normal_up;  ///< Of the unit normal, along the column's directions.
  std::vector<float> position;                 ///< In bins from the near edge of bin 0.
  std::vector<float> reach;  ///< By how much the position changes from the middle of the column to its edge.

  // From each sample to the next, where both lie on one unbroken surface; see SurfaceRun::add_stretch().
  std::vector<std::uint8_t> joined;  ///< Whether they do.
  std::vector<float> low, high;      ///< Ends, reach included [bins].
  std::vector<float> power_low;      ///< Power at the lower end.
  std::vector<float> rise;           ///< Change of power per bin.
  std::vector<float> density;        ///< Weight per bin [sr].
};

/// A column's directions, in the frame the normals are given in: `along` is (cos az, sin az, 0) of the sonar frame,
/// `across` (-sin az, cos az, 0), `up` its z axis.
struct ColumnAxes {
  Vec3f along, across, up;
};

/// Works out everything above for column `column` of the lattice; normals are made unit length.
///
/// Strength: paper, sections "Rasterized reflections" and "Unified reflections"; e^(-2 gamma r) is the two-way loss of
/// a pressure amplitude (PHYSICS 1.4).
///
/// Selection: a hit whose secondary echo can be strong is always followed, a weaker one with a probability in
/// proportion, and then counts for all of its kind, so that the sums of energy and weight stay unbiased. The lots are
/// drawn from a low-discrepancy lattice (Roberts' R2 sequence) turned by the seed, so that they lie evenly over a
/// surface and a still scene gives the same ping twice.
void evaluate_column(const PingPlan& plan, int column, const ColumnAxes& axes, HitColumn& hits,
                     Stretches& stretches);

}  // namespace insonify
