// array_pattern.h -- beam pattern of a line array: window, element faults, main lobe and side lobes.

#pragma once

#include <complex>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

#include "insonify/settings_table.h"
#include "insonify/words.h"

namespace insonify {

/// Weights of the elements along the array (its taper). Lower side lobes come with a wider main lobe.
enum class ArrayWindow { kRectangular, kHann, kHamming, kCosine, kTaylor, kDolphChebyshev };
template <>
constexpr auto words_of<ArrayWindow>() {
  return EnumWords<ArrayWindow, 6>{{{"rectangular", ArrayWindow::kRectangular},
                                    {"hann", ArrayWindow::kHann},
                                    {"hamming", ArrayWindow::kHamming},
                                    {"cosine", ArrayWindow::kCosine},
                                    {"taylor", ArrayWindow::kTaylor},
                                    {"dolph_chebyshev", ArrayWindow::kDolphChebyshev}}};
}

/// A line array of equally spaced elements, or a continuous line, with the faults of one built instrument.
struct ArraySettings {
  ArrayWindow window = ArrayWindow::kRectangular;
  double side_lobe_db = -30;  ///< Side lobes re the main lobe, Taylor and Dolph-Chebyshev [dB], -100..-15.
  int nbar = 0;               ///< Taylor: side lobes before number nbar are level, 2..40; 0: 4, or as many as
                              ///< side_lobe_db needs.
  int elements = 0;           ///< Number of elements, evenly spaced, 0..1024; 0: a continuous line.

  // Faults of the elements, one way. Random ones are drawn once per instrument, not per ping.
  double element_error_db = 0;          ///< Standard deviation of the elements' amplitudes [dB], 0..20.
  double element_error = 0;             ///< Standard deviation of their phases [rad], 0..180 deg.
  std::vector<int> dead_elements = {};  ///< Indices of elements that receive nothing, from 0 at the port end.
  double dead_share = 0;                ///< Share of all elements that are dead besides, drawn at random, 0..0.9.

  /// The same array sends and receives: the pattern is squared. True for scanning heads and side-scan sonars; a
  /// forward-looking sonar sends with another, wide array.
  bool two_way = false;

  /// @throws Error on the first field that is out of limits or does not go with another, such as faults of the elements
  ///         of a continuous line.
  void validate(std::string_view object = "array") const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit);
};

/// Which directions have the same bearing. A line array cannot separate azimuth from elevation: its beams are cones
/// around its axis (kCone). kWedge is the simplification of the `paper` model: the bearing is the azimuth, at every
/// elevation.
enum class BeamShape { kWedge, kCone };
template <>
constexpr auto words_of<BeamShape>() {
  return EnumWords<BeamShape, 2>{{{"wedge", BeamShape::kWedge}, {"cone", BeamShape::kCone}}};
}

/// u, the sine of the bearing, -1..1: sin(azimuth) for wedges, sin(azimuth) cos(elevation) for cones.
[[nodiscard]] double bearing_sine(BeamShape shape, double azimuth, double elevation);

/// One cosine term of the window of a continuous line: share x cos(2 pi turns s), with s from -1/2 to 1/2 along it.
struct WindowCosine {
  double turns, share;
};

/// Beam pattern: the complex amplitude gain g(x) of an array steered to u0 for a plane wave from u, where x = (D /
/// wavelength) (u - u0) and D is the array's length. For the far field, or an array focused at the range; see
/// defocused().
///
/// The array without faults has |g(0)| = 1; with faults g is relative to that. The pattern of N elements has the period
/// N in x, so elements more than half a wavelength apart give grating lobes within the fan. Windows: Harris, Proc. IEEE
/// 66(1), 51 (1978); Taylor, IRE Trans. AP-3, 16 (1955); Dolph, Proc. IRE 34, 335 (1946). Patterns: Van Trees, Optimum
/// Array Processing (2002), chapters 2 and 3.
class ArrayPattern {
 public:
  /// @param seed  Seed of the random faults. Equal seeds give equal arrays.
  /// @throws Error as ArraySettings::validate().
  explicit ArrayPattern(const ArraySettings& settings = {}, std::uint64_t seed = 1);

  /// g(x); g(x)^2 with ArraySettings::two_way. Its phase grows with the distance from the source.
  [[nodiscard]] std::complex<double> amplitude(double x) const;
  [[nodiscard]] double intensity(double x) const { return std::norm(amplitude(x)); }  ///< |g(x)|^2.

  /// Pattern d(x) of the difference of the halves of the array, without faults and in focus: twice the port half
  /// receives g - i d, twice the starboard half g + i d. The phase of starboard re port is 2 atan(d / g), pi x for a
  /// rectangular window (Lurton, An Introduction to Underwater Acoustics (2010), section 8.2.4).
  [[nodiscard]] double difference(double x) const;

  /// The pattern of the defocused array: each element's signal has the phase `edge_phase` (2 s)^2, s from -1/2 to
  /// 1/2 along the array. A point at the range r in the bearing a, received by an array focused at f, has the edge
  /// phase pi D^2 cos^2(a) / (4 wavelength) (1/r - 1/f) (Goodman, Introduction to Fourier Optics (2005), section 6.4).
  /// Exact up to kExactReach + 4 |edge_phase| in x; beyond, the side lobes are those in focus.
  /// @param edge_phase  [rad]; 0: in focus.
  [[nodiscard]] ArrayPattern defocused(double edge_phase) const;
  static constexpr double kExactReach = 8;

  /// In focus and without faults a pattern is real; the imaginary part of amplitude() is then 0.
  [[nodiscard]] bool is_real() const { return imaginary_.empty() && defocused_.empty(); }

  [[nodiscard]] bool is_two_way() const { return two_way_; }  ///< ArraySettings::two_way.

  /// A side lobe.
  struct Lobe {
    double x = 0;         ///< Distance from the main lobe in u [wavelength / D].
    double level_db = 0;  ///< Re the main lobe [dB]; -infinity where there is no side lobe.
  };

  // Properties of the array in focus without faults; of g(x)^2 with ArraySettings::two_way.
  [[nodiscard]] double width() const;            ///< Full width at half power [wavelength / D].
  [[nodiscard]] Lobe highest_side_lobe() const;  ///< Among those at 0 < x <= 40, or within half a period.
  [[nodiscard]] double equivalent_beam()
      const;  ///< Integral of |g|^2 over the main and all side lobes [wavelength / D].

  /// Array gain in signal to noise relative to a rectangular window, one way: (sum w)^2 / (N sum w^2), 0..1.
  [[nodiscard]] double taper_efficiency() const;

  /// Length D of the array whose unsteered beam has this one-way width at half power [m].
  /// @param wavelength  [m], > 0.
  /// @param beam_width  Full width [rad], in (0, pi). A steered beam is wider, by about 1 / cos of the bearing.
  [[nodiscard]] double length(double wavelength, double beam_width) const;

 private:
  [[nodiscard]] double perfect_one_way(double x) const;
  [[nodiscard]] double perfect_intensity(double x) const;
  [[nodiscard]] std::complex<double> focused_one_way(double x) const;
  [[nodiscard]] std::complex<double> defocused_one_way(double x) const;
  void draw_faults(const ArraySettings& settings, std::uint64_t seed);

  std::vector<WindowCosine> line_;               // Window of a continuous line; empty for an array of elements.
  std::vector<double> weights_;                  // Weights of the elements without faults, sum 1; empty for a line.
  std::vector<double> real_, imaginary_;         // Complex weights of the elements with faults; empty without faults.
  std::vector<std::complex<double>> defocused_;  // [element or part of a line] Weights out of focus; empty in focus.
  double edge_phase_ = 0;
  bool two_way_ = false;
};

// ---------------------------------------------------------------------------------------------------------------------

template <typename Self, typename Visit>
void ArraySettings::visit_fields(Self& self, Visit&& visit) {
  visit(Field{"window", "", {}, "rectangular, hann, hamming, cosine, taylor or dolph_chebyshev."}, self.window);
  visit(Field{"side_lobe_db", "dB", from_to(-100, -15), "Side lobes re the main lobe (taylor, dolph_chebyshev)."},
        self.side_lobe_db);
  visit(
      Field{"nbar", "", from_to(0, 40), "Side lobes before this number are level (taylor); 0: as side_lobe_db needs."},
      self.nbar);
  visit(Field{"elements", "", from_to(0, 1024), "Elements evenly spaced along the array; 0 is a continuous line."},
        self.elements);
  visit(Field{"element_error_db", "dB", from_to(0, 20), "Standard deviation of the elements' amplitudes."},
        self.element_error_db);
  visit(Field{"element_error", "rad", from_to(0, std::numbers::pi), "Standard deviation of the elements' phases."},
        self.element_error);
  visit(Field{"dead_elements", "", from_to(0, 1023), "Elements that receive nothing, counted from 0 at the port end."},
        self.dead_elements);
  visit(Field{"dead_share", "", from_to(0, 0.9), "Share of all elements that are dead besides, drawn by the seed."},
        self.dead_share);
  visit(Field{"two_way", "", {}, "The same array sends and receives: the pattern is squared."}, self.two_way);
}

}  // namespace insonify
