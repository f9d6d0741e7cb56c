// left_out.h -- which primary echoes are computed on the object instead of by the samples of the lattice.

#pragma once

#include <cstdint>
#include <vector>

#include "echo/model/hit_column.h"
#include "echo/model/ping_plan.h"

namespace insonify {

/// Triangles whose primary echo, or a part of it, the samples of the lattice leave out.
struct LeftOut {
  /// [instance][triangle of its mesh] Thickness of the parts that are thin in two directions, as ropes, chains and nets
  /// are: the second smallest extent of the body at a triangle [m]; infinite where the body is not thin. Empty for an
  /// instance without any. Where it is less than thin_per_metre() times the range, the primary echo is that of
  /// ThinEchoes (echo/targets).
  std::vector<std::vector<float>> thickness;

  /// [instance][triangle] 1 for the plane faces whose coherent echo is that of FaceGlints (echo/targets): their lobe
  /// loses the coherent share. Empty for an instance without any.
  std::vector<std::vector<std::uint8_t>> glinting;
};

/// Thickness, per metre of range, below which a part is too thin for the lattice: four samples. Curved bodies of four
/// samples and more have steady echoes (docs/concepts/scattering.md, "Curved surfaces").
[[nodiscard]] float thin_per_metre(const PingPlan& plan);

/// Takes off HitColumn::power what is left out.
void leave_out(const LeftOut& left_out, const PingPlan& plan, const HitColumn& hits);

}  // namespace insonify
