// scatter_table.h -- scattering parameters of all materials of a scene, for the loops of the `calibrated` model.

#pragma once

#include <span>
#include <vector>

#include "base/vector_math.h"
#include "echo/grid/echo.h"
#include "echo/model/lobe_widening.h"
#include "insonify/material.h"

namespace insonify {

struct HitColumn;

/// The terms of the backscattering coefficient
///
///     s_b(theta) = mu cos^2 theta + |R|^2 / (8 pi s^2 cos^4 theta) exp(-tan^2 theta / (2 s^2))
///
/// that do not depend on the angle of incidence theta, per material and in single precision. The law itself is
/// lambert_backscatter() and facet_backscatter().
class ScatterTable {
 public:
  /// @param frequency  [Hz]
  ScatterTable(std::span<const Material> materials, double frequency);

  /// Fills in HitColumn::power of the first `rows` samples: primary_intensity(), in single precision. 0 where nothing
  /// was hit or the relief faces away.
  void fill_powers(int rows, float neper_per_metre, const HitColumn& hits) const;

  /// The parameters of a surface in double precision.
  [[nodiscard]] const Scattering& scattering(SurfaceLabel surface) const { return scattering_[material_of(surface)]; }

  /// |R|^2 of a surface: the share of the intensity that it reflects.
  [[nodiscard]] float reflectance(SurfaceLabel surface) const { return reflectance_[material_of(surface)]; }

  /// 1 / (2 s^2) of a surface.
  [[nodiscard]] float steepness(SurfaceLabel surface) const { return steepness_[material_of(surface)]; }

  /// The tables by material, for loops. Index `nothing` holds zeros, for samples without a hit.
  struct Laws {
    std::uint32_t nothing;
    const float* lambert;    ///< mu
    const float* lobe;       ///< |R|^2 / (8 pi s^2)
    const float* steepness;  ///< 1 / (2 s^2)

    [[nodiscard, gnu::always_inline]] std::uint32_t index_of(SurfaceLabel surface) const {
      const std::uint32_t material = surface & 0xffffU;  // material_of()
      return material < nothing ? material : nothing;
    }
  };
  [[nodiscard]] Laws laws() const {
    return {static_cast<std::uint32_t>(reflectance_.size()), lambert_.data(), lobe_.data(), steepness_.data()};
  }

 private:
  std::vector<Scattering> scattering_;
  std::vector<float> reflectance_;
  std::vector<float> lambert_;
  std::vector<float> lobe_;
  std::vector<float> steepness_;
};

/// facet_backscatter() in single precision, for vector loops: lobe / cos^4 x exp(-tan^2 x steepness).
/// @param cosine  At least kLeastCosine.
[[gnu::always_inline]] inline float facet_lobe(float lobe, float steepness, float cosine) {
  const float secant_square = 1 / (cosine * cosine);
  return lobe * secant_square * secant_square * fast_exp((1 - secant_square) * steepness);
}

/// The lobe of a footprint whose normal turns, divided by the cosine of incidence: per unit of solid angle. Without
/// widening facet_lobe() / cosine, bit by bit.
[[gnu::always_inline]] inline float widened_lobe(float lobe, float steepness, float cosine,
                                                 const LobeWidening<float>& widening) {
  const float square = cosine * cosine;
  const float secant_square = 1 / (square + widening.spared);
  const float peak = lobe * secant_square * secant_square * fast_exp((1 - secant_square) * steepness);
  return peak * std::sqrt(widening.share) / std::sqrt(square + (1 - widening.share) * (1 - square));
}

}  // namespace insonify
