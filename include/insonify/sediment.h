// sediment.h -- what sea floors are made of, and what that makes of sound.

#pragma once

#include <complex>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace insonify {

/// How far the figures of a sediment are to be trusted, below 100 kHz. Above that, none better than low.
enum class Confidence {
  kHigh,    ///< The report's equations give its table, and the fit is as close as said at sediment_table().
  kMedium,  ///< One figure is not read for sure from the report, or the fit had to be held back by 2 dB.
  kLow,     ///< The fit had to be held back by more.
};

/// A sea floor as a fluid with a rough surface and small scatterers inside: APL-UW High-Frequency Ocean Environmental
/// Acoustic Models Handbook, TR 9407 (1994), section IV, table 2 and eqs 2 to 10. For 10 to 100 kHz. Ratios are to the
/// water above.
struct Sediment {
  std::string name = {};                  ///< Lower case, words joined by '_'.
  std::optional<double> grain_size = {};  ///< Mean, M_z = -log2(diameter/mm) [phi], -1..9; none for stones and rock.
  double density_ratio = 1;               ///< rho.
  double sound_speed_ratio = 1;           ///< nu, of compressional waves.
  double loss = 0;                        ///< delta, imaginary over real part of the wavenumber.
  double volume_parameter = 0;            ///< sigma_2, echo of a volume over the absorption in it.
  double spectral_strength = 0;           ///< w_2, of the relief's spectrum at a wavenumber of 1/cm [cm^4].
  double spectral_exponent = 3.25;        ///< gamma, of that spectrum.
  double lambert_mu_db = 0;               ///< Lambert parameter fitted to the report's echo at 100 kHz [dB], <= -5.
  std::optional<double> rms_slope = {};  ///< Of the Kirchhoff lobe fitted to it; none where only the diffuse echo fits.
  Confidence confidence = Confidence::kHigh;

  /// bottom_reflection() of it. @param grazing [rad], 0..pi/2.
  [[nodiscard]] std::complex<double> reflection(double grazing) const;
};

/// The report's properties for a mean grain size, eqs 2 to 10; without name and fit.
/// @param grain_size  [phi], -1 (sandy gravel) .. 9 (clay).
/// @throws Error if it is out of its limits.
[[nodiscard]] Sediment sediment_of_grain_size(double grain_size);

/// Every sediment known by name, coarse to fine.
///
/// The fit is that of backscatter.h to the report's model at 100 kHz: mu to grazing angles of 10 to 40 degrees, which
/// it meets within 0.7 to 1.6 dB rms (2.0 for rough rock), the slope to normal incidence. The report itself is good for
/// 3 to 10 dB. Rocks are held at -5 dB, as much as a surface can send back. They, gravels and very coarse sand would
/// need slopes above 0.5 and have no lobe. Above 100 kHz few measurements exist: at 300 to 450 kHz sand -15 to -22 dB,
/// mud -25 to -32; hold mu.
[[nodiscard]] std::span<const Sediment> sediment_table();

/// The table's sediment of that name (case does not matter; '_', '-' and ' ' are alike), or null.
[[nodiscard]] const Sediment* find_sediment(std::string_view name);

}  // namespace insonify
