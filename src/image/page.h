// page.h -- what all pictures have around their echoes: a title above and a colour bar at the right.

#pragma once

#include <string>

#include "image/lettering.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// A title: who looked, and at what.
struct Heading {
  std::string name;     ///< "Tritech Gemini 720i"
  std::string details;  ///< "720 kHz   20 m   ping 3   t = 0.20 s"
};
/// The instrument, and which of them where it was given a name.
[[nodiscard]] std::string name_of(const SonarConfig& sonar);

/// @param what  "ping 3", "400 pings"
/// @param time  Of the last transmission [s].
[[nodiscard]] Heading heading_of(const SonarConfig& sonar, const std::string& what, double time);

/// The furniture of a picture, in sizes that follow from the picture's height. All lengths are in pixels.
class Page {
 public:
  Page(const Display& display, Heading heading);

  [[nodiscard]] const Lettering& lettering() const { return lettering_; }
  /// The size of the letters, by which everything else is measured.
  [[nodiscard]] double em() const { return lettering_.size(); }
  /// Width of a thin line.
  [[nodiscard]] double hairline() const;
  /// Left free along all borders.
  [[nodiscard]] double margin() const { return 0.8 * em(); }

  /// Fits the title into `width`: on one line, else on two, cut short if need be.
  void fit_title(double width);
  /// The least width of a picture that its title fits into.
  [[nodiscard]] double least_width() const;
  /// From the upper border to the end of the title.
  [[nodiscard]] double title_height() const;
  void draw_title(Picture& picture) const;

  /// From the left side of the colour bar to the right border.
  [[nodiscard]] double bar_width() const;
  void draw_bar(Picture& picture, double top, double bottom) const;

  struct Tick {
    double level;  ///< 0 at the lower end of the bar, 1 at the upper.
    std::string text;
  };
  /// At round numbers.
  [[nodiscard]] std::vector<Tick> bar_ticks(int most_parts) const;
  [[nodiscard]] std::string bar_caption() const;

 private:
  Display display_;
  Lettering lettering_;
  Heading heading_;
  bool two_lines_ = false;
};

}  // namespace insonify
