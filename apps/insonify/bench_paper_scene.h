// bench_paper_scene.h -- the workload that the paper times: a cylinder, a box, a sphere and a cone.

#pragma once

#include <cstdint>

#include "insonify/scene.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// The four shapes at places drawn by lot in the cube of 20 m before the sonar, the same for a number on every machine.
/// Materials are assigned.
[[nodiscard]] Scene make_random_scene(std::uint64_t number);

/// The same shapes on a floor before a wall, for a sonar that looks down 10 degrees: they fill the fan.
[[nodiscard]] Scene make_filled_scene();

/// A sonar of the paper's tables. MSIS have one beam.
struct PaperSetup {
  int beams, bins;
  double azimuth_deg, elevation_deg;
  double printed_2017_ms, printed_ms;  ///< Of Cerqueira et al. (2017) and of the paper, as the paper prints them.

  [[nodiscard]] bool scanning() const { return beams == 1; }
};

/// The eight FLS and four MSIS of its tables, range 20 m.
[[nodiscard]] std::span<const PaperSetup> paper_setups();

/// @param pitch_deg  How far it looks down.
[[nodiscard]] SonarConfig sonar_of(const PaperSetup& setup, double pitch_deg);

}  // namespace insonify
