// draw_survey_plan.cpp -- draws a survey's plan over its bed, as a chart from above.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/chart.h"
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

class PlanDrawing {
 public:
  PlanDrawing(const SurveyPlan& plan, int height)
      : plan_(plan),
        chart_(plan.bed.low, plan.bed.high, height, plan.title.empty() ? "Survey plan" : "Survey plan: " + plan.title,
               summary()),
        picture_(chart_.picture()) {}

  Picture draw() {
    const ValueRange heights = range_of(plan_.bed.heights);
    const PlannedBed& bed = plan_.bed;
    chart_.draw_relief({bed.low, bed.high, bed.columns, bed.rows, bed.heights}, heights);
    draw_swaths();
    draw_area();
    draw_track();
    chart_.draw_axes("x [m]", "y [m]");
    chart_.draw_bar(heights, depth_colour, "height of the bed, z [m]");
    chart_.draw_scale_and_north();
    chart_.draw_titles();
    return std::move(picture_);
  }

 private:
  [[nodiscard]] Point at(const PlanPoint& place) const { return chart_.at(place); }
  [[nodiscard]] const Lettering& letters() const { return chart_.letters(); }
  [[nodiscard]] double hairline() const { return chart_.hairline(); }

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
    chart_.for_pixels([&](int x, int y, const PlanPoint& place) {
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
    const double length = std::hypot(to.x - from.x, to.y - from.y), dash = 0.45 * letters().size();
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
    const double length = 0.75 * letters().size();
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
    const double radius = std::max(0.8 * letters().size(), 0.5 * letters().width(number) + 0.3 * letters().size());
    draw_arc(picture_, start, 0.5 * radius, 0, kTwoPi, radius, {palette::kBackground, 0.9});
    draw_arc(picture_, start, radius, 0, kTwoPi, hairline(), kTrackInk);
    letters().draw(picture_, start, number, palette::kTitle);
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

  const SurveyPlan& plan_;
  Chart chart_;
  Picture& picture_;
};

}  // namespace

Picture draw_survey_plan(const SurveyPlan& plan, int height) {
  check_field("", {"height", "pixels", from_to(240, 8192), ""}, height);
  return PlanDrawing(plan, height).draw();
}

}  // namespace insonify
