// primary_choice.h -- whether primary echoes are drawn or traced.

#pragma once

#include <cstddef>

#include "insonify/engine.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// What an engine does: kRays or kRaster. For kAuto a cost model of triangles, samples and the azimuth aperture picks
/// the faster one (bench/README.md), the same for a scenario on every machine.
/// @param can_draw   Whether the engine can draw primaries, see EngineKind; others always trace.
/// @param even_rows  Whether columns are wedges and their rows even in tan(elevation), as without an array: others
///                   cannot be drawn, and kAuto traces them.
[[nodiscard]] PrimaryEchoes primary_echoes(PrimaryEchoes asked, const SonarConfig& sonar, std::size_t triangle_count,
                                           bool can_draw, bool even_rows = true);

}  // namespace insonify
