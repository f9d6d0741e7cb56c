// canvas.cpp -- anti-aliased rectangles, lines and arcs, by the coverage of pixels.
//
// Ours, since the libraries do not make it shorter: filling outlines by FreeType's rasteriser takes more lines, and
// Cairo would load 14 more shared libraries, X11's among them, into a program that runs on robots. See
// docs/design/libraries.md.

#include "image/canvas.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

double clamp01(double value) {
  return std::clamp(value, 0.0, 1.0);
}

// Share of a pixel inside a shape whose border is `inside` pixels from the pixel's middle (negative outside): exact for
// borders along the pixel grid, approximate for others.
double coverage_at(double inside) {
  return clamp01(inside + 0.5);
}

// Share of the interval i..i+1 that low..high covers.
double overlap(int i, double low, double high) {
  return clamp01(std::min(high, i + 1.0) - std::max(low, i * 1.0));
}

// A stroke thinner than a pixel is drawn one pixel wide and paler.
struct Stroke {
  double half, alpha;
  explicit Stroke(double width) : half(std::max(width, 1.0) / 2), alpha(std::min(width, 1.0)) {}
};

}  // namespace

Picture blank_picture(int width, int height, Rgb background) {
  Picture picture{width, height, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * height)};
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    picture.rgb[i] = background.red;
    picture.rgb[i + 1] = background.green;
    picture.rgb[i + 2] = background.blue;
  }
  return picture;
}

Picture pictures_beside(const Picture& left, const Picture& right, Rgb background) {
  Picture both = blank_picture(left.width + right.width, std::max(left.height, right.height), background);
  for (const auto& [picture, at] : {std::pair(&left, 0), {&right, left.width}}) {
    for (int y = 0; y < picture->height; ++y) {
      std::copy_n(picture->at(0, y), 3 * static_cast<std::size_t>(picture->width), both.at(at, y));
    }
  }
  return both;
}

void blend(Picture& picture, int x, int y, const Ink& ink, double coverage) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) {
    return;
  }
  const double share = ink.alpha * coverage;
  const auto mix = [share](std::uint8_t& below, std::uint8_t above) {
    below = static_cast<std::uint8_t>(std::lround(below + share * (above - below)));
  };
  std::uint8_t* pixel = picture.at(x, y);
  mix(pixel[0], ink.colour.red);
  mix(pixel[1], ink.colour.green);
  mix(pixel[2], ink.colour.blue);
}

void fill_rectangle(Picture& picture, Point upper_left, Point lower_right, const Ink& ink) {
  const int last_x = static_cast<int>(std::ceil(lower_right.x));
  const int last_y = static_cast<int>(std::ceil(lower_right.y));
  for (int y = static_cast<int>(std::floor(upper_left.y)); y < last_y; ++y) {
    for (int x = static_cast<int>(std::floor(upper_left.x)); x < last_x; ++x) {
      blend(picture, x, y, ink, overlap(x, upper_left.x, lower_right.x) * overlap(y, upper_left.y, lower_right.y));
    }
  }
}

void draw_line(Picture& picture, Point from, Point to, double width, const Ink& ink) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (length == 0) {
    return;
  }
  const double along_x = (to.x - from.x) / length;
  const double along_y = (to.y - from.y) / length;
  const Stroke stroke(width);
  // Step along the axis to which the line is closer; at each step visit the few pixels across it that the stroke can
  // touch.
  const bool steep = std::abs(along_y) > std::abs(along_x);
  const double start = steep ? from.y : from.x;
  const double stop = steep ? to.y : to.x;
  const double slope = steep ? along_x / along_y : along_y / along_x;
  const double reach = (stroke.half + 1) * std::hypot(1, slope);
  const int limit = steep ? picture.height : picture.width;
  const int first = std::max(0, static_cast<int>(std::floor(std::min(start, stop) - stroke.half - 1)));
  const int last = std::min(limit - 1, static_cast<int>(std::ceil(std::max(start, stop) + stroke.half + 1)));
  for (int i = first; i <= last; ++i) {
    const double middle = (steep ? from.x : from.y) + (i + 0.5 - start) * slope;
    for (int j = static_cast<int>(std::floor(middle - reach)); j <= static_cast<int>(std::ceil(middle + reach)); ++j) {
      const int x = steep ? j : i;
      const int y = steep ? i : j;
      const double dx = x + 0.5 - from.x;
      const double dy = y + 0.5 - from.y;
      const double along = dx * along_x + dy * along_y;
      const double across = std::abs(dx * along_y - dy * along_x);
      blend(picture, x, y, ink,
            stroke.alpha * coverage_at(stroke.half - across) * coverage_at(along) * coverage_at(length - along));
    }
  }
}

void draw_arc(Picture& picture, Point centre, double radius, double from, double to, double width, const Ink& ink) {
  const Stroke stroke(width);
  const double outer = radius + stroke.half + 0.5;
  const double inner = radius - stroke.half - 0.5;
  const bool whole = to - from >= kTwoPi;
  const auto plot = [&](int x, int y) {
    const double dx = x + 0.5 - centre.x;
    const double dy = y + 0.5 - centre.y;
    const double turn = std::atan2(-dx, -dy) - from;
    if (whole || turn - kTwoPi * std::floor(turn / kTwoPi) <= to - from) {
      blend(picture, x, y, ink, stroke.alpha * coverage_at(stroke.half - std::abs(std::hypot(dx, dy) - radius)));
    }
  };
  const int first = std::max(0, static_cast<int>(std::floor(centre.y - outer)));
  const int last = std::min(picture.height - 1, static_cast<int>(std::ceil(centre.y + outer)));
  for (int y = first; y <= last; ++y) {
    const double dy = y + 0.5 - centre.y;
    if (std::abs(dy) >= outer) {
      continue;
    }
    // In this row of pixels the ring lies between an inner and an outer half-chord on either side of the centre.
    const double far = std::sqrt(outer * outer - dy * dy);
    const double near = std::abs(dy) < inner ? std::sqrt(inner * inner - dy * dy) : 0;
    const int left = static_cast<int>(std::floor(centre.x - far));
    const int left_end = static_cast<int>(std::ceil(centre.x - near));
    const int right = std::max(left_end + 1, static_cast<int>(std::floor(centre.x + near)));
    const int right_end = static_cast<int>(std::ceil(centre.x + far));
    for (int x = std::max(0, left); x <= std::min(picture.width - 1, left_end); ++x) {
      plot(x, y);
    }
    for (int x = std::max(0, right); x <= std::min(picture.width - 1, right_end); ++x) {
      plot(x, y);
    }
  }
}

}  // namespace insonify
