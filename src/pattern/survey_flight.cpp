// survey_flight.cpp -- samples a survey's path, looks for the bed below, and lets the vehicle follow it.

#include "pattern/survey_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "insonify/error.h"
#include "pattern/random_motion.h"
#include "pattern/swath.h"

namespace insonify {
namespace {

constexpr double kSamplesPerLength = 8;   // Of the vehicle.
constexpr double kSamplesPerPeriod = 16;  // Of its fastest motion.
constexpr double kArcError = 0.5e-3;      // Between samples of a turn [m].
constexpr std::size_t kMostSamples = 10'000'000;

double step_of(const SurveyPattern& pattern, const SurveyPath& path) {
  double step = pattern.lines.vehicle_length / kSamplesPerLength;
  for (const PathPiece& piece : path.pieces) {
    if (piece.curvature != 0) {
      step = std::min(step, std::sqrt(8 * kArcError / std::abs(piece.curvature)));
    }
  }
  if (const auto& noise = pattern.motion_noise) {
    const double period = noise->period.value_or(usual_period(noise->spectrum));
    step = std::min(step, pattern.lines.speed / (kSamplesPerPeriod * motion_band(noise->spectrum, period).high));
  }
  return step;
}

// Fills in what has no bed, between the nearest samples that have one.
void fill_gaps(SurveyFlight& flight) {
  const std::size_t count = flight.beds.size();
  for (std::size_t i = 0; i < count;) {
    if (flight.has_bed[i]) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < count && !flight.has_bed[end]) {
      ++end;
    }
    const double before = i > 0 ? flight.beds[i - 1] : end < count ? flight.beds[end] : 0;
    const double after = end < count ? flight.beds[end] : before;
    for (std::size_t k = i; k < end; ++k) {
      const double share = static_cast<double>(k - i + 1) / static_cast<double>(end - i + 1);
      flight.beds[k] = before + share * (after - before);
    }
    i = end;
  }
}

std::string place_text(const SurveyPath::Station& at) {
  const auto rounded = [](double value) { return std::round(value * 100) / 100 + 0; };  // Adding zero turns -0 into 0.
  return fmt::format("x = {:.7g} m, y = {:.7g} m", rounded(at.x), rounded(at.y));
}

std::string piece_text(int line) {
  return line < 0 ? "a turn or run-in" : fmt::format("line {}", line + 1);
}

void find_bed(const SurveyPattern& pattern, const Bed& bed, const Scene& scene, SurveyFlight& flight) {
  const SurveyLines& lines = pattern.lines;
  const double ground = lines.height.value_or(0);
  for (std::size_t i = 0; i < flight.beds.size(); ++i) {
    const SurveyPath::Station at = flight.path.at(static_cast<double>(i) * flight.step);
    const std::optional<Bed::Hit> hit = bed.at(at.x, at.y);
    flight.has_bed[i] = hit.has_value();
    flight.beds[i] = hit ? hit->height : ground;
    if (hit && lines.height && hit->height >= *lines.height) {
      throw Error("pattern.lines", "height",
                  fmt::format(" = {:.7g} m: {} runs into {}, which is {:.4g} m high at {}", *lines.height,
                              piece_text(at.line), scene.instances[hit->instance].name, hit->height, place_text(at)));
    }
  }
  const bool open_water = lines.height && std::ranges::find(flight.has_bed, true) == flight.has_bed.end();
  for (std::size_t i = 0; i < flight.beds.size() && !open_water; ++i) {
    const SurveyPath::Station at = flight.path.at(static_cast<double>(i) * flight.step);
    if (!flight.has_bed[i] && at.line >= 0) {
      throw Error("pattern.lines", "", fmt::format(": line {} leaves the terrain at {}", at.line + 1, place_text(at)));
    }
  }
}

void check_ceiling(const SurveyLines& lines, const SurveyFlight& flight) {
  for (std::size_t i = 0; lines.ceiling && i < flight.heights.size(); ++i) {
    if (flight.heights[i] >= *lines.ceiling) {
      const SurveyPath::Station at = flight.path.at(static_cast<double>(i) * flight.step);
      throw Error("pattern.lines", "ceiling",
                  fmt::format(" = {:.7g} m: {} climbs to {:.7g} m at {}", *lines.ceiling, piece_text(at.line),
                              flight.heights[i], place_text(at)));
    }
  }
}

std::vector<double> averaged(const std::vector<double>& values, int reach) {
  std::vector<double> sums(values.size() + 1, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    sums[i + 1] = sums[i] + values[i] - values.front();
  }
  std::vector<double> means(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Symmetric about the sample also near the ends, so that a slope stays what it is.
    const std::size_t side = std::min({static_cast<std::size_t>(reach), i, values.size() - 1 - i});
    means[i] = values.front() + (sums[i + side + 1] - sums[i - side]) / static_cast<double>(2 * side + 1);
  }
  return means;
}

}  // namespace

std::size_t SurveyFlight::sample_at(double distance) const {
  const double nearest = std::round(distance / step);
  return static_cast<std::size_t>(std::clamp(nearest, 0.0, static_cast<double>(heights.size() - 1)));
}

std::vector<double> followed_heights(std::span<const double> beds, double step, double altitude, double slope,
                                     double length) {
  std::vector<double> heights(beds.begin(), beds.end());
  const double climb = slope * step;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    heights[i] = std::max(heights[i], heights[i - 1] - climb);
  }
  for (std::size_t i = heights.size() - 1; i-- > 0;) {
    heights[i] = std::max(heights[i], heights[i + 1] - climb);
  }
  for (double& height : heights) {
    height += altitude;
  }
  return averaged(heights, static_cast<int>(std::lround(0.5 * length / step)));
}

PlanBox extent_of(const SurveyPath& path) {
  PlanBox box{Eigen::Vector2d::Constant(1e300), Eigen::Vector2d::Constant(-1e300)};
  for (const PathPiece& piece : path.pieces) {
    constexpr int kParts = 32;  // A margin covers the rest of an arc.
    for (int i = 0; i <= kParts; ++i) {
      const SurveyPath::Station at = path.at(piece.begin + piece.length * i / kParts);
      box.low = box.low.cwiseMin(Eigen::Vector2d(at.x, at.y));
      box.high = box.high.cwiseMax(Eigen::Vector2d(at.x, at.y));
    }
  }
  const double margin = 1 + 0.01 * (box.high - box.low).maxCoeff();
  return {box.low.array() - margin, box.high.array() + margin};
}

SurveyFlight survey_flight(const SurveyPattern& pattern, std::span<const SonarConfig> sonars, const Scene& scene) {
  const SurveyLines& lines = pattern.lines;
  SurveyFlight flight{.path = survey_path(lines, line_spacing(lines, sonars)), .speed = lines.speed};
  const double length = flight.path.length(), parts = std::ceil(length / step_of(pattern, flight.path));
  if (!(parts < static_cast<double>(kMostSamples))) {
    throw Error("pattern.lines", "",
                fmt::format(": a path of {:.4g} m in steps of {:.2g} m is too long; at most {} steps", length,
                            length / parts, kMostSamples));
  }
  const std::size_t count = static_cast<std::size_t>(parts) + 1;
  flight.step = length / parts;
  flight.beds.resize(count);
  flight.has_bed.resize(count);
  find_bed(pattern, Bed(scene, extent_of(flight.path), lines.ceiling), scene, flight);
  fill_gaps(flight);
  flight.heights = lines.altitude ? followed_heights(flight.beds, flight.step, *lines.altitude,
                                                     std::tan(lines.max_pitch), lines.vehicle_length)
                                  : std::vector<double>(count, *lines.height);
  check_ceiling(lines, flight);
  return flight;
}

}  // namespace insonify
