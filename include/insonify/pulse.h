// pulse.h -- range point-spread function of the transmitted pulse after its matched filter.

#pragma once

#include <string_view>
#include <vector>

#include "insonify/array_pattern.h"
#include "insonify/settings_table.h"
#include "insonify/words.h"

namespace insonify {

/// kNone: a rectangle as long as a range bin. kCw: a tone. kLfm: a linear frequency-modulated chirp, compressed by its
/// matched filter. kInstrument: the sonar's own, see SonarConfig::transmitted().
enum class PulseKind { kNone, kCw, kLfm, kInstrument };
template <>
constexpr auto words_of<PulseKind>() {
  return EnumWords<PulseKind, 4>{{{"none", PulseKind::kNone},
                                  {"cw", PulseKind::kCw},
                                  {"lfm", PulseKind::kLfm},
                                  {"instrument", PulseKind::kInstrument}}};
}

/// Window over the band of a chirp, with which the receiver lowers its side lobes in range.
enum class PulseWindow { kRectangular, kHann, kHamming, kCosine, kTaylor };
template <>
constexpr auto words_of<PulseWindow>() {
  return EnumWords<PulseWindow, 5>{{{"rectangular", PulseWindow::kRectangular},
                                    {"hann", PulseWindow::kHann},
                                    {"hamming", PulseWindow::kHamming},
                                    {"cosine", PulseWindow::kCosine},
                                    {"taylor", PulseWindow::kTaylor}}};
}

/// Least product of duration and bandwidth with which a chirp's compressed pulse is as it is described below.
inline constexpr double kLeastCompression = 10;

/// The transmitted pulse and its processing in the receiver.
struct PulseSettings {
  PulseKind kind = PulseKind::kNone;  ///< Not kInstrument.
  double duration = 50e-6;            ///< Duration of the tone or the chirp [s], in (0, 1].
  double bandwidth = 200e3;           ///< Bandwidth of the chirp [Hz], in (0, 1e7]; times duration at least 10.
  bool matched_filter = true;         ///< CW: the receiver correlates with the tone; if false, it takes the envelope.
  PulseWindow window = PulseWindow::kRectangular;  ///< LFM: weights of the band; kRectangular has lobes of -13 dB.
  double side_lobe_db = -40;                       ///< LFM with kTaylor: side lobes re the peak [dB], -100..-15.

  /// @throws Error on the first field out of limits.
  void validate(std::string_view object = "pulse") const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"kind", "", {}, "none, cw (a tone) or lfm (a chirp)."}, self.kind);
    visit(Field{"duration", "s", above_to(0, 1), "Duration of the tone or the chirp."}, self.duration);
    visit(Field{"bandwidth", "Hz", above_to(0, 1e7), "Bandwidth of the chirp (lfm)."}, self.bandwidth);
    visit(Field{"matched_filter", "", {}, "The receiver correlates with the tone; else it takes its envelope (cw)."},
          self.matched_filter);
    visit(Field{"window", "", {}, "Weights of the band, for lower side lobes in range (lfm)."}, self.window);
    visit(Field{"side_lobe_db", "dB", from_to(-100, -15), "Side lobes of the window taylor re the peak (lfm)."},
          self.side_lobe_db);
  }
};

/// Doppler shift 2 v f / c of the echo of a target that approaches at `speed` v << c [Hz].
[[nodiscard]] double doppler_shift(double speed, double frequency, double sound_speed);

/// The range point-spread function p(dr): amplitude of a point echo at a range dr from its own. Real, even, 1 at 0.
///
///   none          1 over one bin
///   cw            1 over c tau / 2
///   cw, matched   a triangle, 1 - 2 |dr| / (c tau), of base c tau
///   lfm           sinc(2 B dr / c), or the transform of another window over the band, for |dr| <= c T / 2
///
/// On its edges a rectangle has half its power. The compressed chirp is the limit for B T >> 1; at B T = 100 the exact
/// main lobe is 0.2 % narrower. Van Trees, Optimum Array Processing (2002); Cook and Bernfeld, Radar Signals (1967).
class Pulse {
 public:
  /// @param sound_speed  Sound speed c with which the sonar converts time to range [m/s], > 0.
  /// @param bin_length   Length of the sonar's range bins [m], > 0; used by kNone only.
  /// @throws Error as PulseSettings::validate().
  Pulse(const PulseSettings& settings, double sound_speed, double bin_length);

  [[nodiscard]] double amplitude(double dr) const;  ///< @param dr  [m].
  [[nodiscard]] double intensity(double dr) const { return amplitude(dr) * amplitude(dr); }

  /// |dr| beyond which p is 0 [m].
  [[nodiscard]] double reach() const { return reach_; }

  /// Full width at half power [m].
  [[nodiscard]] double width() const;

  /// Highest side lobe [dB re the peak]; -infinity where there is none.
  [[nodiscard]] double side_lobe_db() const;

  /// Integral of |p|^2 over dr [m]: the equivalent length of range from which one bin receives an extended echo.
  [[nodiscard]] double equivalent_length() const;

  /// Bandwidth of white noise after the filter, whose gain for the pulse's peak is 1 [Hz]: 1 / duration for a matched
  /// filter, whatever the pulse (Turin, IRE Trans. IT-6, 311 (1960)); more with a window, by the integral of its square
  /// over the square of its integral. 0 for kNone, which has no filter.
  [[nodiscard]] double noise_bandwidth() const { return noise_bandwidth_; }

  /// Correlation of that noise between two ranges dr apart: the autocorrelation of the filter, 1 at 0. For a matched
  /// filter it is p(dr). Independent bins for kNone.
  /// @param dr  [m].
  [[nodiscard]] double noise_correlation(double dr) const;

  /// Range error of an echo with a Doppler shift f = `shift` [Hz], towards the sonar: f T c / (2 B) for a rising chirp,
  /// 0 for other pulses [m].
  [[nodiscard]] double doppler_bias(double shift) const { return shift * bias_per_hertz_; }

 private:
  enum class Shape { kRectangle, kTriangle, kChirp };
  Shape shape_ = Shape::kRectangle;
  double reach_ = 0;
  double cell_ = 0;                  // Range resolution c / (2 B) of a chirp [m].
  std::vector<WindowCosine> band_;   // Window over the chirp's band, of mean 1 ...
  std::vector<WindowCosine> power_;  // ... and its square, of mean 1.
  double bias_per_hertz_ = 0;
  double noise_bandwidth_ = 0;
};

}  // namespace insonify
