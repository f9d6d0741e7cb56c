// sediment.cpp -- the report's regressions against grain size, and the table of sediments made from them.

#include "insonify/acoustics/sediment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "acoustics/formula.h"
#include "base/names.h"
#include "insonify/acoustics/reflection.h"

namespace insonify {
namespace {

// APL-UW TR 9407, section IV, eqs 2 to 10; m is the mean grain size M_z in phi.

double density_ratio(double m) {
  if (m < 1) {
    return 0.007797 * m * m - 0.17057 * m + 2.3139;
  }
  if (m < 5.3) {
    return -0.0165406 * m * m * m + 0.2290201 * m * m - 1.1069031 * m + 3.0455;
  }
  return -0.0012973 * m + 1.1565;
}

double sound_speed_ratio(double m) {
  if (m < 1) {
    return 0.002709 * m * m - 0.056452 * m + 1.2778;
  }
  if (m < 5.3) {
    return -0.0014881 * m * m * m + 0.0213937 * m * m - 0.1382798 * m + 1.3425;
  }
  return -0.0024324 * m + 1.0019;
}

// Absorption over frequency [dB/(m kHz)], after Hamilton.
double absorption_factor(double m) {
  if (m < 0) {
    return 0.4556;
  }
  if (m < 2.6) {
    return 0.4556 + 0.0245 * m;
  }
  if (m < 4.5) {
    return 0.1978 + 0.1245 * m;
  }
  if (m < 6) {
    return 8.0399 - 2.5228 * m + 0.20098 * m * m;
  }
  return 0.9431 - 0.2041 * m + 0.0117 * m * m;
}

// Loss parameter delta from absorption: 40 pi/ln 10 dB per wavelength and unit of delta. The report's water has 1528
// m/s.
double loss(double m) {
  constexpr double kSoundSpeed = 1.528;  // [m/s per Hz/kHz]
  return absorption_factor(m) * sound_speed_ratio(m) * kSoundSpeed * std::numbers::ln10 / (40 * std::numbers::pi);
}

double volume_parameter(double m) {
  return m < 5.5 ? 0.002 : 0.001;
}

// w_2 [cm^4], from the rms height of roughness over a track of 100 cm [cm].
double spectral_strength(double m) {
  const double height = m < 5 ? (2.03846 - 0.26923 * m) / (1 + 0.076923 * m) : 0.5;
  return 0.00207 * height * height;
}

// A row of the table with values of its own: rock and gravel have no grain size.
Sediment stones(const char* name, double sound_speed_ratio, double spectral_strength, double lambert_mu_db,
                Confidence confidence) {
  return {.name = name,
          .density_ratio = 2.5,
          .sound_speed_ratio = sound_speed_ratio,
          .loss = 0.01374,
          .volume_parameter = 0.002,
          .spectral_strength = spectral_strength,
          .lambert_mu_db = lambert_mu_db,
          .confidence = confidence};
}

// A row of the table by grain size.
Sediment grains(const char* name, double grain_size, double lambert_mu_db, std::optional<double> rms_slope = {}) {
  Sediment sediment = sediment_of_grain_size(grain_size);
  sediment.name = name;
  sediment.lambert_mu_db = lambert_mu_db;
  sediment.rms_slope = rms_slope;
  return sediment;
}

std::vector<Sediment> make_table() {
  return {
      // The fit to rocks gives mu of +2.4 and -3.1 dB, more than a passive surface can scatter; they are limited to -5
      // dB. The spectral strength of gravel in table 2 of the report reads as .016 to .0186.
      stones("rough_rock", 2.5, 0.20693, -5, Confidence::kLow),
      stones("rock", 2.5, 0.01862, -5, Confidence::kMedium),
      stones("gravel", 1.8, 0.016, -7.3, Confidence::kMedium),
      grains("sandy_gravel", -1, -10.8),
      grains("very_coarse_sand", -0.5, -11.7),
      grains("coarse_sand", 0.5, -13.4, 0.469),
      grains("medium_sand", 1.5, -15.9, 0.258),
      grains("fine_sand", 2.5, -18.5, 0.157),
      grains("very_fine_sand", 3.5, -19.0, 0.098),
      grains("clayey_sand", 4, -19.0, 0.075),
      grains("coarse_silt", 4.5, -19.3, 0.056),
      grains("sandy_silt", 5, -19.6, 0.040),
      grains("medium_silt", 5.5, -23.0, 0.040),
      grains("sandy_mud", 6, -23.0, 0.040),
      grains("fine_silt", 6.5, -23.1, 0.040),
      grains("sandy_clay", 7, -23.1, 0.040),
      grains("silty_clay", 8, -23.2, 0.040),
      grains("clay", 9, -23.3, 0.040),
  };
}

}  // namespace

std::complex<double> Sediment::reflection(double grazing) const {
  return bottom_reflection(density_ratio, sound_speed_ratio, loss, grazing);
}

Sediment sediment_of_grain_size(double grain_size) {
  check_argument("sediment_of_grain_size", "grain_size", "phi", from_to(-1, 9), grain_size);
  return {.grain_size = grain_size,
          .density_ratio = density_ratio(grain_size),
          .sound_speed_ratio = sound_speed_ratio(grain_size),
          .loss = loss(grain_size),
          .volume_parameter = volume_parameter(grain_size),
          .spectral_strength = spectral_strength(grain_size)};
}

std::span<const Sediment> sediment_table() {
  static const std::vector<Sediment> kTable = make_table();
  return kTable;
}

const Sediment* find_sediment(std::string_view name) {
  const std::span<const Sediment> table = sediment_table();
  const auto found = std::ranges::find(table, canonical_name(name), &Sediment::name);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace insonify
