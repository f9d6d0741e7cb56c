// array_pattern.h -- how a line array hears: its window, its faulty elements, its main lobe and its side lobes.

#pragma once

#include <complex>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

#include "insonify/field.h"

namespace insonify {

/// How the elements are weighted from the middle of the array to its ends: a wider main lobe buys lower side lobes.
enum class ArrayWindow { kRectangular, kHann, kHamming, kCosine, kTaylor, kDolphChebyshev };

/// A uniform line array, as built.
struct ArraySettings {
  ArrayWindow window = ArrayWindow::kRectangular;
  double side_lobe_db = -30;  ///< Side lobes re the main lobe, Taylor and Dolph-Chebyshev [dB], -100..-15.
  int nbar = 4;               ///< Taylor: side lobes before number nbar are level, 2..20.
  int elements = 0;           ///< Evenly spaced along the array, 0..1024; 0: one unbroken line.

  // Faults, one way, of an array of elements. Drawn once, as the instrument was built.
  double element_error_db = 0;             ///< Standard deviation of the elements' amplitudes [dB], 0..20.
  double element_error = 0;                ///< Standard deviation of their phases [rad], 0..180 deg.
  std::vector<double> dead_elements = {};  ///< That hear nothing, counted from 0 at the end furthest to port.
  double dead_share = 0;                   ///< Share of all elements that is dead besides, drawn, 0..0.9.

  /// The same array sends and receives: the pattern is squared. True for scanning heads and side-scan sonars; a
  /// forward-looking sonar sends with another, wide array.
  bool two_way = false;

  /// @throws Error on the first field out of limits or that asks for what the array cannot have.
  void validate(std::string_view object = "array") const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit);
};

/// What lies at one bearing. A line array cannot tell azimuth from elevation: its beams are cones around it. `kWedge`
/// gives every elevation the bearing of its azimuth instead, as the `paper` model has it.
enum class BeamShape { kWedge, kCone };

/// u, the sine of the bearing [-1..1]: sin(azimuth) in a wedge, sin(azimuth) cos(elevation) on a cone.
[[nodiscard]] double bearing_sine(BeamShape shape, double azimuth, double elevation);

/// One part of the weight along an unbroken line: share x cos(2 pi turns s), s from -1/2 to 1/2.
struct WindowCosine {
  double turns, share;
};

/// The complex amplitude g(x) with which an array steered to u0 hears a plane wave from u, where
/// x = (D / wavelength) (u - u0) and D is the array's length. Far field, or focused.
///
/// The perfect array has |g(0)| = 1; faults are measured against it. A line is the limit of many elements; an array of
/// N elements has a pattern of period N in x: those further than half a wavelength apart hear grating lobes.
/// Windows after Harris, Proc. IEEE 66(1), 51 (1978); Taylor, IRE Trans. AP-3, 16 (1955); Dolph, Proc. IRE 34, 335
/// (1946). Patterns after Van Trees, Optimum Array Processing (2002), chapters 2 and 3.
class ArrayPattern {
 public:
  /// @param seed  Of the faults. Equal seeds give equal arrays.
  /// @throws Error as ArraySettings::validate().
  explicit ArrayPattern(const ArraySettings& settings = {}, std::uint64_t seed = 1);

  /// g(x), two-way where the settings say so.
  [[nodiscard]] std::complex<double> amplitude(double x) const;
  [[nodiscard]] double intensity(double x) const { return std::norm(amplitude(x)); }  ///< |g(x)|^2.

  /// Without faults a pattern is real; the imaginary part of amplitude() is then 0.
  [[nodiscard]] bool is_real() const { return imaginary_.empty(); }

  /// Side lobe: where it is and how high.
  struct Lobe {
    double x = 0;         ///< [wavelength / D]
    double level_db = 0;  ///< Re the main lobe [dB]; -infinity where there is no side lobe.
  };

  // Of the array without its faults, two-way where the settings say so.
  [[nodiscard]] double width() const;            ///< Full width at half power [wavelength / D].
  [[nodiscard]] Lobe highest_side_lobe() const;  ///< On the side x > 0, up to 40 or half a period.
  [[nodiscard]] double equivalent_beam()
      const;  ///< Integral of |g|^2 over the main and all side lobes [wavelength / D].

  /// What the window leaves of the gain in signal to noise, one way, 1 for rectangular: (sum w)^2 / (N sum w^2).
  [[nodiscard]] double taper_efficiency() const;

  /// The length D of the array that has this one-way width at half power when it looks straight ahead [m].
  /// @param wavelength  [m], > 0.
  /// @param beam_width  Full width [rad], in (0, pi). Steered to u0 it becomes wider, about as 1 / cos of the bearing.
  [[nodiscard]] double length(double wavelength, double beam_width) const;

 private:
  [[nodiscard]] double perfect_one_way(double x) const;
  [[nodiscard]] double perfect_intensity(double x) const;
  void draw_faults(const ArraySettings& settings, std::uint64_t seed);

  std::vector<WindowCosine> line_;        // Of an unbroken line; empty for an array of elements.
  std::vector<double> weights_;           // Of the perfect elements, of sum 1; empty for a line.
  std::vector<double> real_, imaginary_;  // Of the faulty elements; empty without faults.
  bool two_way_ = false;
};

// ---------------------------------------------------------------------------------------------------------------------

template <typename Self, typename Visit>
void ArraySettings::visit_fields(Self& self, Visit&& visit) {
  visit(Field{"window", "", {}, "rectangular, hann, hamming, cosine, taylor or dolph_chebyshev."}, self.window);
  visit(Field{"side_lobe_db", "dB", from_to(-100, -15), "Side lobes re the main lobe (taylor, dolph_chebyshev)."},
        self.side_lobe_db);
  visit(Field{"nbar", "", from_to(2, 20), "Side lobes before this number are level (taylor)."}, self.nbar);
  visit(Field{"elements", "", from_to(0, 1024), "Evenly spaced along the array; 0 is an unbroken line."},
        self.elements);
  visit(Field{"element_error_db", "dB", from_to(0, 20), "Standard deviation of the elements' amplitudes."},
        self.element_error_db);
  visit(Field{"element_error", "rad", from_to(0, std::numbers::pi), "Standard deviation of the elements' phases."},
        self.element_error);
  visit(Field{"dead_elements", "", from_to(0, 1023), "Elements that hear nothing, counted from 0 at the port end."},
        self.dead_elements);
  visit(Field{"dead_share", "", from_to(0, 0.9), "Share of all elements that is dead besides, drawn by the seed."},
        self.dead_share);
  visit(Field{"two_way", "", {}, "The same array sends and receives: the pattern is squared."}, self.two_way);
}

}  // namespace insonify
