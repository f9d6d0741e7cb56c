// pulse.h -- how sharply a transmitted pulse tells ranges apart.

#pragma once

#include <string_view>
#include <vector>

#include "insonify/array_pattern.h"
#include "insonify/field.h"

namespace insonify {

/// None: echoes fall into bins as they come. CW: a tone. LFM: a chirp, compressed on receipt by its matched filter.
enum class PulseKind { kNone, kCw, kLfm };

/// The transmitted pulse and what the receiver makes of it.
struct PulseSettings {
  PulseKind kind = PulseKind::kNone;
  double duration = 50e-6;     ///< Of the tone or the chirp [s], in (0, 1].
  double bandwidth = 100e3;    ///< Of the chirp [Hz], in (0, 1e7]; times duration at least 10.
  bool matched_filter = true;  ///< CW: the receiver correlates with the tone; else it takes the bare envelope.
  bool hann = false;           ///< LFM: the receiver weights the band, for side lobes of -31 instead of -13 dB.

  /// @throws Error on the first field out of limits.
  void validate(std::string_view object = "pulse") const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"kind", "", {}, "none, cw (a tone) or lfm (a chirp)."}, self.kind);
    visit(Field{"duration", "s", above_to(0, 1), "Of the tone or the chirp."}, self.duration);
    visit(Field{"bandwidth", "Hz", above_to(0, 1e7), "Of the chirp (lfm)."}, self.bandwidth);
    visit(Field{"matched_filter", "", {}, "The receiver correlates with the tone; else it takes its envelope (cw)."},
          self.matched_filter);
    visit(Field{"hann", "", {}, "The receiver weights the band, for lower side lobes in range (lfm)."}, self.hann);
  }
};

/// Frequency shift of an echo of something that comes nearer at `speed` [Hz]; speeds far below that of sound.
[[nodiscard]] double doppler_shift(double speed, double frequency, double sound_speed);

/// The amplitude p(dr) that a point echo has at a range dr behind its own: real, even and 1 at 0.
///
///   none          1 over one bin
///   cw            1 over c tau / 2
///   cw, matched   a triangle, 1 - 2 |dr| / (c tau), of base c tau
///   lfm           sinc(2 B dr / c), or Hann's pattern, to |dr| = c T / 2 on either side
///
/// A rectangle has half the power on its edges. The compressed chirp is that of B T >> 1: at B T = 100 the exact one is
/// 0.2 % narrower. After Van Trees, Optimum Array Processing (2002), and Cook and Bernfeld, Radar Signals (1967).
class Pulse {
 public:
  /// @param sound_speed  By which the sonar turns time into range [m/s], > 0.
  /// @param bin_length   Of the sonar's range bins [m], > 0; matters to kind `none` alone.
  /// @throws Error as PulseSettings::validate().
  Pulse(const PulseSettings& settings, double sound_speed, double bin_length);

  [[nodiscard]] double amplitude(double dr) const;  ///< @param dr  [m].
  [[nodiscard]] double intensity(double dr) const { return amplitude(dr) * amplitude(dr); }

  /// |dr| beyond which p is 0 [m].
  [[nodiscard]] double reach() const { return reach_; }

  /// Full width at half power [m].
  [[nodiscard]] double width() const;

  /// Highest level beside the main lobe [dB re its peak]; -infinity where there is none.
  [[nodiscard]] double side_lobe_db() const;

  /// Integral of |p|^2 over dr: the length of range whose extended echo one bin hears at full level [m].
  [[nodiscard]] double equivalent_length() const;

  /// By how much an echo shifted up by `shift` [Hz] reads too near: f T c / (2 B) for a rising chirp, 0 for others [m].
  [[nodiscard]] double doppler_bias(double shift) const { return shift * bias_per_hertz_; }

 private:
  enum class Shape { kRectangle, kTriangle, kChirp };
  Shape shape_ = Shape::kRectangle;
  double reach_ = 0;
  double cell_ = 0;                 // c / (2 B), of a chirp.
  std::vector<WindowCosine> band_;  // Its weight over the band.
  double bias_per_hertz_ = 0;
};

}  // namespace insonify
