// bench_paper_scene.h -- the workload of the paper's timings: a cylinder, a box, a sphere and a cone.

#pragma once

#include <cstdint>

#include "insonify/scene.h"
#include "insonify/sonar_config.h"

namespace insonify {

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
