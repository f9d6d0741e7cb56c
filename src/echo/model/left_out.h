// left_out.h -- removes from the lattice's primary echoes those that ThinEchoes and FaceGlints compute instead.

#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "echo/model/flat_plan.h"
#include "echo/model/hit_column.h"

namespace insonify {

/// Triangles whose primary echo, or part of it, is removed from the samples of the lattice.
struct LeftOut {
  /// [triangle of a mesh]; shared by instances that are alike.
  template <typename Value>
  using ByTriangle = std::shared_ptr<const std::vector<Value>>;

  /// [instance][triangle of its mesh] Thickness of parts that are thin in two directions (ropes, chains, nets): the
  /// second smallest extent of the body at the triangle [m]; infinite if the body is not thin. Null for an instance
  /// without thin parts. If it is less than thin_per_metre() times the range, ThinEchoes (echo/targets) computes the
  /// primary echo.
  std::vector<ByTriangle<float>> thickness;

  /// [instance][triangle] 1 for plane faces whose coherent echo FaceGlints (echo/targets) computes: the coherent share
  /// is removed from their lobe. Null for an instance without any.
  std::vector<ByTriangle<std::uint8_t>> glinting;
};

/// Thickness per metre of range below which a part is too thin for the lattice: four samples. The echo of thicker
/// curved bodies does not depend on their position among the samples (docs/concepts/scattering.md, "Curved surfaces").
[[nodiscard]] float thin_per_metre(const FlatPlan& plan);

/// Subtracts the removed echoes from HitColumn::power.
void leave_out(const LeftOut& left_out, const FlatPlan& plan, const HitColumn& hits);

}  // namespace insonify
