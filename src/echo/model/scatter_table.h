// scatter_table.h -- what the materials of a scene make of sound in the `calibrated` model.

#pragma once

#include <span>
#include <vector>

#include "echo/grid/echo.h"
#include "insonify/material.h"

namespace insonify {

struct HitColumn;

/// The materials' backscatter with all that does not depend on incidence worked out: for theta from the normal,
///
///     s_b(theta) = mu cos^2 theta + |R|^2 / (8 pi s^2 cos^4 theta) exp(-tan^2 theta / (2 s^2))
///
/// Lambert's law beside the lobe of Gaussian facets in the Kirchhoff approximation (PHYSICS 0): spheres and plates come
/// out at their target strengths.
class ScatterTable {
 public:
  /// @param frequency  [Hz]
  ScatterTable(std::span<const Material> materials, double frequency);

  /// Echo intensity of each sample, relative to the source's at 1 m, per unit of the solid angle it stands for:
  /// s_b / cos(theta) x e^(-4 gamma r) / r^2, r the true range. Fills in HitColumn::power; 0 where nothing was hit or
  /// relief turns the surface away. Where there is relief its reflectivity scales amplitudes.
  void fill_powers(int rows, float neper_per_metre, const HitColumn& hits) const;

  /// |R|^2 of a surface, which it keeps of what it mirrors.
  [[nodiscard]] float reflectance(SurfaceLabel surface) const { return reflectance_[material_of(surface)]; }

  /// 1 / (2 s^2) of a surface.
  [[nodiscard]] float steepness(SurfaceLabel surface) const { return steepness_[material_of(surface)]; }

  /// The tables by material, for loops; at `nothing` is one that scatters nothing, for samples without a hit.
  struct Laws {
    std::uint32_t nothing;
    const float* lambert;
    const float* lobe;
    const float* steepness;
  };
  [[nodiscard]] Laws laws() const {
    return {static_cast<std::uint32_t>(reflectance_.size()), lambert_.data(), lobe_.data(), steepness_.data()};
  }

 private:
  std::vector<float> reflectance_;
  std::vector<float> lambert_;
  std::vector<float> lobe_;       // |R|^2 / (8 pi s^2)
  std::vector<float> steepness_;  // 1 / (2 s^2)
};

}  // namespace insonify
