// bench_scene.h -- scenes and sonars of the benchmarks: a harbour of any size, and the workload of the paper's timings.

#pragma once

#include <cstdint>

#include "insonify/scene.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// A sea bed of 50 x 60 m (40 % of the triangles), a quay wall at 18 m (10 %) and 24 spheres, boxes, cylinders and
/// cones at 4 to 16 m (50 %); the bed 3 m below the origin, where the sonar is. Materials are assigned.
[[nodiscard]] Scene make_bench_scene(int triangle_count);

/// A rough bed of sand, 500 m square, between 0.5 m below and above the height 0.
[[nodiscard]] Scene make_rough_bed(int triangle_count);

/// 256 beams x 500 bins, 120 x 20 degrees, 20 m, pitched down 10 degrees.
[[nodiscard]] SonarConfig bench_sonar();

/// The four shapes at random positions in a cube of 20 m in front of the sonar; a number gives the same scene on every
/// machine. Materials are assigned.
[[nodiscard]] Scene make_random_scene(std::uint64_t number);

/// The same shapes on a floor in front of a wall, for a sonar that looks down 10 degrees: they fill the fan.
[[nodiscard]] Scene make_filled_scene();

/// A sonar of the paper's tables. An MSIS has one beam.
struct PaperSetup {
  int beams, bins;
  double azimuth_deg, elevation_deg;
  double printed_2017_ms, printed_ms;  ///< Times in Cerqueira et al. (2017) and in the paper, as printed.

  [[nodiscard]] bool scanning() const { return beams == 1; }
};

/// The eight FLS and four MSIS of the paper's tables, with a range of 20 m.
[[nodiscard]] std::span<const PaperSetup> paper_setups();

/// @param pitch_deg  Pitch of the sonar, positive down.
[[nodiscard]] SonarConfig sonar_of(const PaperSetup& setup, double pitch_deg);

}  // namespace insonify
