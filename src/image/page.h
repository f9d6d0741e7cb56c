// page.h -- the title and the colour bar that all pictures have.

#pragma once

#include <string>

#include "image/lettering.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// A title: the instrument, and what the picture shows.
struct Heading {
  std::string name;     ///< "Tritech Gemini 720i"
  std::string details;  ///< "720 kHz   20 m   ping 3   t = 0.20 s"
};
/// The instrument's model, followed by the sonar's name if it has one.
[[nodiscard]] std::string name_of(const SonarConfig& sonar);

/// @param what  "ping 3", "400 pings"
/// @param time  Time of the last transmission [s].
[[nodiscard]] Heading heading_of(const SonarConfig& sonar, const std::string& what, double time);

/// Title, colour bar and margins of a picture, in sizes proportional to its height. All lengths are in pixels.
class Page {
 public:
  Page(const Display& display, Heading heading);

  [[nodiscard]] const Lettering& lettering() const { return lettering_; }
  /// Size of the letters, the unit of all other sizes.
  [[nodiscard]] double em() const { return lettering_.size(); }
  /// Width of a thin line.
  [[nodiscard]] double hairline() const;
  /// Width left free along all borders.
  [[nodiscard]] double margin() const { return 0.8 * em(); }

  /// Fits the title into `width`: on one line, or else on two.
  void fit_title(double width);
  /// Least width of a picture into which the title fits.
  [[nodiscard]] double least_width() const;
  /// Height from the upper border to the end of the title.
  [[nodiscard]] double title_height() const;
  void draw_title(Picture& picture) const;

  /// Width from the left side of the colour bar to the right border.
  [[nodiscard]] double bar_width() const;
  void draw_bar(Picture& picture, double top, double bottom) const;

  struct Tick {
    double level;  ///< 0 at the lower end of the bar, 1 at the upper.
    std::string text;
  };
  /// Ticks at round numbers, which divide the bar into at most `most_parts` parts.
  [[nodiscard]] std::vector<Tick> bar_ticks(int most_parts) const;
  [[nodiscard]] std::string bar_caption() const;

 private:
  Display display_;
  Lettering lettering_;
  Heading heading_;
  bool two_lines_ = false;
};

}  // namespace insonify
