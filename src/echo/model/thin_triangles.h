// thin_triangles.h -- which triangles belong to parts that are too thin for the sampling lattice.

#pragma once

#include <vector>

#include "echo/model/hit_column.h"
#include "echo/model/ping_plan.h"

namespace insonify {

/// Thickness of the parts of a scene that are thin in two directions, as ropes, chains and nets are: the second
/// smallest extent of the body at a triangle. Where it is less than thin_per_metre() times the range, the primary echo
/// is that of ThinEchoes (echo/targets) instead of that of the samples.
struct ThinTriangles {
  /// [instance][triangle of its mesh], [m]; infinite where the body is not thin. Empty for an instance without any.
  std::vector<std::vector<float>> thickness;

  /// Of a triangle of any instance [m].
  [[nodiscard]] const float* of(SurfaceLabel surface) const {
    const std::uint16_t instance = instance_of(surface);
    return instance < thickness.size() && !thickness[instance].empty() ? thickness[instance].data() : nullptr;
  }
};

/// Thickness, per metre of range, below which a part is too thin for the lattice: four samples. Curved bodies of four
/// samples and more have steady echoes (docs/concepts/scattering.md, "Curved surfaces").
[[nodiscard]] float thin_per_metre(const PingPlan& plan);

/// Sets HitColumn::power to 0 at the hits on parts that are too thin.
void mute_thin(const ThinTriangles& thin, const PingPlan& plan, const HitColumn& hits);

}  // namespace insonify
