// fan_frame.cpp -- places the labels of a fan without overlaps, and draws its rings, radials and labels.

#include "image/fan_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/colours.h"
#include "image/scales.h"

namespace insonify {
namespace {

constexpr double kFanLabelGap = 0.45;  // Gap between a fan and its labels [em].
constexpr double kWidestFan = 2;       // Greatest width of a fan, in heights of the picture.
constexpr double kLeastBar = 10;       // Height of the colour bar beside a flat sector [em].
// Aperture from which a fan has no room for labels at its edges.
constexpr double kOpenFan = radians_from_degrees(300);
// Aperture from which a fan is marked as a full circle.
constexpr double kNearlyWhole = radians_from_degrees(354);
// How far a label may slide to be clear of others, and in which steps [em].
constexpr double kFarthestSlide = 4;
constexpr double kSlide = 0.25;
// Azimuth at which rings of such open fans are labelled: between two radials.
constexpr double kRingLabelAzimuth = radians_from_degrees(-45);

struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
  void include(const Box& other) {
    left = std::min(left, other.left);
    top = std::min(top, other.top);
    right = std::max(right, other.right);
    bottom = std::max(bottom, other.bottom);
  }
  [[nodiscard]] bool touches(const Box& other, double gap) const {
    return left < other.right + gap && other.left < right + gap && top < other.bottom + gap && other.top < bottom + gap;
  }
};

Box box_of(const FanLabel& label) {
  return {label.middle.x - label.width / 2, label.middle.y - label.height / 2, label.middle.x + label.width / 2,
          label.middle.y + label.height / 2};
}

// Bounding box of the fan, with `pixels` for max_range and its apex at the origin.
Box box_of(const FanExtent& extent, double pixels) {
  return {extent.left * pixels, -extent.top * pixels, extent.right * pixels, -extent.bottom * pixels};
}

// Collects labels that do not touch earlier ones. The functions that place a label return whether it was accepted.
class LabelPlacer {
 public:
  explicit LabelPlacer(const Page& page) : page_(page) {}

  // Centres a text on a point.
  bool put(Point middle, const std::string& text, bool over_echoes) {
    const FanLabel label{middle, text, page_.lettering().width(text), page_.lettering().height(), over_echoes};
    const auto touches = [&](const FanLabel& other) { return box_of(other).touches(box_of(label), 0.5 * page_.em()); };
    const bool is_free = std::none_of(labels_.begin(), labels_.end(), touches);
    if (is_free) {
      labels_.push_back(label);
    }
    return is_free;
  }

  // Puts a text beside a point, clear of it in a direction given as a unit vector.
  bool put_beside(Point point, Point away, const std::string& text) {
    const double reach = kFanLabelGap * page_.em() + std::abs(away.x) * page_.lettering().width(text) / 2 +
                         std::abs(away.y) * page_.lettering().height() / 2;
    return put({point.x + reach * away.x, point.y + reach * away.y}, text, false);
  }

  // Calls put_at(slide [pixels]) with increasing offsets until the label is accepted.
  template <typename PutAt>
  void slide(PutAt&& put_at) const {
    for (double slide = 0; slide <= kFarthestSlide && !put_at(slide * page_.em()); slide += kSlide) {
    }
  }

  std::vector<FanLabel> take() { return std::move(labels_); }

 private:
  const Page& page_;
  std::vector<FanLabel> labels_;
};

// The most important labels first, because later ones give way to them: azimuth 0, edges, rings, other radials.
template <typename PutRadial, typename PutEdge, typename PutRing>
void put_in_order(const FanMarks& marks, const PutRadial& put_radial, const PutEdge& put_edge,
                  const PutRing& put_ring) {
  for (const Radial& radial : marks.radials) {
    if (!radial.edge && radial.azimuth == 0) {
      put_radial(radial);
    }
  }
  for (const Radial& radial : marks.radials) {
    if (radial.edge) {
      put_edge(radial);
    }
  }
  for (auto ring = marks.rings.rbegin(); ring != marks.rings.rend(); ++ring) {
    put_ring(*ring);
  }
  for (const Radial& radial : marks.radials) {
    if (!radial.edge && radial.azimuth != 0) {
      put_radial(radial);
    }
  }
}

std::vector<FanLabel> labels_of(const FanShape& shape, const FanMarks& marks, const FanGeometry& geometry,
                                const Page& page) {
  LabelPlacer placer(page);
  const auto put_beside_arc = [&](double azimuth, const std::string& text) {
    const double turn = azimuth - shape.up;
    return placer.put_beside(geometry.point_at(shape.max_range, azimuth), {-std::sin(turn), -std::cos(turn)}, text);
  };
  const auto text_of = [&](const Radial& radial) {
    return bearing_text(marks.mirrored ? -radial.azimuth : radial.azimuth, marks.mounting);
  };
  const auto label_radial = [&](const Radial& radial) { put_beside_arc(radial.azimuth, text_of(radial)); };
  // Labels of the edges slide outwards on a narrow fan; inwards on a wide one, whose edge labels would meet outside.
  const auto label_edge = [&](const Radial& radial) {
    const bool outwards = shape.aperture() < std::numbers::pi;
    const double sense = (radial.azimuth > shape.middle()) == outwards ? 1 : -1;
    const double radians_per_pixel = geometry.metres_per_pixel / shape.max_range;
    placer.slide([&](double slide) {
      return put_beside_arc(radial.azimuth + sense * slide * radians_per_pixel, text_of(radial));
    });
  };
  // Rings are labelled along the port edge. Labels of min_range and max_range, which no other ring implies, slide until
  // they are clear of the edge labels; others are left out where they touch a label.
  const auto label_ring = [&](double range) {
    const std::string text = number_text(range) + " m";
    if (shape.aperture() > kOpenFan) {
      placer.put(geometry.point_at(range, shape.up + kRingLabelAzimuth), text, true);
      return;
    }
    const double turn = shape.high - shape.up;
    const bool gives_way = range == shape.max_range || range == shape.min_range;
    placer.slide([&](double slide) {
      const Point point = geometry.point_at(range - slide * geometry.metres_per_pixel, shape.high);
      return placer.put_beside(point, {-std::cos(turn), std::sin(turn)}, text) || !gives_way;
    });
  };
  put_in_order(marks, label_radial, label_edge, label_ring);
  return placer.take();
}

// Finds the scale at which the fan and its labels together are as high as `room` [pixels]; the apex is at the origin.
FanLayout fit_height(const FanShape& shape, const FanMarks& marks, const Page& page, double room, Box& box) {
  const FanExtent extent = extent_of(shape);
  const double along = extent.top - extent.bottom;
  const double widest = kWidestFan * room / (extent.right - extent.left);
  FanLayout layout;
  double around = 0;  // Height that the labels add to the fan's.
  for (int pass = 0; pass < 3; ++pass) {
    const double pixels = std::max(1.0, std::min((room - around) / along, widest));
    layout.geometry = {{0, 0}, shape.max_range / pixels, shape.up};
    layout.labels = labels_of(shape, marks, layout.geometry, page);
    box = box_of(extent, pixels);
    for (const FanLabel& label : layout.labels) {
      box.include(box_of(label));
    }
    around = box.bottom - box.top - along * pixels;
  }
  return layout;
}

}  // namespace

FanMarks marks_of(const FanShape& shape, double low_edge, double high_edge, Mounting mounting) {
  FanMarks marks;
  marks.mounting = mounting;
  const double ring = ring_step(shape.max_range - shape.min_range);
  if (shape.min_range > 0.5 * ring) {
    marks.rings.push_back(shape.min_range);
  }
  for (const double range : multiples_within(ring, shape.max_range, ring)) {
    if (range > shape.min_range + 0.3 * ring && range < shape.max_range - 0.3 * ring) {
      marks.rings.push_back(range);
    }
  }
  marks.rings.push_back(shape.max_range);

  const double step = radial_step(high_edge - low_edge, mounting);
  const bool whole = high_edge - low_edge > kNearlyWhole;
  if (whole) {
    const double low = (low_edge + high_edge) / 2 - std::numbers::pi + 1e-6;  // Excludes one of two equal end radials.
    for (const double azimuth : multiples_within(low, low + 2 * std::numbers::pi, step)) {
      marks.radials.push_back({azimuth, false});
    }
  } else {
    const double clearance = 0.35 * step;
    for (const double azimuth : multiples_within(low_edge + clearance, high_edge - clearance, step)) {
      marks.radials.push_back({azimuth, false});
    }
    marks.radials.push_back({low_edge, true});
    marks.radials.push_back({high_edge, true});
  }
  return marks;
}

FanLayout lay_out_fan(const FanShape& shape, const FanMarks& marks, Page& page, int height) {
  FanLayout layout;
  Box box;
  double width = 0;
  const double beside = page.margin() + kBarGap * page.em() + page.bar_width();
  double top = 0;
  double room = 0;
  for (int pass = 0; pass < 2; ++pass) {  // The second pass is for a title that needs two lines at this width.
    top = page.title_height() + page.margin();
    room = height - page.margin() - top;
    layout = fit_height(shape, marks, page, room, box);
    width = box.right - box.left + beside;
    if (pass == 0) {
      page.fit_title(width);
    }
  }
  layout.height = height;
  layout.width = static_cast<int>(std::ceil(std::max(width, page.least_width())));
  const Point shift{page.margin() + (layout.width - width) / 2 - box.left,
                    top + (room - (box.bottom - box.top)) / 2 - box.top};
  layout.geometry.apex = shift;
  for (FanLabel& label : layout.labels) {
    label.middle = {label.middle.x + shift.x, label.middle.y + shift.y};
  }
  return layout;
}

void draw_fan_frame(Picture& picture, const FanLayout& layout, const FanShape& shape, const FanMarks& marks,
                    const Page& page) {
  const FanGeometry& geometry = layout.geometry;
  const double line = page.hairline();
  const double low = shape.low - shape.up;
  const double high = shape.high - shape.up;
  // Lines over echoes are light with a dark rim, so that they are visible on bright and on dark echoes.
  const auto draw_grid = [&](const auto& draw, bool outline) {
    draw(3 * line, palette::kGridRim);
    draw(line, outline ? palette::kOutline : palette::kGridLine);
  };
  for (const double range : marks.rings) {
    draw_grid(
        [&](double width, const Ink& ink) {
          draw_arc(picture, geometry.apex, range / geometry.metres_per_pixel, low, high, width, ink);
        },
        range == shape.max_range || range == shape.min_range);
  }
  // Inner radials do not start at the apex, where they would merge.
  const double start = std::max(shape.min_range, marks.rings.front() / 2);
  for (const Radial& radial : marks.radials) {
    draw_grid(
        [&](double width, const Ink& ink) {
          draw_line(picture, geometry.point_at(radial.edge ? shape.min_range : start, radial.azimuth),
                    geometry.point_at(shape.max_range, radial.azimuth), width, ink);
        },
        radial.edge);
  }
  if (shape.min_range / geometry.metres_per_pixel > 2) {
    draw_arc(picture, geometry.apex, shape.min_range / geometry.metres_per_pixel, low, high, line, palette::kOutline);
  }
  for (const FanLabel& label : layout.labels) {
    if (label.over_echoes) {
      page.lettering().draw_rimmed(picture, label.middle, label.text, palette::kGridText);
    } else {
      page.lettering().draw(picture, label.middle, label.text, palette::kText);
    }
  }
  const FanExtent extent = extent_of(shape);
  const double pixels = shape.max_range / geometry.metres_per_pixel;
  double top = geometry.apex.y - extent.top * pixels;
  double bottom = geometry.apex.y - extent.bottom * pixels;
  const double lacking = std::max(0.0, kLeastBar * page.em() - (bottom - top));
  top -= lacking / 2;
  bottom += lacking / 2;
  page.draw_bar(picture, top, bottom);
  page.draw_title(picture);
}

}  // namespace insonify
