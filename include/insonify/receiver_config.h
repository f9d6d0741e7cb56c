// receiver_config.h -- what a receiver makes of what arrives.

#pragma once

#include <numbers>
#include <optional>
#include <vector>

#include "insonify/array_pattern.h"
#include "insonify/field.h"
#include "insonify/pulse.h"

namespace insonify {

/// How beams hear across an angle: their own slice evenly and nothing else, or as a line array with a window.
enum class BeamPattern { kTopHat, kRectangular, kHann, kHamming, kCosine, kTaylor, kDolphChebyshev };

/// What the receiver adds. All but `noise` is the calibrated model's.
struct ReceiverConfig {
  bool noise = true;  ///< Whether noise is drawn at all: the paper model's, or the calibrated model's thermal noise.
  std::optional<double> ambient_noise_db = {};  ///< Besides thermal noise [dB re 1 uPa^2/Hz], -100..200; or none.
  bool speckle = true;

  /// Across bearings. Side lobes go both ways on scanning heads, which send with the array they hear with, one way on
  /// fans.
  BeamPattern azimuth_pattern = BeamPattern::kTaylor;
  BeamPattern elevation_pattern = BeamPattern::kTopHat;  ///< Across elevations, sending and hearing.
  double side_lobe_db = -30;                             ///< Of kTaylor and kDolphChebyshev [dB], -100..-15.
  BeamShape beam_shape = BeamShape::kWedge;              ///< What lies at one bearing.

  int elements = 0;                        ///< Of the azimuth pattern's array, 0..1024; 0: one unbroken line.
  double element_error_db = 0;             ///< Standard deviation of their amplitudes [dB], 0..20.
  double element_error = 0;                ///< Of their phases [rad], 0..180 deg.
  std::vector<double> dead_elements = {};  ///< That hear nothing, from 0 at the port end.
  PulseKind pulse = PulseKind::kNone;      ///< kNone: as long as a bin.
  double pulse_duration = 50e-6;           ///< Of kCw and kLfm [s], in (0, 1].
  double pulse_bandwidth = 100e3;          ///< Of kLfm [Hz], in (0, 1e7]; times pulse_duration at least 10.

  /// X of the gain X log10(r) + 2 alpha r [dB] that the recording is raised by, r in metres and alpha the water's
  /// absorption; 0..60. None: raw. 40 evens out point targets, 30 floors, 20 water's reverberation.
  std::optional<double> time_varied_gain = {};

  /// A table of gain over range in its place: gains_db[i] at gain_ranges[i], straight between, the same beyond its
  /// ends.
  std::vector<double> gain_ranges = {};  ///< Rising [m], 0..1e5.
  std::vector<double> gains_db = {};     ///< One for each [dB], -300..300.

  /// Level that the receiver's input cannot exceed [dB re the source's at 1 m], -400..100; none when absent.
  std::optional<double> saturation_db = {};

  bool field = false;                        ///< Whether pings carry the complex field besides; needs speckle.
  bool counts = false;                       ///< Whether pings carry counts besides, as SonarConfig::bits has them.
  std::optional<double> full_scale_db = {};  ///< Level of the greatest count, as recorded [dB], -400..400.

  /// What is recorded is raised by this at a range > 0 [dB], of whichever gain is given.
  [[nodiscard]] double gain_db(double range, double absorption_db_per_m) const;

  /// @throws Error on the first field out of limits, or that does not go with another.
  void validate() const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"noise", "", {}, "Whether noise is drawn: the paper model's own, or thermal noise (calibrated)."},
          self.noise);
    visit(
        Field{"ambient_noise_db", "dB", from_to(-100, 200),
              "Spectral level at the carrier of noise besides thermal, re 1 uPa^2/Hz (calibrated); none when absent."},
        self.ambient_noise_db);
    visit(Field{"speckle", "", {}, "Whether echoes interfere, as a coherent sonar hears them (calibrated)."},
          self.speckle);
    visit(Field{"azimuth_pattern",
                "",
                {},
                "How beams hear across bearings: top_hat, or the window of a line array "
                "(calibrated)."},
          self.azimuth_pattern);
    visit(Field{"elevation_pattern",
                "",
                {},
                "How the sonar sends and hears across elevations: top_hat, or the window of an array that is "
                "elevation_aperture wide at half power, one way (calibrated)."},
          self.elevation_pattern);
    visit(Field{"side_lobe_db", "dB", from_to(-100, -15), "Side lobes re the main lobe (taylor, dolph_chebyshev)."},
          self.side_lobe_db);
    visit(Field{"beam_shape",
                "",
                {},
                "wedge (a beam holds its azimuth at every elevation) or cone (around the array, as line arrays have "
                "it: sin(azimuth) cos(elevation) is held) (calibrated)."},
          self.beam_shape);
    visit(Field{"elements", "", from_to(0, 1024), "Of the array of the azimuth_pattern; 0: one unbroken line."},
          self.elements);
    visit(Field{"element_error_db", "dB", from_to(0, 20), "Standard deviation of their amplitudes, drawn by the seed."},
          self.element_error_db);
    visit(Field{"element_error", "rad", from_to(0, std::numbers::pi), "Standard deviation of their phases."},
          self.element_error);
    visit(Field{"dead_elements", "", from_to(0, 1023), "Those that hear nothing, from 0 at the port end."},
          self.dead_elements);
    visit(Field{"pulse",
                "",
                {},
                "none (as long as a bin), cw (a tone) or lfm (a chirp), matched-filtered "
                "(calibrated)."},
          self.pulse);
    visit(Field{"pulse_duration", "s", above_to(0, 1), "Of the tone or the chirp."}, self.pulse_duration);
    visit(Field{"pulse_bandwidth", "Hz", above_to(0, 1e7), "Of the chirp."}, self.pulse_bandwidth);
    visit(Field{"time_varied_gain", "dB/decade", from_to(0, 60),
                "X of the gain X log10(r / 1 m) + 2 alpha r that intensities are recorded with (calibrated); none for "
                "raw."},
          self.time_varied_gain);
    visit(
        Field{"gain_ranges", "m", from_to(0, 1e5), "Ranges, rising, of a table of gain in place of that (calibrated)."},
        self.gain_ranges);
    visit(Field{"gains_db", "dB", from_to(-300, 300), "Gain at each of them; straight between, the same beyond."},
          self.gains_db);
    visit(Field{"saturation_db", "dB", from_to(-400, 100),
                "Level re the source's at 1 m that the receiver's input cannot exceed (calibrated); none when absent."},
          self.saturation_db);
    visit(Field{"field", "", {}, "Whether to record the complex field besides (calibrated, with speckle)."},
          self.field);
    visit(
        Field{"counts", "", {}, "Whether to record counts besides, as the sonar's bits and mapping say (calibrated)."},
        self.counts);
    visit(Field{"full_scale_db", "dB", from_to(-400, 400), "Recorded level that fills the counts."},
          self.full_scale_db);
  }
};

}  // namespace insonify
