// scatter_table.h -- scattering parameters of all materials of a scene, for the loops of the `calibrated` model.

#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "echo/grid/echo.h"
#include "echo/laws/laws.h"
#include "insonify/material.h"

namespace insonify {

struct HitColumn;

/// The numbers of a ScatterTable.
struct ScatterNumbers {
  std::uint32_t nothing = 0;  ///< Number of materials: index of the zeros at the end of each table.
  bool any_rough = false;     ///< Whether any mirror has a roughness.
  bool any_on_top = false;    ///< Whether any AngularScattering::backscatter is not 0.
};

/// The Scatterer of each material in single precision, and where a material has them the tables of its
/// AngularScattering.
class ScatterTable : private ScatterNumbers {
 public:
  ScatterTable() = default;
  /// @param frequency      [Hz]
  /// @param facets_mirror  Whether the facets of all materials are mirrors, see Scattering::facets_mirror.
  ScatterTable(std::span<const Material> materials, double frequency, bool facets_mirror = false);

  /// Fills in HitColumn::power of the first `rows` samples: primary_intensity(). 0 where nothing was hit or the relief
  /// faces away.
  void fill_powers(int rows, float neper_per_metre, const HitColumn& hits) const;

  /// The parameters of a surface in double precision, valid as long as this table.
  [[nodiscard]] Scattering scattering(SurfaceLabel surface) const {
    const Surface& own = surfaces_[material_of(surface)];
    return {own.lambert,
            own.reflection,
            own.rms_slope,
            own.roughness,
            own.facets_mirror,
            view(angular_, own.by_angle),
            view(passes_, own.passed)};
  }

  /// Share of the intensity that a surface reflects as a mirror.
  /// @param cosine  Of the angle of incidence, of either sign.
  [[nodiscard]] float mirrored(SurfaceLabel surface, float cosine) const {
    const std::uint16_t material = material_of(surface);
    return by_angle_.empty() ? mirrored_[material]
                             : at_angle(by_angle_.data(), kAngleStride * material + kMirrored, std::abs(cosine));
  }

  /// The same of many samples; 0 where nothing was hit.
  void fill_mirrored(int rows, const SurfaceLabel* surface, const float* facing, float* mirrored) const;

  /// Whether any surface lets sound through.
  [[nodiscard]] bool any_passing() const { return !passed_.empty(); }

  /// Scattering::transmittance() of the surfaces that `rows` samples hit, in single precision; 0 where nothing was hit.
  /// Only where any_passing().
  void fill_passed(int rows, const SurfaceLabel* surface, const float* facing, float* passed) const;

  /// 1 / (2 s^2) of a surface.
  [[nodiscard]] float steepness(SurfaceLabel surface) const { return steepness_[material_of(surface)]; }

  /// Scattering::roughness of a surface whose facets are mirrors, 0 of others.
  [[nodiscard]] float roughness(SurfaceLabel surface) const { return roughness_[material_of(surface)]; }

  /// Whether any surface has such a roughness.
  [[nodiscard]] bool has_rough() const { return any_rough; }

  /// The tables by material, for loops. Index `nothing` holds zeros, for samples without a hit.
  struct Laws {
    std::uint32_t nothing;
    bool on_top;             ///< See ScatterNumbers.
    const float* mirrored;   ///< ScatterTable::mirrored() where no law depends on the angle.
    const float* roughness;  ///< ScatterTable::roughness(); not at `nothing`.
    const float* lambert;    ///< Scatterer
    const float* lobe;       ///< The same.
    const float* steepness;  ///< The same.
    const float* facets;     ///< 1 / (8 pi s^2)
    const float* by_angle;   ///< [material][kAngleStride]; null where no law depends on the angle.
    const float* passed;     ///< [material][kAngleNodes], see fill_passed(); null where all surfaces are opaque.

    [[nodiscard, gnu::always_inline]] std::uint32_t index_of(SurfaceLabel surface) const {
      const std::uint32_t material = surface & 0xffffU;  // material_of()
      return material < nothing ? material : nothing;
    }
    [[nodiscard, gnu::always_inline]] Scatterer scatterer(std::uint32_t material) const {
      return {lambert[material], lobe[material], steepness[material]};
    }
  };
  [[nodiscard]] Laws laws() const {
    return {nothing,
            any_on_top,
            mirrored_.data(),
            roughness_.data(),
            lambert_.data(),
            lobe_.data(),
            steepness_.data(),
            facets_.data(),
            by_angle_.empty() ? nullptr : by_angle_.data(),
            passed_.empty() ? nullptr : passed_.data()};
  }

  /// Places of the tables of one material: those of its AngularScattering, and mirrored().
  static constexpr std::uint32_t kAngleNodes = AngleTable::kSteps + 2;  ///< The last is repeated.
  static constexpr std::uint32_t kReflectance = 0, kBackscatter = kAngleNodes, kDiffuse = 2 * kAngleNodes,
                                 kMirrored = 3 * kAngleNodes;
  static constexpr std::uint32_t kAngleStride = 4 * kAngleNodes;

  /// AngleTable::at() in single precision, for vector loops.
  /// @param by_angle  Laws::by_angle.
  /// @param first     Place in it of a table of a material, kAngleStride x material + kReflectance or so. An
  ///                  index, since compilers vectorise look-ups only from a fixed address.
  /// @param cosine    0..1.
  [[nodiscard, gnu::always_inline]] static float at_angle(const float* by_angle, std::uint32_t first, float cosine) {
    const float place = AngleTable::kSteps * std::sqrt(held_in_unit(1 - cosine));
    const auto node = static_cast<std::int32_t>(place);
    const std::uint32_t at = first + static_cast<std::uint32_t>(node);
    const float here = by_angle[at];
    return here + (place - static_cast<float>(node)) * (by_angle[at + 1] - here);
  }

  /// See FlatPlan::visit_parts().
  template <typename Self, typename Numbers, typename Table>
  static void visit_parts(Self& self, const Numbers& numbers, const Table& table) {
    numbers(static_cast<std::conditional_t<std::is_const_v<Self>, const ScatterNumbers&, ScatterNumbers&>>(self));
    table("surfaces", self.surfaces_);
    table("angular", self.angular_);
    table("passes", self.passes_);
    table("mirrored", self.mirrored_);
    table("lambert", self.lambert_);
    table("lobe", self.lobe_);
    table("steepness", self.steepness_);
    table("facets", self.facets_);
    table("roughness", self.roughness_);
    table("by_angle", self.by_angle_);
    table("passed", self.passed_);
  }

 private:
  // Scattering, with indices into tables; -1 for none.
  struct Surface {
    double lambert, reflection, rms_slope, roughness;
    bool facets_mirror;
    std::int32_t by_angle, passed;
  };

  // A pointer that does not own what it points to; null for index -1.
  template <typename Value>
  [[nodiscard]] static std::shared_ptr<const Value> view(const std::vector<Value>& values, std::int32_t index) {
    return {std::shared_ptr<const void>(), index < 0 ? nullptr : &values[static_cast<std::size_t>(index)]};
  }

  // In double precision.
  std::vector<Surface> surfaces_;  // [material]
  std::vector<AngularScattering> angular_;
  std::vector<AngleTable> passes_;

  // In single precision.
  std::vector<float> mirrored_;
  std::vector<float> lambert_;
  std::vector<float> lobe_;
  std::vector<float> steepness_;
  std::vector<float> facets_;
  std::vector<float> roughness_;
  std::vector<float> by_angle_;  // [material][kAngleStride]; empty where no law depends on the angle.
  std::vector<float> passed_;    // [material][kAngleNodes]; empty where all surfaces are opaque.
};

}  // namespace insonify
