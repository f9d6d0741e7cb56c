// canvas.h -- draws on a picture: filled rectangles and anti-aliased lines and arcs.

#pragma once

#include <numbers>

#include "insonify/picture.h"

namespace insonify {

/// A position on a picture [pixels], right and down from its upper left corner: pixel (i, j) covers i..i+1 by j..j+1.
struct Point {
  double x = 0, y = 0;
};

/// Colour and opacity of a drawn shape.
struct Ink {
  Rgb colour{255, 255, 255};
  double alpha = 1;  ///< 0 (invisible) to 1 (opaque).
};

[[nodiscard]] Picture blank_picture(int width, int height, Rgb background);

/// Two pictures side by side, from their upper edges on.
/// @param background  Below the lower one.
[[nodiscard]] Picture pictures_beside(const Picture& left, const Picture& right, Rgb background);

inline void put(Picture& picture, int x, int y, Rgb colour) {
  std::uint8_t* pixel = picture.at(x, y);
  pixel[0] = colour.red;
  pixel[1] = colour.green;
  pixel[2] = colour.blue;
}

/// Blends ink over a share `coverage` (0..1) of one pixel. Pixels outside the picture are ignored.
void blend(Picture& picture, int x, int y, const Ink& ink, double coverage = 1);

void fill_rectangle(Picture& picture, Point upper_left, Point lower_right, const Ink& ink);

/// @param width  Width of the line [pixels].
void draw_line(Picture& picture, Point from, Point to, double width, const Ink& ink);

/// Part of a circle. Angles grow counterclockwise from the upward direction, as azimuths do in a fan that points up
/// [rad].
/// @param from, to  The ends, from <= to; a full circle where they are 2 pi apart or more.
void draw_arc(Picture& picture, Point centre, double radius, double from, double to, double width, const Ink& ink);

inline constexpr double kTwoPi = 2 * std::numbers::pi;  ///< [rad]

}  // namespace insonify
