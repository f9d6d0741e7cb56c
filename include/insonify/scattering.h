// scattering.h -- how a surface scatters and reflects sound in the `calibrated` model, as a function of the angle.

#pragma once

#include <array>
#include <cmath>
#include <memory>

namespace insonify {

/// A function of the cosine c of the angle of incidence, tabulated at steps that are even in sqrt(1 - c) = sqrt(2)
/// sin(angle/2), about 0.2 degrees, with linear interpolation.
class AngleTable {
 public:
  static constexpr int kSteps = 512;

  /// Cosine of a node, 0..kSteps; node 0 is normal incidence.
  [[nodiscard]] static double cosine(int node) {
    const double root = static_cast<double>(node) / kSteps;
    return 1 - root * root;
  }

  AngleTable() = default;  ///< 0 at all angles.

  /// @param law  The function. It is evaluated at 1e-4 instead of at 0, where sound only grazes the surface.
  template <typename Law>
  explicit AngleTable(const Law& law) {
    for (int node = 0; node <= kSteps; ++node) {
      values_[node] = law(std::fmax(cosine(node), 1e-4));
    }
  }

  /// @param cosine  0..1.
  [[nodiscard]] double at(double cosine) const {
    const double place = kSteps * std::sqrt(std::fmax(1 - cosine, 0.0));
    const int node = place < kSteps ? static_cast<int>(place) : kSteps - 1;
    return values_[node] + (std::fmin(place, kSteps) - node) * (values_[node + 1] - values_[node]);
  }

  [[nodiscard]] const std::array<double, kSteps + 1>& values() const { return values_; }

 private:
  std::array<double, kSteps + 1> values_ = {};
};

/// Angle-dependent terms beyond Lambert's law and the facet lobe, by cosine of incidence.
struct AngularScattering {
  AngleTable reflectance;  ///< |R|^2 of reflected rays, and of facets.
  AngleTable backscatter;  ///< Backscattering cross section in addition to both laws, over the cosine [1/sr].
  AngleTable diffuse;      ///< b: b(in) b(out) cos(in) cos(out) between two directions, in addition to both laws.
};

/// How a surface scatters and reflects sound in the `calibrated` model; the formulas are those of
/// acoustics/backscatter.h.
struct Scattering {
  double lambert = 0;     ///< Lambert parameter mu [1/sr]: the diffuse cross section is mu cos^2(incidence).
  double reflection = 0;  ///< |R| at normal incidence, of the facet lobe and of reflected rays.
  double rms_slope = 0;   ///< Root mean square slope of the facets that make the lobe, along each axis.
  double roughness = 0;   ///< 4 k^2 h^2 of the rms height h: a mirror reflects exp(-roughness cos^2) coherently.
  /// Whether facets act as mirrors. If not, only the coherent share of the reflected sound is reflected as by a mirror;
  /// the rest counts as diffuse, and only random walks follow it.
  bool facets_mirror = true;
  std::shared_ptr<const AngularScattering> by_angle = {};  ///< Null: |R| is the same at all angles, without more terms.
  std::shared_ptr<const AngleTable> passed = {};           ///< |T|^2, share of the transmitted energy; null: opaque.

  /// |R|^2 at an angle of incidence.
  /// @param cosine  Of that angle, 0..1.
  [[nodiscard]] double reflectance(double cosine) const {
    return by_angle ? by_angle->reflectance.at(cosine) : reflection * reflection;
  }

  /// Share of the incident energy that is transmitted in its original direction, 0..1.
  /// @param cosine  As for reflectance().
  [[nodiscard]] double transmittance(double cosine) const { return passed ? passed->at(cosine) : 0; }

  /// Share of the reflected energy that is reflected as by a mirror, 0..1.
  [[nodiscard]] double mirror_share(double cosine) const {
    return facets_mirror ? 1 : std::exp(-roughness * cosine * cosine);
  }
};

}  // namespace insonify
