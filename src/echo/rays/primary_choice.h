// primary_choice.h -- whether primary echoes are rasterised or ray-traced.

#pragma once

#include <cstddef>

#include "insonify/engine.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Returns kRays or kRaster. For kAuto a cost model of triangles, samples and the azimuth aperture picks the faster
/// method (bench/README.md); the choice does not depend on the machine.
/// @param can_draw   Whether the engine can rasterise, see EngineKind; if not, kRays.
/// @param even_rows  Whether columns are wedges with rows at equal steps of tan(elevation), see Lattice: only these can
/// be
///                   rasterised, and kAuto traces all others.
/// @param azimuth_aperture  Full width of the fan [rad].
/// @param samples           Of the lattice.
[[nodiscard]] PrimaryEchoes primary_echoes(PrimaryEchoes asked, double azimuth_aperture, double samples,
                                           std::size_t triangle_count, bool can_draw, bool even_rows = true);

/// The same of a sonar whose beams are sampled.
[[nodiscard]] inline PrimaryEchoes primary_echoes(PrimaryEchoes asked, const SonarConfig& sonar,
                                                  std::size_t triangle_count, bool can_draw, bool even_rows = true) {
  const double samples = 1.0 * sonar.beam_count * sonar.sampling.columns_per_beam.value_or(Sampling::kColumns) *
                         sonar.sampling.rows.value_or(Sampling::kRows);
  return primary_echoes(asked, sonar.azimuth_aperture, samples, triangle_count, can_draw, even_rows);
}

}  // namespace insonify
