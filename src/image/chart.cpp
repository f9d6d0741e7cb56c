// chart.cpp -- draws what all charts have.

#include "image/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "image/scales.h"

namespace insonify {
namespace {

constexpr Ink kChartRim{{0, 0, 0}, 0.55};
constexpr double kLeastValueRange = 1e-3;  // [m]

Rgb lit_colour(Rgb colour, double light) {
  const auto part = [&](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::clamp(value * light, 0.0, 255.0));
  };
  return {part(colour.red), part(colour.green), part(colour.blue)};
}

}  // namespace

double ChartCells::at(int column, int row) const {
  return static_cast<double>(
      values[static_cast<std::size_t>(std::clamp(row, 0, rows - 1)) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(std::clamp(column, 0, columns - 1))]);
}

double ChartCells::at(const ChartPlace& place) const {
  return at(static_cast<int>((place.x() - low.x()) / (high.x() - low.x()) * columns),
            static_cast<int>((high.y() - place.y()) / (high.y() - low.y()) * rows));
}

double ValueRange::size() const {
  return std::max(high - low, kLeastValueRange);
}

ValueRange range_of(std::span<const float> values) {
  ValueRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const float value : values) {
    if (std::isfinite(value)) {
      range = {std::min(range.low, static_cast<double>(value)), std::max(range.high, static_cast<double>(value))};
    }
  }
  return range;
}

ValueRange usual_range_of(std::span<const float> values) {
  constexpr double kBeyond = 0.001;  // Share of values below the range, and above it.
  std::vector<float> known;
  std::ranges::copy_if(values, std::back_inserter(known), [](float value) { return std::isfinite(value); });
  if (known.empty()) {
    return range_of(known);
  }
  const auto beyond = static_cast<std::ptrdiff_t>(kBeyond * static_cast<double>(known.size()));
  std::ranges::nth_element(known, known.begin() + beyond);
  const auto low = static_cast<double>(known[static_cast<std::size_t>(beyond)]);
  std::ranges::nth_element(known, known.end() - 1 - beyond);
  return {low, static_cast<double>(*(known.end() - 1 - beyond))};
}

Rgb mixed_colour(std::span<const Rgb> colours, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), colours.size() - 2);
  const double within = place - static_cast<double>(below);
  const auto mixed = [&](std::uint8_t Rgb::*part) {
    return static_cast<std::uint8_t>(
        std::lround((1 - within) * colours[below].*part + within * colours[below + 1].*part));
  };
  return {mixed(&Rgb::red), mixed(&Rgb::green), mixed(&Rgb::blue)};
}

Rgb depth_colour(double share) {
  static constexpr std::array<Rgb, 5> kDepthColours = {Rgb{24, 32, 92}, Rgb{30, 84, 150}, Rgb{52, 142, 176},
                                                       Rgb{122, 190, 178}, Rgb{214, 216, 164}};
  return mixed_colour(kDepthColours, share);
}

Chart::Chart(const ChartPlace& low, const ChartPlace& high, int height, std::string title, std::string details)
    : low_(low),
      high_(high),
      title_(std::move(title)),
      details_(std::move(details)),
      letters_(std::max(10, height / 55)) {
  const double em = letters_.size();
  const ChartPlace size = high - low;
  const double left = 5.2 * em, right = 8 * em, top = 4.6 * em, bottom = 3.6 * em;
  scale_ = std::min((height - top - bottom) / size.y(), (1.7 * height - left - right) / size.x());
  left_ = left;
  width_ = scale_ * size.x();
  height_ = scale_ * size.y();
  const double least = std::max(letters_.width(title_), letters_.width(details_)) + 3 * em;  // The titles must fit.
  left_ += std::max(0.0, 0.5 * (least - left - right - width_));
  top_ = top;
  picture_ = blank_picture(static_cast<int>(std::lround(std::max(least, left + right + width_))),
                           static_cast<int>(std::lround(top + height_ + bottom)), palette::kBackground);
}

double Chart::hairline() const {
  return std::max(1.0, letters_.size() / 14.0);
}

Point Chart::at(const ChartPlace& place) const {
  return {left_ + scale_ * (place.x() - low_.x()), top_ + scale_ * (high_.y() - place.y())};
}

ChartPlace Chart::place_of(double x, double y) const {
  return {low_.x() + (x - left_) / scale_, high_.y() - (y - top_) / scale_};
}

void Chart::draw_relief(const ChartCells& heights, const ValueRange& range) {
  const double cell = (heights.high.x() - heights.low.x()) / heights.columns;
  const double raised = std::clamp(0.12 * (heights.high - heights.low).maxCoeff() / range.size(), 1.0, 8.0);
  const Vec3 light = Vec3(-1, 1, 1.4).normalized();
  for_pixels([&](int x, int y, const ChartPlace& place) {
    const int column = static_cast<int>((place.x() - heights.low.x()) / cell);
    const int row = static_cast<int>((heights.high.y() - place.y()) / cell);
    const double here = heights.at(column, row);
    if (!std::isfinite(here)) {
      put(picture_, x, y, palette::kNotYetSeen);
      return;
    }
    const auto slope = [&](double after, double before) {
      return std::isfinite(after) && std::isfinite(before) ? raised * (after - before) / (2 * cell) : 0.0;
    };
    const Vec3 normal = Vec3(-slope(heights.at(column + 1, row), heights.at(column - 1, row)),
                             -slope(heights.at(column, row - 1), heights.at(column, row + 1)), 1)
                            .normalized();
    const double lit = std::max(0.0, normal.dot(light)) / light.z();
    put(picture_, x, y, lit_colour(depth_colour((here - range.low) / range.size()), 0.25 + 0.6 * lit));
  });
}

void Chart::draw_axes(const std::string& x_caption, const std::string& y_caption) {
  const double em = letters_.size(), bottom = top_ + height_, right = left_ + width_;
  for (const auto& [from, to] :
       {std::pair(Point{left_, top_}, Point{right, top_}), std::pair(Point{right, top_}, Point{right, bottom}),
        std::pair(Point{right, bottom}, Point{left_, bottom}), std::pair(Point{left_, bottom}, Point{left_, top_})}) {
    draw_line(picture_, from, to, hairline(), palette::kOutline);
  }
  const double step = nice_step((high_ - low_).maxCoeff(), 8), tick = kTickLength * em;
  for (const double x : multiples_within(low_.x(), high_.x(), step)) {
    const Point foot = at({x, low_.y()});
    draw_line(picture_, foot, {foot.x, foot.y + tick}, hairline(), palette::kText);
    letters_.draw(picture_, {foot.x, bottom + tick + 0.8 * em}, number_text(x), palette::kText);
  }
  for (const double y : multiples_within(low_.y(), high_.y(), step)) {
    const Point foot = at({low_.x(), y});
    draw_line(picture_, foot, {foot.x - tick, foot.y}, hairline(), palette::kText);
    letters_.draw(picture_, {left_ - tick - kTextGap * em, foot.y}, number_text(y), palette::kText, Anchor::kEnd);
  }
  letters_.draw(picture_, {left_ + 0.5 * width_, bottom + 2.6 * em}, x_caption, palette::kText);
  letters_.draw_upwards(picture_, {left_ - 4.2 * em, top_ + 0.5 * height_}, y_caption, palette::kText);
}

void Chart::draw_bar(const ValueRange& range, const std::function<Rgb(double)>& colour, const std::string& caption,
                     int sign) {
  if (range.empty()) {
    return;
  }
  const double em = letters_.size(), x = left_ + width_ + 1.4 * em, bar = 1.1 * em;
  for (int y = 0; y < static_cast<int>(height_); ++y) {
    const Rgb filled = lit_colour(colour(1 - (y + 0.5) / height_), 0.85);
    fill_rectangle(picture_, {x, top_ + y}, {x + bar, top_ + y + 1}, {filled, 1});
  }
  const auto [least, most] = std::minmax({sign * range.low, sign * range.high});
  for (const double value : multiples_within(least, most, nice_step(range.size(), 8))) {
    const double y = top_ + height_ * (1 - (sign * value - range.low) / range.size());
    draw_line(picture_, {x + bar, y}, {x + bar + kTickLength * em, y}, hairline(), palette::kText);
    letters_.draw(picture_, {x + bar + 0.7 * em, y}, number_text(value), palette::kText, Anchor::kStart);
  }
  letters_.draw_upwards(picture_, {x + bar + 4.4 * em, top_ + 0.5 * height_}, caption, palette::kText);
}

void Chart::draw_scale_and_north() {
  const double em = letters_.size(), length = nice_step((high_ - low_).x(), 4);
  const Point end{left_ + width_ - em, top_ + height_ - 1.2 * em}, begin{end.x - scale_ * length, end.y};
  for (const auto& [ink, width] : {std::pair(kChartRim, 5.0), std::pair(palette::kTitle, 2.5)}) {
    draw_line(picture_, begin, end, width * hairline(), ink);
    for (const Point& foot : {begin, end}) {
      draw_line(picture_, {foot.x, foot.y - 0.3 * em}, {foot.x, foot.y + 0.3 * em}, 0.7 * width * hairline(), ink);
    }
  }
  letters_.draw_rimmed(picture_, {0.5 * (begin.x + end.x), end.y - em}, number_text(length) + " m", palette::kTitle);
  const Point foot{left_ + width_ - 1.8 * em, top_ + 4 * em}, tip{foot.x, foot.y - 2.2 * em};
  for (const auto& [ink, width] : {std::pair(kChartRim, 4.0), std::pair(palette::kTitle, 2.0)}) {
    draw_line(picture_, foot, tip, width * hairline(), ink);
    draw_line(picture_, tip, {tip.x - 0.4 * em, tip.y + 0.8 * em}, width * hairline(), ink);
    draw_line(picture_, tip, {tip.x + 0.4 * em, tip.y + 0.8 * em}, width * hairline(), ink);
  }
  letters_.draw_rimmed(picture_, {tip.x, tip.y - 0.8 * em}, "N", palette::kTitle);
}

void Chart::draw_titles() {
  const double em = letters_.size();
  letters_.draw(picture_, {left_, 1.5 * em}, title_, palette::kTitle, Anchor::kStart);
  letters_.draw(picture_, {left_, 3.2 * em}, details_, palette::kText, Anchor::kStart);
}

}  // namespace insonify
