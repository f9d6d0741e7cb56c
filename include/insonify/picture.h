// picture.h -- draws pings as RGB pictures: polar table, fan, and the view of a scanning sonar.

#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/engine.h"
#include "insonify/ping.h"
#include "insonify/settings_table.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// Pixels, three bytes each (red, green, blue), rows from the top.
struct Picture {
  int width = 0, height = 0;  ///< [pixels]
  std::vector<std::uint8_t> rgb;
  [[nodiscard]] std::uint8_t* at(int x, int y) { return &rgb[3 * (static_cast<std::size_t>(y) * width + x)]; }
  [[nodiscard]] const std::uint8_t* at(int x, int y) const {
    return &rgb[3 * (static_cast<std::size_t>(y) * width + x)];
  }
};

/// Grey pixels that are whole numbers, rows from the top.
struct NumberPicture {
  int width = 0, height = 0;  ///< [pixels]
  std::vector<std::uint16_t> numbers;
};

enum class ColourMap { kInferno, kCopper, kGrey, kBlue };
enum class Scale { kLinear, kDecibel };

/// How intensities are mapped to colours, and the size and annotations of the picture.
struct Display {
  ColourMap colour_map = ColourMap::kInferno;
  Scale scale = Scale::kLinear;
  double floor_db = -50;    ///< Darkest level on a decibel scale [dB re full scale], < 0.
  double full_scale = 1.0;  ///< Intensity drawn brightest, > 0.
  double raised_per_decade =
      0;                   ///< Gain that raised_by_range() applied to the pings [dB/decade], >= 0; for the caption.
  bool of_source = false;  ///< Intensities are relative to the source's at 1 m (calibrated model), and so are the
                           ///< levels on the colour bar.
  bool of_one = false;     ///< Decibels on the colour bar are re an intensity of 1, not re full_scale.
  bool of_counts = false;  ///< Intensities are counts, see counts_as_intensities(); for the colour bar.
  int height = 720;        ///< Height of the whole picture [pixels], 240..8192; the width follows from the fan's shape.
  bool annotations = true;     ///< Title, rings, radials, axes and colour bar.
  bool pixel_per_bin = false;  ///< Without annotations, instead of `height`: a pixel is as long as a bin, and in tables
                               ///< as wide as a beam, a step of the head or a ping.

  /// @throws Error on the first field out of limits.
  void validate() const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"floor_db", "dB", {.most = 0, .most_allowed = false}, "Darkest level on a decibel scale."},
          self.floor_db);
    visit(Field{"full_scale", "", greater_than(0), "Intensity drawn brightest."}, self.full_scale);
    visit(
        Field{"raised_per_decade", "dB", at_least(0), "By how much intensities were raised for every decade of range."},
        self.raised_per_decade);
    visit(Field{"of_source", "", {}, "Intensities, and levels on the colour bar, are relative to the source's at 1 m."},
          self.of_source);
    visit(Field{"of_one", "", {}, "Decibels on the colour bar are re an intensity of 1."}, self.of_one);
    visit(Field{"of_counts", "", {}, "Intensities are the counts of an instrument."}, self.of_counts);
    visit(Field{"height", "pixels", from_to(240, 8192), "Height of the whole picture."}, self.height);
    visit(Field{"annotations", "", {}, "Draw title, rings, radials, axes and colour bar."}, self.annotations);
    visit(Field{"pixel_per_bin", "", {}, "Without annotations: a pixel for each bin."}, self.pixel_per_bin);
  }
};

/// Level at which a display shows an intensity, from 0 (darkest) to 1 (brightest); 0 for NaN and for what is not
/// positive.
[[nodiscard]] inline double shown_level(const Display& display, double intensity) {
  const double ratio = intensity / display.full_scale;
  if (!(ratio > 0)) {
    return 0;
  }
  const double level = display.scale == Scale::kLinear ? ratio : 1 - 10 * std::log10(ratio) / display.floor_db;
  return level < 0 ? 0 : level > 1 ? 1 : level;
}

/// Colour of `value` in 0..1 (clamped; NaN is drawn as 0).
struct Rgb {
  std::uint8_t red, green, blue;
};
[[nodiscard]] Rgb colour(ColourMap map, double value);
/// @throws Error listing the known names.
[[nodiscard]] ColourMap colour_map_from_name(std::string_view name);

/// Gain over range with which pings of the calibrated model are shown: 30 dB per decade of range, which compensates the
/// fall of a flat floor's echo. They are shown on a decibel scale that ends at fitting_full_scale().
inline constexpr double kShownGainPerDecade = 30;

/// The default display of pings: linear in the paper model; decibels in the calibrated one, with a gain of
/// kShownGainPerDecade unless the receiver applies its own.
[[nodiscard]] Display usual_display(EchoModel model, const ReceiverConfig& receiver);

/// The ping with its intensities times r^(X/10), r in metres.
/// @param decibels_per_decade  X.
[[nodiscard]] Ping raised_by_range(Ping ping, const SonarConfig& sonar, double decibels_per_decade);

/// The display of an instrument's counts: linear, from 0 to the greatest, 2^bits - 1.
[[nodiscard]] Display counts_display(const SonarConfig& sonar);

/// The ping with its counts as its intensities, for a counts_display().
/// @throws Error if it has none, see ReceiverConfig::counts.
[[nodiscard]] Ping counts_as_intensities(Ping ping);

/// Full scale that fits a ping: the intensity that the strongest thousandth of all non-zero intensities exceeds, but at
/// most 25 dB below the strongest; rounded up to a multiple of 5 dB. 1 if all intensities are zero.
[[nodiscard]] double fitting_full_scale(std::vector<float> intensities);

/// The intensities of a ping for fitting its full scale: those of bins beyond the sonar's dead_range, which holds only
/// the transmit leak, far stronger than all echoes. All bins if none is beyond it.
[[nodiscard]] std::vector<float> intensities_to_fit(const Ping& ping, const SonarConfig& sonar);

// Azimuths are labelled as bearings: "30° P" to port, "30° S" to starboard; for a vertical mounting as slopes, "30° up"
// and "30° down". Drawing throws Error for a display out of limits and for a ping without the sonar's beams and
// bins. NaN is drawn as intensity 0.

/// The table of beams x bins: beams across (port to the left, azimuth in degrees), range upwards in metres.
[[nodiscard]] Picture draw_polar(const Ping& ping, const SonarConfig& sonar, const Display& display = {});

/// The fan as seen from above, acoustic axis up, port to the left: rings labelled in metres, radials in degrees.
/// Bilinear interpolation between beams and bins; apertures up to 360 degrees.
[[nodiscard]] Picture draw_fan(const Ping& ping, const SonarConfig& sonar, const Display& display = {});

/// Numbers of a ping's bins, such as its labels, in the pixels of draw_polar() and draw_fan() without annotations: that
/// of the bin in which the middle of a pixel lies, plus 1; 0 where there is no bin, or its number is kNoLabel.
/// @param numbers  As Ping::instance.
[[nodiscard]] NumberPicture draw_polar_numbers(const std::vector<std::uint16_t>& numbers, const SonarConfig& sonar,
                                               const Display& display = {});
[[nodiscard]] NumberPicture draw_fan_numbers(const std::vector<std::uint16_t>& numbers, const SonarConfig& sonar,
                                             const Display& display = {});

/// The view of a scanning sonar, which fills as the head turns. Each ping fills its own step of azimuth, later pings
/// cover earlier ones, and azimuths that have not been scanned yet stay blank. Where steps are longer than three beam
/// widths, a ping fills only the width of its beam, and gaps stay blank.
///
/// The housing's x axis points up and port is left, as in a fan. For a vertical mounting the view is from its starboard
/// side: up is up, and the x axis, its "front", points right.
class ScanView {
 public:
  /// @throws Error unless the sonar has a single beam and turns it.
  explicit ScanView(const SonarConfig& sonar);
  /// @throws Error for a ping of another shape than the sonar's, or without a head angle.
  void add(const Ping& ping);
  /// insonify::fitting_full_scale() of the intensities_to_fit() of all pings together.
  [[nodiscard]] double fitting_full_scale() const;
  /// The pings around the head, with a line at the present head angle.
  [[nodiscard]] Picture draw(const Display& display = {}) const;
  /// The pings side by side: head angle across (port to the left), range upwards.
  [[nodiscard]] Picture draw_polar(const Display& display = {}) const;
  /// As draw_fan_numbers() and draw_polar_numbers(), in the pixels of the above without annotations.
  /// @param numbers  Of all pings added.
  [[nodiscard]] NumberPicture draw_numbers(const std::vector<std::vector<std::uint16_t>>& numbers,
                                           const Display& display = {}) const;
  [[nodiscard]] NumberPicture draw_polar_numbers(const std::vector<std::vector<std::uint16_t>>& numbers,
                                                 const Display& display = {}) const;

 private:
  SonarConfig sonar_;
  double last_time_ = 0;
  std::vector<double> head_angles_;
  std::vector<std::vector<float>> profiles_;
};

class Waterfall;

/// The picture of a sonar's pings, by its product: the fan of the last ping, the ScanView of all, or the Waterfall of
/// the last 600.
class ProductView {
 public:
  /// @throws Error as ScanView does.
  explicit ProductView(const SonarConfig& sonar);
  ~ProductView();
  ProductView(ProductView&&) noexcept;
  ProductView& operator=(ProductView&&) noexcept;
  /// @throws Error as ScanView does.
  void add(const Ping& ping);
  /// insonify::fitting_full_scale() of what is shown.
  [[nodiscard]] double fitting_full_scale() const;
  [[nodiscard]] Picture draw(const Display& display = {}) const;

 private:
  SonarConfig sonar_;
  Ping last_;                             // The last ping, for sonars whose pings are images.
  std::optional<ScanView> scan_;          // The picture so far, for sonars whose pings are lines.
  std::unique_ptr<Waterfall> waterfall_;  // The last pings, for side-scan sonars.
};

}  // namespace insonify
