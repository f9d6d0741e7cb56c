// survey_path.cpp -- lays lines over an area and joins them by turns.

#include "pattern/survey_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insonify {
namespace {

constexpr double kPi = std::numbers::pi;

// Angle by which a vehicle swings out before a turn that is wider than the spacing.
double swing_of(double spacing, double radius) {
  return std::acos(std::min(1.0, (2 * radius + spacing) / (4 * radius)));
}

// Adds pieces one after another.
class PathMaker {
 public:
  explicit PathMaker(const PathPiece& start) : next_(start) {}

  void add(double length, double curvature, int line = -1) {
    if (length <= 0) {
      return;
    }
    next_.length = length;
    next_.curvature = curvature;
    next_.line = line;
    path_.pieces.push_back(next_);
    const double distance = next_.begin + length;
    const SurveyPath::Station end = path_.at(distance);
    next_ = {.begin = distance, .x = end.x, .y = end.y, .yaw = end.yaw};
  }

  // @param side  1 to port, -1 to starboard.
  void add_turn(double spacing, double radius, double side) {
    const double bend = side / radius;
    if (spacing >= 2 * radius) {
      add(0.5 * kPi * radius, bend);
      add(spacing - 2 * radius, 0);
      add(0.5 * kPi * radius, bend);
      return;
    }
    const double swing = swing_of(spacing, radius);
    add(swing * radius, -bend);
    add((kPi + 2 * swing) * radius, bend);
    add(swing * radius, -bend);
  }

  SurveyPath path_;

 private:
  PathPiece next_;
};

}  // namespace

SurveyPath::Station SurveyPath::at(double distance) const {
  const auto after = std::ranges::upper_bound(pieces, distance, {}, &PathPiece::begin);
  const PathPiece& piece = *(after == pieces.begin() ? after : after - 1);
  const double along = distance - piece.begin, yaw = piece.yaw + along * piece.curvature;
  if (piece.curvature == 0) {
    return {piece.x + along * std::cos(yaw), piece.y + along * std::sin(yaw), yaw, piece.line};
  }
  return {piece.x + (std::sin(yaw) - std::sin(piece.yaw)) / piece.curvature,
          piece.y - (std::cos(yaw) - std::cos(piece.yaw)) / piece.curvature, yaw, piece.line};
}

const PathPiece& SurveyPath::line(int index) const {
  return *std::ranges::find(pieces, index, &PathPiece::line);
}

int line_count(const SurveyLines& lines, double spacing) {
  constexpr double kSlack = 1e-9;  // A width of a whole number of spacings must not get one line more by rounding.
  return lines.width > 0 ? std::max(1, static_cast<int>(std::ceil(lines.width / spacing * (1 - kSlack)))) : 1;
}

double turn_length(double spacing, double radius) {
  return spacing >= 2 * radius ? kPi * radius + spacing - 2 * radius : radius * (kPi + 4 * swing_of(spacing, radius));
}

Eigen::Vector2d area_corner(const SurveyLines& lines) {
  if (!lines.corner.empty()) {
    return {lines.corner[0], lines.corner[1]};
  }
  const Eigen::Vector2d along(std::cos(lines.yaw), std::sin(lines.yaw)), port(-along.y(), along.x());
  return Eigen::Vector2d(lines.center[0], lines.center[1]) - 0.5 * lines.length * along - 0.5 * lines.width * port;
}

SurveyPath survey_path(const SurveyLines& lines, double spacing) {
  const int count = line_count(lines, spacing);
  const Eigen::Vector2d along(std::cos(lines.yaw), std::sin(lines.yaw)), port(-along.y(), along.x());
  const Eigen::Vector2d start = area_corner(lines) + 0.5 * (lines.width - (count - 1) * spacing) * port;
  const Eigen::Vector2d first = start - lines.run_in * along;
  PathMaker maker({.x = first.x(), .y = first.y(), .yaw = lines.yaw});
  for (int i = 0; i < count; ++i) {
    maker.add(lines.run_in, 0);
    maker.add(lines.length, 0, i);
    maker.add(lines.run_in, 0);
    if (i + 1 < count) {
      maker.add_turn(spacing, lines.turn_radius.value_or(0.5 * spacing), i % 2 == 0 ? 1 : -1);
    }
  }
  SurveyPath path = std::move(maker.path_);
  path.line_count = count;
  path.spacing = count > 1 ? spacing : 0;
  return path;
}

}  // namespace insonify
