// sediment.h -- geoacoustic properties of sea-floor sediments, by name or by grain size.

#pragma once

#include <complex>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace insonify {

/// How reliable the values of a sediment are below 100 kHz. Above that, all are kLow at best.
enum class Confidence {
  kHigh,    ///< The report's equations reproduce its table, and the fit is as close as stated at sediment_table().
  kMedium,  ///< One value could not be read with certainty from the report, or the fit was limited by up to 2 dB.
  kLow,     ///< The fit was limited by more than that.
};

/// A sea floor modelled as a fluid with a rough surface and small scatterers in its volume: APL-UW High-Frequency Ocean
/// Environmental Acoustic Models Handbook, TR 9407 (1994), section IV, table 2 and eqs 2 to 10. For 10 to 100 kHz.
/// Ratios are to the water above.
struct Sediment {
  std::string name = {};                  ///< Lower case, words joined by '_'.
  std::optional<double> grain_size = {};  ///< Mean, M_z = -log2(diameter/mm) [phi], -1..9; none for stones and rock.
  double density_ratio = 1;               ///< rho.
  double sound_speed_ratio = 1;           ///< nu, ratio of compressional sound speeds.
  double loss = 0;                        ///< delta, imaginary over real part of the wavenumber.
  double volume_parameter = 0;            ///< sigma_2, volume scattering cross section over absorption coefficient.
  double spectral_strength = 0;           ///< w_2, roughness spectrum at a wavenumber of 1/cm [cm^4].
  double spectral_exponent = 3.25;        ///< gamma, exponent of that spectrum.
  double lambert_mu_db = 0;  ///< Lambert parameter fitted to the report's backscatter at 100 kHz [dB], <= -5.
  std::optional<double> rms_slope = {};  ///< Fitted rms slope of the facet lobe; none where only Lambert's law fits.
  Confidence confidence = Confidence::kHigh;

  /// bottom_reflection() with these properties. @param grazing [rad], 0..pi/2.
  [[nodiscard]] std::complex<double> reflection(double grazing) const;
};

/// The report's properties as functions of mean grain size, eqs 2 to 10; name and fitted values are not set.
/// @param grain_size  [phi], -1 (sandy gravel) .. 9 (clay).
/// @throws Error if it is out of its limits.
[[nodiscard]] Sediment sediment_of_grain_size(double grain_size);

/// All sediments known by name, from coarse to fine.
///
/// lambert_mu_db and rms_slope fit the formulas of backscatter.h to the report's model at 100 kHz: mu at grazing angles
/// from 10 to 40 degrees, with an error of 0.7 to 1.6 dB rms (2.0 for rough rock); the slope at normal incidence. The
/// report's model itself is accurate to 3 to 10 dB. mu of rocks is limited to -5 dB, the most that a passive surface
/// can scatter. Rocks, gravels and very coarse sand would need slopes above 0.5 and have no lobe. Above 100 kHz few
/// measurements exist (at 300 to 450 kHz, -15 to -22 dB for sand and -25 to -32 dB for mud); use the same mu there.
[[nodiscard]] std::span<const Sediment> sediment_table();

/// The table's sediment of that name (case does not matter; '_', '-' and ' ' are alike), or null.
[[nodiscard]] const Sediment* find_sediment(std::string_view name);

}  // namespace insonify
