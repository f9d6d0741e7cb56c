// receiver_config.h -- settings of the receiver: noise, speckle, beam patterns, pulse, gain and counts.

#pragma once

#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "insonify/array_pattern.h"
#include "insonify/pulse.h"
#include "insonify/settings_table.h"
#include "insonify/words.h"

namespace insonify {

/// Beam pattern across one angle: a top hat (gain 1 within the beam's own slice, 0 outside), or that of a line array
/// with a window. kInstrument: the sonar's own, see SonarConfig::elevation_pattern_beside().
enum class BeamPattern { kTopHat, kRectangular, kHann, kHamming, kCosine, kTaylor, kDolphChebyshev, kInstrument };
template <>
constexpr auto words_of<BeamPattern>() {
  return EnumWords<BeamPattern, 8>{{{"top_hat", BeamPattern::kTopHat},
                                    {"rectangular", BeamPattern::kRectangular},
                                    {"hann", BeamPattern::kHann},
                                    {"hamming", BeamPattern::kHamming},
                                    {"cosine", BeamPattern::kCosine},
                                    {"taylor", BeamPattern::kTaylor},
                                    {"dolph_chebyshev", BeamPattern::kDolphChebyshev},
                                    {"instrument", BeamPattern::kInstrument}}};
}

/// What a range bin keeps of the samples of a pulse that is shorter than it: the greatest, their mean, or one of them.
enum class Decimation { kPeak, kMean, kSample };
template <>
constexpr auto words_of<Decimation>() {
  return EnumWords<Decimation, 3>{
      {{"peak", Decimation::kPeak}, {"mean", Decimation::kMean}, {"sample", Decimation::kSample}}};
}

/// Settings of the receiver. All except `noise` apply to the calibrated model only.
struct ReceiverConfig {
  bool noise = true;  ///< Whether noise is drawn: that of the paper model, or thermal noise in the calibrated model.
  std::optional<double> ambient_noise_db = {};  ///< Noise besides thermal noise [dB re 1 uPa^2/Hz], -100..200; or none.

  // Ambient noise by wind, rain and ships, added to ambient_noise_db (docs/concepts/reverberation-and-noise.md).
  std::optional<double> wind_noise = {};  ///< Wind speed 10 m above the sea [m/s], 0..60; absent: none.
  std::optional<double> rain_noise = {};  ///< Rain [mm/h], 0..300; absent: none.
  std::optional<double> ship_noise = {};  ///< Shipping, from 0 (little) to 1 (heavy); absent: none.
  bool surface_noise = false;             ///< Whether the noise of wind and rain arrives from the surface; else it
                                          ///< is isotropic, like all other noise.
  bool speckle = true;                    ///< Whether echoes interfere.

  /// Pattern across bearings. It applies twice on scanning heads, which transmit and receive with the same array, and
  /// once (on reception) on fans.
  BeamPattern azimuth_pattern = BeamPattern::kTaylor;        ///< Not kInstrument.
  BeamPattern elevation_pattern = BeamPattern::kInstrument;  ///< Pattern across elevations, on transmission and
                                                             ///< reception.
  double side_lobe_db = -30;                 ///< Side lobes of kTaylor and kDolphChebyshev [dB], -100..-15.
  BeamShape beam_shape = BeamShape::kWedge;  ///< Which directions have the same bearing.

  // The array of the azimuth pattern.
  int elements = 0;                     ///< Number of elements, 0..1024; 0: a continuous line.
  double element_error_db = 0;          ///< Standard deviation of the elements' amplitudes [dB], 0..20.
  double element_error = 0;             ///< Standard deviation of their phases [rad], 0..180 deg.
  std::vector<int> dead_elements = {};  ///< Indices of elements that receive nothing, from 0 at the port end.

  PulseKind pulse = PulseKind::kInstrument;  ///< kInstrument: the sonar's own. kNone: as long as a bin.
  double pulse_duration = 50e-6;             ///< Duration, kCw and kLfm [s], in (0, 1].
  double pulse_bandwidth = 200e3;  ///< Bandwidth, kLfm [Hz], in (0, 1e7], < 2 carrier; times pulse_duration >= 10.

  PulseWindow pulse_window = PulseWindow::kRectangular;  ///< Weights of the band, kLfm.
  double pulse_side_lobe_db = -40;              ///< Side lobes in range of pulse_window kTaylor [dB], -100..-15.
  Decimation decimation = Decimation::kSample;  ///< What bins longer than the pulse's resolution keep.

  /// X of the time-varied gain X log10(r) + 2 alpha r [dB] applied to recorded intensities, with the range r in metres
  /// and the absorption alpha; 0..60. None: no gain. 40 compensates the fall of point targets, 30 of floors, 20 of
  /// volume reverberation.
  std::optional<double> time_varied_gain = {};

  // Instead of it, a table of gain over range: gains_db[i] at gain_ranges[i], linear between, constant beyond the ends.
  std::vector<double> gain_ranges = {};  ///< Rising [m], 0..1e5.
  std::vector<double> gains_db = {};     ///< One per range [dB], -300..300.

  /// Level at which the receiver's input saturates [dB re the source's at 1 m], -400..100; absent: never.
  std::optional<double> saturation_db = {};

  bool field = false;                        ///< Whether pings also hold the complex field; needs speckle.
  bool counts = false;                       ///< Whether pings also hold counts, see SonarConfig::bits.
  std::optional<double> full_scale_db = {};  ///< Recorded level of the greatest count [dB], -400..400.

  /// Automatic gain instead of full_scale_db: share of each ping's bins that have the largest count, (0, 1].
  std::optional<double> full_scale_share = {};

  /// Gain at a range > 0 [m], from time_varied_gain or from the table [dB]; 0 without either.
  [[nodiscard]] double gain_db(double range, double absorption_db_per_m) const;

  /// @param object  Name of this receiver in messages.
  /// @throws Error on the first field that is out of limits or does not go with another.
  void validate(std::string_view object = "receiver") const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"noise", "", {}, "Whether noise is added: the paper model's own, or thermal noise (calibrated)."},
          self.noise);
    visit(Field{"ambient_noise_db", "dB", from_to(-100, 200),
                "Spectrum level of noise at the carrier, added to thermal noise, re 1 uPa^2/Hz (calibrated); none when "
                "absent.",
                ActsIn::kCalibrated, "paper.additive_deviation"},
          self.ambient_noise_db);
    visit(Field{"wind_noise", "m/s", from_to(0, 60),
                "Wind speed that sets the wind noise (calibrated); none when absent.", ActsIn::kCalibrated,
                "paper.additive_deviation"},
          self.wind_noise);
    visit(Field{"rain_noise", "mm/h", from_to(0, 300),
                "Rain rate that sets the rain noise (calibrated); none when absent.", ActsIn::kCalibrated,
                "paper.additive_deviation"},
          self.rain_noise);
    visit(
        Field{"ship_noise", "", from_to(0, 1),
              "Distant shipping that sets the ship noise, from 0 (light) to 1 (heavy) (calibrated); none when absent.",
              ActsIn::kCalibrated, "paper.additive_deviation"},
        self.ship_noise);
    visit(Field{"surface_noise",
                "",
                {},
                "Whether wind and rain noise arrives from the surface, as from vertical dipoles; otherwise it is "
                "isotropic (calibrated).",
                ActsIn::kCalibrated,
                "paper.additive_deviation"},
          self.surface_noise);
    visit(Field{"speckle",
                "",
                {},
                "Whether echoes interfere, as a coherent sonar receives them (calibrated).",
                ActsIn::kCalibrated,
                "paper.multiplicative_deviation"},
          self.speckle);
    visit(Field{"azimuth_pattern",
                "",
                {},
                "Beam pattern across bearings: top_hat, or the window of a line array (calibrated).",
                ActsIn::kCalibrated},
          self.azimuth_pattern);
    visit(Field{"elevation_pattern",
                "",
                {},
                "Transmit and receive pattern across elevations: instrument (the sonar's own), top_hat, or the window "
                "of an array that is elevation_aperture wide at half power, one way (calibrated).",
                ActsIn::kCalibrated},
          self.elevation_pattern);
    visit(Field{"side_lobe_db", "dB", from_to(-100, -15), "Side lobes re the main lobe (taylor, dolph_chebyshev).",
                ActsIn::kCalibrated},
          self.side_lobe_db);
    visit(Field{"beam_shape",
                "",
                {},
                "wedge (a beam has one azimuth at all elevations) or cone (around the array, as real line arrays: "
                "sin(azimuth) cos(elevation) is constant) (calibrated).",
                ActsIn::kCalibrated},
          self.beam_shape);
    visit(Field{"elements", "", from_to(0, 1024),
                "Number of elements of the azimuth_pattern's array; 0: a continuous line.", ActsIn::kCalibrated},
          self.elements);
    visit(Field{"element_error_db", "dB", from_to(0, 20),
                "Standard deviation of the elements' amplitudes, drawn from the seed.", ActsIn::kCalibrated},
          self.element_error_db);
    visit(Field{"element_error", "rad", from_to(0, std::numbers::pi), "Standard deviation of the elements' phases.",
                ActsIn::kCalibrated},
          self.element_error);
    visit(Field{"dead_elements", "", from_to(0, 1023),
                "Indices of elements that receive nothing; 0 is at the port end.", ActsIn::kCalibrated},
          self.dead_elements);
    visit(Field{"pulse",
                "",
                {},
                "instrument (the sonar's own), none (as long as a bin), cw (a tone) or lfm (a chirp), matched-filtered "
                "(calibrated).",
                ActsIn::kCalibrated},
          self.pulse);
    visit(Field{"pulse_duration", "s", above_to(0, 1), "Duration of the tone or the chirp.", ActsIn::kCalibrated},
          self.pulse_duration);
    visit(Field{"pulse_bandwidth", "Hz", above_to(0, 1e7), "Bandwidth of the chirp.", ActsIn::kCalibrated},
          self.pulse_bandwidth);
    visit(Field{"pulse_window",
                "",
                {},
                "Window over the chirp's band; lowers the side lobes in range.",
                ActsIn::kCalibrated},
          self.pulse_window);
    visit(Field{"pulse_side_lobe_db", "dB", from_to(-100, -15), "Side lobes in range with pulse_window taylor.",
                ActsIn::kCalibrated},
          self.pulse_side_lobe_db);
    visit(
        Field{"decimation",
              "",
              {},
              "Value kept by a bin longer than the pulse's resolution: peak, mean, or sample (one look) (calibrated).",
              ActsIn::kCalibrated},
        self.decimation);
    visit(Field{"time_varied_gain", "dB/decade", from_to(0, 60),
                "X of the gain X log10(r / 1 m) + 2 alpha r applied to recorded intensities (calibrated); no gain when "
                "absent.",
                ActsIn::kCalibrated, "a sonar's gain"},
          self.time_varied_gain);
    visit(Field{"gain_ranges", "m", from_to(0, 1e5),
                "Ranges of a gain table, rising, instead of time_varied_gain (calibrated).", ActsIn::kCalibrated,
                "a sonar's gain"},
          self.gain_ranges);
    visit(Field{"gains_db", "dB", from_to(-300, 300),
                "Gain at each of gain_ranges; linear between them, constant beyond.", ActsIn::kCalibrated,
                "a sonar's gain"},
          self.gains_db);
    visit(Field{"saturation_db", "dB", from_to(-400, 100),
                "Level, re the source level, at which the receiver's input saturates (calibrated); never when absent.",
                ActsIn::kCalibrated},
          self.saturation_db);
    visit(Field{"field",
                "",
                {},
                "Whether to also record the complex field (calibrated, with speckle).",
                ActsIn::kCalibrated},
          self.field);
    visit(Field{"counts",
                "",
                {},
                "Whether to also record counts, by the sonar's bits and mapping (calibrated).",
                ActsIn::kCalibrated},
          self.counts);
    visit(Field{"full_scale_db", "dB", from_to(-400, 400), "Recorded level of the largest count.", ActsIn::kCalibrated},
          self.full_scale_db);
    visit(Field{"full_scale_share", "", above_to(0, 1),
                "Automatic gain: share of each ping's bins, without the transmit leak, that have the largest count, "
                "instead of full_scale_db.",
                ActsIn::kCalibrated},
          self.full_scale_share);
  }
};

}  // namespace insonify
