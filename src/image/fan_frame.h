// fan_frame.h -- layout of a fan on its picture, with range rings, radials and labels.

#pragma once

#include <string>
#include <vector>

#include "image/fan_geometry.h"
#include "image/page.h"

namespace insonify {

/// A text beside a fan.
struct FanLabel {
  Point middle;
  std::string text;
  double width = 0, height = 0;  ///< [pixels]
  bool over_echoes = false;
};

/// A line across the fan at one azimuth [rad].
struct Radial {
  double azimuth = 0;
  bool edge = false;
};

/// Rings and radials of a fan.
struct FanMarks {
  std::vector<double> rings;  ///< [m], rising; the last is max_range.
  std::vector<Radial> radials;
  Mounting mounting = Mounting::kHorizontal;
  bool mirrored = false;  ///< Whether azimuths are those of the sonar with the other sign.
};

/// Chooses rings and radials at round numbers.
/// @param low_edge, high_edge  Azimuths of the outermost radials, starboard and port [rad]; for a plain fan, the edges
///                             of the shape.
[[nodiscard]] FanMarks marks_of(const FanShape& shape, double low_edge, double high_edge, Mounting mounting);

/// A fan laid out on a page with its labels.
struct FanLayout {
  int width = 0, height = 0;  ///< [pixels]
  FanGeometry geometry;
  std::vector<FanLabel> labels;
};

/// Makes the fan as large as the page's height and the labels allow. Labels that would touch others are left out.
[[nodiscard]] FanLayout lay_out_fan(const FanShape& shape, const FanMarks& marks, Page& page, int height);

void draw_fan_frame(Picture& picture, const FanLayout& layout, const FanShape& shape, const FanMarks& marks,
                    const Page& page);

}  // namespace insonify
