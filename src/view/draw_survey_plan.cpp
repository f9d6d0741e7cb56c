// draw_survey_plan.cpp -- draws a survey's plan over its bed, as a chart from above.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "image/colours.h"
#include "image/lettering.h"
#include "image/scales.h"
#include "insonify/survey_plan.h"

namespace insonify {
namespace {

constexpr Ink kTrackInk{{255, 214, 90}, 1};
constexpr Ink kTurnInk{{255, 214, 90}, 0.8};
constexpr Ink kAreaInk{{255, 255, 255}, 0.85};
constexpr Ink kSwathInk{{120, 255, 190}, 0.16};
constexpr Ink kSwathEdgeInk{{150, 255, 205}, 0.55};
constexpr Ink kGapInk{{255, 60, 60}, 0.55};
constexpr Ink kChartRim{{0, 0, 0}, 0.55};

// Colours of the bed from deep to shallow, as on charts.
constexpr std::array<Rgb, 5> kDepthColours = {Rgb{24, 32, 92}, Rgb{30, 84, 150}, Rgb{52, 142, 176}, Rgb{122, 190, 178},
                                              Rgb{214, 216, 164}};

// @param share  0 (deep) to 1 (shallow).
Rgb depth_colour(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (kDepthColours.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), kDepthColours.size() - 2);
  const double within = place - static_cast<double>(below);
  const auto mixed = [&](std::uint8_t Rgb::*part) {
    return static_cast<std::uint8_t>(
        std::lround((1 - within) * kDepthColours[below].*part + within * kDepthColours[below + 1].*part));
  };
  return {mixed(&Rgb::red), mixed(&Rgb::green), mixed(&Rgb::blue)};
}

Rgb shaded(Rgb colour, double light) {
  const auto part = [&](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::clamp(value * light, 0.0, 255.0));
  };
  return {part(colour.red), part(colour.green), part(colour.blue)};
}

class PlanDrawing {
 public:
  PlanDrawing(const SurveyPlan& plan, int height) : plan_(plan), letters_(std::max(10, height / 55)) {
    const double em = letters_.size();
    const PlanPoint size = plan.bed.high - plan.bed.low;
    const double left = 5.2 * em, right = 8 * em, top = 4.6 * em, bottom = 3.6 * em;
    scale_ = std::min((height - top - bottom) / size.y(), (1.7 * height - left - right) / size.x());
    left_ = left;
    width_ = scale_ * size.x();
    height_ = scale_ * size.y();
    const double least = letters_.width(summary()) + 3 * em;  // The title must fit.
    left_ += std::max(0.0, 0.5 * (least - left - right - width_));
    top_ = top;
    picture_ = blank_picture(static_cast<int>(std::lround(std::max(least, left + right + width_))),
                             static_cast<int>(std::lround(top + height_ + bottom)), palette::kBackground);
  }

  Picture draw() {
    find_depths();
    draw_bed();
    draw_swaths();
    draw_area();
    draw_track();
    draw_axes();
    draw_depth_bar();
    draw_scale_and_north();
    draw_titles();
    return std::move(picture_);
  }

 private:
  [[nodiscard]] Point at(const PlanPoint& place) const {
    return {left_ + scale_ * (place.x() - plan_.bed.low.x()), top_ + scale_ * (plan_.bed.high.y() - place.y())};
  }
  [[nodiscard]] PlanPoint place_of(double x, double y) const {
    return {plan_.bed.low.x() + (x - left_) / scale_, plan_.bed.high.y() - (y - top_) / scale_};
  }

  // Calls action(x, y, place) for each pixel of the plot.
  template <typename Action>
  void for_pixels(const Action& action) {
    for (int y = static_cast<int>(top_); y < static_cast<int>(top_ + height_); ++y) {
      for (int x = static_cast<int>(left_); x < static_cast<int>(left_ + width_); ++x) {
        action(x, y, place_of(x + 0.5, y + 0.5));
      }
    }
  }

  [[nodiscard]] double bed_at(int column, int row) const {
    const PlannedBed& bed = plan_.bed;
    return bed.heights[static_cast<std::size_t>(std::clamp(row, 0, bed.rows - 1)) * bed.columns +
                       std::clamp(column, 0, bed.columns - 1)];
  }

  void find_depths() {
    std::vector<float> heights;
    std::ranges::copy_if(plan_.bed.heights, std::back_inserter(heights), [](float h) { return std::isfinite(h); });
    has_bed_ = !heights.empty();
    if (has_bed_) {
      const auto [low, high] = std::ranges::minmax(heights);
      low_ = low;
      high_ = high;
    }
  }

  // Lit from the north-west, with slopes raised where the bed is flat.
  void draw_bed() {
    const PlannedBed& bed = plan_.bed;
    const double pixel = (bed.high.x() - bed.low.x()) / bed.columns, relief = std::max(high_ - low_, 1e-3);
    const double raised = std::clamp(0.12 * (bed.high - bed.low).maxCoeff() / relief, 1.0, 8.0);
    const Vec3 light = Vec3(-1, 1, 1.4).normalized();
    for_pixels([&](int x, int y, const PlanPoint& place) {
      const int column = static_cast<int>((place.x() - bed.low.x()) / pixel);
      const int row = static_cast<int>((bed.high.y() - place.y()) / pixel);
      const double here = bed_at(column, row);
      if (!std::isfinite(here)) {
        put(picture_, x, y, palette::kNotYetSeen);
        return;
      }
      const auto slope = [&](double after, double before) {
        return std::isfinite(after) && std::isfinite(before) ? raised * (after - before) / (2 * pixel) : 0.0;
      };
      const Vec3 normal = Vec3(-slope(bed_at(column + 1, row), bed_at(column - 1, row)),
                               -slope(bed_at(column, row - 1), bed_at(column, row + 1)), 1)
                              .normalized();
      const double lit = std::max(0.0, normal.dot(light)) / light.z();
      put(picture_, x, y, shaded(depth_colour((here - low_) / relief), 0.25 + 0.6 * lit));
    });
  }

  // Number of swaths over a place, and whether it is within the area.
  struct Cover {
    int swaths = 0;
    bool within = false;
  };
  [[nodiscard]] Cover cover_at(const PlanPoint& place) const {
    const PlanPoint along = (plan_.area[1] - plan_.area[0]).normalized(), port(-along.y(), along.x());
    const PlanPoint from = place - plan_.area[0];
    const double u = from.dot(along), v = from.dot(port);
    Cover cover{.within = u >= 0 && u <= (plan_.area[1] - plan_.area[0]).norm() && v >= 0 &&
                          v <= (plan_.area[3] - plan_.area[0]).norm()};
    for (const PlannedLine& line : plan_.lines) {
      const PlanPoint run = line.end - line.begin;
      const double share = (place - line.begin).dot(run) / run.squaredNorm();
      if (share < 0 || share > 1 || line.half_swath.empty()) {
        continue;
      }
      const double half = line.half_swath[std::lround(share * static_cast<double>(line.half_swath.size() - 1))];
      cover.swaths += (place - line.begin - share * run).norm() <= half ? 1 : 0;
    }
    return cover;
  }

  void draw_swaths() {
    if (plan_.swath_sonar < 0) {
      return;
    }
    for_pixels([&](int x, int y, const PlanPoint& place) {
      const Cover cover = cover_at(place);
      for (int i = 0; i < std::min(cover.swaths, 3); ++i) {
        blend(picture_, x, y, kSwathInk);
      }
      if (cover.within && cover.swaths == 0 && (x + y) % 6 < 3) {
        blend(picture_, x, y, kGapInk);
      }
    });
    for (const PlannedLine& line : plan_.lines) {
      const PlanPoint run = line.end - line.begin, side = PlanPoint(-run.y(), run.x()).normalized();
      const auto edge = [&](std::size_t i, double sign) {
        const double share = static_cast<double>(i) / static_cast<double>(line.half_swath.size() - 1);
        return at(line.begin + share * run + sign * line.half_swath[i] * side);
      };
      for (std::size_t i = 1; i < line.half_swath.size(); ++i) {
        for (const double sign : {-1.0, 1.0}) {
          draw_line(picture_, edge(i - 1, sign), edge(i, sign), hairline(), kSwathEdgeInk);
        }
      }
    }
  }

  void draw_area() {
    for (std::size_t i = 0; i < plan_.area.size(); ++i) {
      draw_line(picture_, at(plan_.area[i]), at(plan_.area[(i + 1) % plan_.area.size()]), 1.2 * hairline(), kAreaInk);
    }
  }

  void draw_track() {
    double drawn = 0;  // Of the track so far [pixels].
    for (std::size_t i = 1; i < plan_.track.size(); ++i) {
      const Point from = at(plan_.track[i - 1]), to = at(plan_.track[i]);
      if (plan_.pings_on_turns) {
        draw_line(picture_, from, to, hairline(), kTurnInk);
      } else {
        drawn = draw_dashes(from, to, drawn);
      }
    }
    for (const PlannedLine& line : plan_.lines) {
      draw_line(picture_, at(line.begin), at(line.end), 3.4 * hairline(), kChartRim);
      draw_line(picture_, at(line.begin), at(line.end), 1.8 * hairline(), kTrackInk);
      for (const double share : {0.25, 0.75}) {
        draw_arrow(at(line.begin + share * (line.end - line.begin)), line);
      }
    }
    for (std::size_t i = 0; i < plan_.lines.size(); ++i) {
      draw_number(plan_.lines[i], fmt::to_string(i + 1));
    }
  }

  // A piece of a dashed line of which a length is drawn already. Returns the length with it.
  double draw_dashes(const Point& from, const Point& to, double drawn) {
    const double length = std::hypot(to.x - from.x, to.y - from.y), dash = 0.45 * letters_.size();
    const auto point = [&](double along) {
      return Point{from.x + along / length * (to.x - from.x), from.y + along / length * (to.y - from.y)};
    };
    for (auto number = static_cast<int>(drawn / dash); number * dash < drawn + length; ++number) {
      const double begin = std::max(0.0, number * dash - drawn), end = std::min(length, (number + 1) * dash - drawn);
      if (number % 2 == 0 && end > begin) {
        draw_line(picture_, point(begin), point(end), hairline(), kTurnInk);
      }
    }
    return drawn + length;
  }

  void draw_arrow(Point tip, const PlannedLine& line) {
    const PlanPoint run = (line.end - line.begin).normalized();
    const double length = 0.75 * letters_.size();
    for (const double turn : {0.42, -0.42}) {  // [rad]
      const double cosine = std::cos(turn), sine = std::sin(turn);
      const Point wing{tip.x - length * (cosine * run.x() - sine * run.y()),
                       tip.y + length * (sine * run.x() + cosine * run.y())};
      draw_line(picture_, tip, wing, 2 * hairline(), kTrackInk);
    }
  }

  // Beside the start of a line, on a disc.
  void draw_number(const PlannedLine& line, const std::string& number) {
    const Point start = at(line.begin);
    const double radius = std::max(0.8 * letters_.size(), 0.5 * letters_.width(number) + 0.3 * letters_.size());
    draw_arc(picture_, start, 0.5 * radius, 0, kTwoPi, radius, {palette::kBackground, 0.9});
    draw_arc(picture_, start, radius, 0, kTwoPi, hairline(), kTrackInk);
    letters_.draw(picture_, start, number, palette::kTitle);
  }

  void draw_axes() {
    const double em = letters_.size(), bottom = top_ + height_, right = left_ + width_;
    for (const auto& [from, to] :
         {std::pair(Point{left_, top_}, Point{right, top_}), std::pair(Point{right, top_}, Point{right, bottom}),
          std::pair(Point{right, bottom}, Point{left_, bottom}), std::pair(Point{left_, bottom}, Point{left_, top_})}) {
      draw_line(picture_, from, to, hairline(), palette::kOutline);
    }
    const double step = nice_step((plan_.bed.high - plan_.bed.low).maxCoeff(), 8), tick = kTickLength * em;
    for (const double x : multiples_within(plan_.bed.low.x(), plan_.bed.high.x(), step)) {
      const Point foot = at({x, plan_.bed.low.y()});
      draw_line(picture_, foot, {foot.x, foot.y + tick}, hairline(), palette::kText);
      letters_.draw(picture_, {foot.x, bottom + tick + 0.8 * em}, number_text(x), palette::kText);
    }
    for (const double y : multiples_within(plan_.bed.low.y(), plan_.bed.high.y(), step)) {
      const Point foot = at({plan_.bed.low.x(), y});
      draw_line(picture_, foot, {foot.x - tick, foot.y}, hairline(), palette::kText);
      letters_.draw(picture_, {left_ - tick - kTextGap * em, foot.y}, number_text(y), palette::kText, Anchor::kEnd);
    }
    letters_.draw(picture_, {left_ + 0.5 * width_, bottom + 2.6 * em}, "x [m]", palette::kText);
    letters_.draw_upwards(picture_, {left_ - 4.2 * em, top_ + 0.5 * height_}, "y [m]", palette::kText);
  }

  void draw_depth_bar() {
    if (!has_bed_) {
      return;
    }
    const double em = letters_.size(), x = left_ + width_ + 1.4 * em, bar = 1.1 * em;
    const double range = std::max(high_ - low_, 1e-3);
    for (int y = 0; y < static_cast<int>(height_); ++y) {
      const Rgb colour = shaded(depth_colour(1 - (y + 0.5) / height_), 0.85);
      fill_rectangle(picture_, {x, top_ + y}, {x + bar, top_ + y + 1}, {colour, 1});
    }
    for (const double z : multiples_within(low_, high_, nice_step(range, 8))) {
      const double y = top_ + height_ * (1 - (z - low_) / range);
      draw_line(picture_, {x + bar, y}, {x + bar + kTickLength * em, y}, hairline(), palette::kText);
      letters_.draw(picture_, {x + bar + 0.7 * em, y}, number_text(z), palette::kText, Anchor::kStart);
    }
    letters_.draw_upwards(picture_, {x + bar + 4.4 * em, top_ + 0.5 * height_}, "height of the bed, z [m]",
                          palette::kText);
  }

  void draw_scale_and_north() {
    const double em = letters_.size(), length = nice_step((plan_.bed.high - plan_.bed.low).x(), 4);
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

  [[nodiscard]] std::string summary() const {
    std::string text = fmt::format("{} {}   {:.4g} m on lines, {:.4g} m in all   {:.0f} min {:02.0f} s",
                                   plan_.lines.size(), plan_.lines.size() == 1 ? "line" : "lines", plan_.line_length,
                                   plan_.length, std::floor(plan_.duration / 60), std::fmod(plan_.duration, 60));
    if (plan_.spacing > 0) {
      text += fmt::format("   spacing {:.3g} m", plan_.spacing);
    }
    const PlannedSonar* sonar = plan_.swath_sonar < 0 ? nullptr : &plan_.sonars[plan_.swath_sonar];
    if (sonar != nullptr && sonar->covered) {
      text += fmt::format("   {} covers {:.3g} %", sonar->name, 100 * *sonar->covered);
    }
    return text;
  }

  void draw_titles() {
    const double em = letters_.size();
    letters_.draw(picture_, {left_, 1.5 * em}, plan_.title.empty() ? "Survey plan" : "Survey plan: " + plan_.title,
                  palette::kTitle, Anchor::kStart);
    letters_.draw(picture_, {left_, 3.2 * em}, summary(), palette::kText, Anchor::kStart);
  }

  [[nodiscard]] double hairline() const { return std::max(1.0, letters_.size() / 14.0); }

  const SurveyPlan& plan_;
  Lettering letters_;
  double scale_ = 1;  // [pixels/m]
  double left_ = 0, top_ = 0, width_ = 0, height_ = 0;
  bool has_bed_ = false;
  double low_ = 0, high_ = 0;  // Of the bed [m].
  Picture picture_;
};

}  // namespace

Picture draw_survey_plan(const SurveyPlan& plan, int height) {
  check_field("", {"height", "pixels", from_to(240, 8192), ""}, height);
  return PlanDrawing(plan, height).draw();
}

}  // namespace insonify
