// page.cpp -- lays out and draws the title and the colour bar of a picture.

#include "image/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/colours.h"
#include "image/scales.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// Letter size for a picture's height: a fiftieth of it, and at least 10 pixels.
int letter_size(int picture_height) {
  return std::max(10, static_cast<int>(std::lround(picture_height / 50.0)));
}

// Greatest width to which a title may widen a picture, in heights of the picture: longer names are cut.
constexpr double kWidestTitle = 1.2;

constexpr double kLineSpacing = 1.5;  // [em]
constexpr double kTitleGap = 1.0;     // Gap between name and details [em].
constexpr double kBarThickness = 0.9;

}  // namespace

std::string name_of(const SonarConfig& sonar) {
  std::string name = printable(sonar.name, kLongestName);
  const std::string model = printable(sonar.model, kLongestName);
  if (model.empty()) {
    return name;
  }
  return name == SonarConfig().name ? model : fmt::format("{} ({})", model, name);
}

Heading heading_of(const SonarConfig& sonar, const std::string& what, double time) {
  return {name_of(sonar), fmt::format("{}   {} m   {}   t = {:.2f} s", frequency_text(sonar.frequency),
                                      number_text(sonar.max_range), what, time)};
}

Page::Page(const Display& display, Heading heading)
    : display_(display), lettering_(letter_size(display.height)), heading_(std::move(heading)) {
  const double widest = kWidestTitle * display.height;
  heading_ = {lettering_.shortened(heading_.name, widest), lettering_.shortened(heading_.details, widest)};
}

double Page::hairline() const {
  return std::max(1.0, em() / 14);
}

void Page::fit_title(double width) {
  const double one_line = lettering_.width(heading_.name) + kTitleGap * em() + lettering_.width(heading_.details);
  two_lines_ = one_line + 2 * margin() > width;
}

double Page::least_width() const {
  const double name = lettering_.width(heading_.name);
  const double details = lettering_.width(heading_.details);
  return 2 * margin() + (two_lines_ ? std::max(name, details) : name + kTitleGap * em() + details);
}

double Page::title_height() const {
  return margin() + em() * (two_lines_ ? 1 + kLineSpacing : 1);
}

void Page::draw_title(Picture& picture) const {
  Point place{margin(), margin() + em() / 2};
  lettering_.draw(picture, place, heading_.name, palette::kTitle, Anchor::kStart);
  if (two_lines_) {
    place.y += kLineSpacing * em();
  } else {
    place.x += lettering_.width(heading_.name) + kTitleGap * em();
  }
  lettering_.draw(picture, place, heading_.details, palette::kText, Anchor::kStart);
}

std::vector<Page::Tick> Page::bar_ticks(int most_parts) const {
  const bool linear = display_.scale == Scale::kLinear;
  const double brightest = display_.of_source || display_.of_one ? 10 * std::log10(display_.full_scale) : 0;
  const double low = linear ? 0 : brightest + display_.floor_db;
  const double high = linear ? display_.full_scale : brightest;
  std::vector<Tick> ticks;
  const double step = nice_step(high - low, most_parts);
  for (const double value : multiples_within(low, high, display_.of_counts ? std::max(step, 1.0) : step)) {
    ticks.push_back({(value - low) / (high - low),
                     display_.of_counts ? fmt::format("{:.0f}", std::abs(value)) : number_text(value)});
  }
  return ticks;
}

std::string Page::bar_caption() const {
  if (display_.scale == Scale::kLinear) {
    return display_.of_counts ? fmt::format("count (0 to {:.0f})", display_.full_scale)
                              : fmt::format("echo intensity (0 to {})", number_text(display_.full_scale));
  }
  const std::string_view reference = display_.of_source ? "source at 1 m" : display_.of_one ? "1" : "full scale";
  return display_.raised_per_decade > 0
             ? fmt::format("dB re {}, + {} log r", reference, number_text(display_.raised_per_decade))
             : fmt::format("dB re {}", reference);
}

double Page::bar_width() const {
  double widest = 0;
  for (const Tick& tick : bar_ticks(5)) {
    widest = std::max(widest, lettering_.width(tick.text));
  }
  return (kBarThickness + kTickLength + kTextGap) * em() + widest + 0.8 * em() + lettering_.height() + margin();
}

void Page::draw_bar(Picture& picture, double top, double bottom) const {
  const double left = std::round(picture.width - bar_width());
  const double right = std::round(left + kBarThickness * em());
  top = std::round(top);
  bottom = std::round(bottom);
  for (int y = static_cast<int>(top); y < static_cast<int>(bottom); ++y) {
    const double level = (bottom - y - 0.5) / (bottom - top);
    fill_rectangle(picture, {left, y * 1.0}, {right, y + 1.0}, {colour(display_.colour_map, level), 1});
  }
  const double line = hairline();
  const double half = line / 2;
  draw_line(picture, {left - half, top - line}, {left - half, bottom + line}, line, palette::kOutline);
  draw_line(picture, {right + half, top - line}, {right + half, bottom + line}, line, palette::kOutline);
  draw_line(picture, {left, top - half}, {right, top - half}, line, palette::kOutline);
  draw_line(picture, {left, bottom + half}, {right, bottom + half}, line, palette::kOutline);

  for (const Tick& tick : bar_ticks(5)) {
    const double y = std::clamp(std::floor(bottom - tick.level * (bottom - top)) + 0.5, top + half, bottom - half);
    draw_line(picture, {right + line, y}, {right + kTickLength * em(), y}, line, palette::kText);
    lettering_.draw(picture, {right + (kTickLength + kTextGap) * em(), y}, tick.text, palette::kText, Anchor::kStart);
  }
  const std::string caption = lettering_.shortened(bar_caption(), bottom - top);
  lettering_.draw_upwards(picture, {picture.width - margin() - lettering_.height() / 2, (top + bottom) / 2}, caption,
                          palette::kText);
}

}  // namespace insonify
