// mosaic.cpp -- rasterises the footprints of bins, line by line, and merges lines cell by cell.

#include "insonify/survey/mosaic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "insonify/error.h"
#include "insonify/field.h"
#include "insonify/survey/slant_range.h"
#include "survey/altitudes.h"
#include "survey/checks.h"

namespace insonify {
namespace {

constexpr float kUnseen = std::numeric_limits<float>::quiet_NaN();
constexpr double kBestAngle = radians_from_degrees(30);

// What one line has laid into the cells.
struct LineGrid {
  explicit LineGrid(std::size_t cells)
      : sums(cells), weights(cells), angles(cells), heaviest(cells), labels(cells, kNoLabel) {}
  std::vector<float> sums, weights, angles;  // Of intensities and angles times weights.
  std::vector<float> heaviest;               // Weight of the label.
  std::vector<std::uint16_t> labels;
};

// Directions and place of a ping on the bed.
struct Track {
  Vec3 below = Vec3::Zero();                         // Where its plane of beams meets the bed on the track.
  Vec3 ahead = Vec3::UnitX(), port = Vec3::UnitY();  // Level.
  double height = 0;                                 // Along the plane of the beams [m].
};

Track track_of(const Pose& pose, double altitude) {
  const Vec3 axis = pose.orientation * Vec3::UnitX();
  const double cosine = plane_cosine(pose);
  Track track;
  track.ahead = Vec3(axis.x(), axis.y(), 0) / std::max(cosine, 1e-9);
  track.port = Vec3(-track.ahead.y(), track.ahead.x(), 0);
  // The plane is normal to the axis: with the nose down it meets the bed behind the sonar.
  track.below =
      Vec3(pose.position.x(), pose.position.y(), 0) + altitude * axis.z() / std::max(cosine, 1e-9) * track.ahead;
  track.height = altitude / std::max(cosine, 1e-9);
  return track;
}

// Cell of a line that pings are laid with: labels and intensities at its ground ranges.
struct Strip {
  std::vector<float> intensities;     // [cell * beams + beam]
  std::vector<std::uint16_t> labels;  // The same; empty without.
};

Strip strip_of(const Ping& ping, const SonarConfig& sonar, double altitude, double height, const GroundGrid& ground) {
  Strip strip{slant_to_ground(ping, sonar, altitude, ground), {}};
  if (ping.instance.empty()) {
    return strip;
  }
  for (int cell = 0; cell < ground.count; ++cell) {
    const double range = std::hypot(ground.range(cell), height);
    const int bin = static_cast<int>((range - sonar.min_range) / sonar.bin_length());
    for (int beam = 0; beam < ping.beam_count; ++beam) {
      strip.labels.push_back(bin >= 0 && bin < ping.bin_count ? ping.instance[ping.index(bin, beam)] : kNoLabel);
    }
  }
  return strip;
}

class Rasteriser {
 public:
  Rasteriser(const Mosaic& mosaic, LineGrid& grid) : mosaic_(&mosaic), grid_(&grid) {}

  // Lays a rectangle of half sizes `along` and `across` around a middle.
  void lay(const Vec3& middle, const Track& track, double along, double across, float intensity, double angle,
           std::uint16_t label) {
    const double cell = mosaic_->cell;
    const double reach_x = std::abs(track.ahead.x()) * along + std::abs(track.port.x()) * across;
    const double reach_y = std::abs(track.ahead.y()) * along + std::abs(track.port.y()) * across;
    const int first = column_of(middle.x() - reach_x), last = column_of(middle.x() + reach_x);
    const int top = row_of(middle.y() + reach_y), bottom = row_of(middle.y() - reach_y);
    for (int row = std::max(0, top); row <= std::min(mosaic_->rows - 1, bottom); ++row) {
      for (int column = std::max(0, first); column <= std::min(mosaic_->columns - 1, last); ++column) {
        const Vec3 off(mosaic_->west + (column + 0.5) * cell - middle.x(),
                       mosaic_->north - (row + 0.5) * cell - middle.y(), 0);
        const double behind = std::abs(off.dot(track.ahead));
        if (behind <= along && std::abs(off.dot(track.port)) <= across) {
          add(mosaic_->index(column, row), static_cast<float>(1.01 - behind / along), intensity, angle, label);
        }
      }
    }
  }

 private:
  [[nodiscard]] int column_of(double x) const {
    return static_cast<int>(std::floor((x - mosaic_->west) / mosaic_->cell));
  }
  [[nodiscard]] int row_of(double y) const {
    return static_cast<int>(std::floor((mosaic_->north - y) / mosaic_->cell));
  }

  void add(std::size_t at, float weight, float intensity, double angle, std::uint16_t label) {
    grid_->sums[at] += weight * intensity;
    grid_->angles[at] += weight * static_cast<float>(angle);
    grid_->weights[at] += weight;
    if (weight > grid_->heaviest[at]) {
      grid_->heaviest[at] = weight;
      grid_->labels[at] = label;
    }
  }

  const Mosaic* mosaic_;
  LineGrid* grid_;
};

// Pings without a pause: from the first of them to before the end.
struct Run {
  std::size_t begin, end;
};

// Divides a line where the sonar has paused, as between the lines of a survey that does not ping on turns: the vehicle
// goes on elsewhere. Pings that are missing now and then are no pause.
std::vector<Run> runs_of(const std::vector<double>& times) {
  constexpr double kPause = 5;  // Median intervals.
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times.size(); ++i) {
    intervals.push_back(times[i] - times[i - 1]);
  }
  const auto median = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::ranges::nth_element(intervals, median);
  std::vector<Run> runs = {{0, times.size()}};
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (*median > 0 && times[i] - times[i - 1] > kPause * *median) {
      runs.back().end = i;
      runs.push_back({i, times.size()});
    }
  }
  return runs;
}

// Way from ping to ping around one [m].
double spacing_at(std::span<const Vec3> places, std::size_t ping) {
  const Vec3 before = places[ping] - places[ping > 0 ? ping - 1 : 0];
  const Vec3 after = places[std::min(ping + 1, places.size() - 1)] - places[ping];
  return std::max(std::hypot(before.x(), before.y()), std::hypot(after.x(), after.y()));
}

void lay_ping(const Ping& ping, const MosaicLine& line, double altitude, double spacing, const Mosaic& mosaic,
              Rasteriser& rasteriser) {
  const Track track = track_of(ping.world_from_sonar, altitude);
  const double length = std::max(line.sonar.bin_length(), 0.5 * mosaic.cell);
  const GroundGrid ground{length, static_cast<int>(std::ceil(line.sonar.max_range / length))};
  const Strip strip = strip_of(ping, line.sonar, altitude, track.height, ground);
  const BearingGrid beams = line.sonar.bearings();
  for (int cell = 0; cell < ground.count; ++cell) {
    const double range = ground.range(cell), slant = std::hypot(range, track.height);
    for (int beam = 0; beam < ping.beam_count; ++beam) {
      const std::size_t at =
          static_cast<std::size_t>(cell) * static_cast<std::size_t>(ping.beam_count) + static_cast<std::size_t>(beam);
      if (std::isnan(strip.intensities[at])) {
        continue;
      }
      const double side = line.sonar.beam_azimuth(beam) > 0 ? 1 : -1;
      // At least a cell each way, so that none is missed between footprints.
      const double along = std::max({0.5 * beams.width(beam) * slant, spacing, 0.75 * mosaic.cell});
      const double across = std::max(0.5 * length, 0.75 * mosaic.cell);
      rasteriser.lay(track.below + side * range * track.port, track, along, across, strip.intensities[at],
                     std::asin(std::min(1.0, track.height / slant)),
                     strip.labels.empty() ? kNoLabel : strip.labels[at]);
    }
  }
}

bool shows_instead(const MosaicRule rule, float angle, float shown) {
  return rule == MosaicRule::kLatest || std::isnan(shown) ||
         std::abs(double{angle} - kBestAngle) < std::abs(double{shown} - kBestAngle);
}

// Merges a line into the mosaic.
void merge(Mosaic& mosaic, const LineGrid& grid, std::uint16_t line, MosaicRule rule, std::vector<float>& counts) {
  for (std::size_t at = 0; at < grid.weights.size(); ++at) {
    if (!(grid.weights[at] > 0)) {
      continue;
    }
    const float intensity = grid.sums[at] / grid.weights[at], angle = grid.angles[at] / grid.weights[at];
    const bool first = std::isnan(mosaic.intensity[at]);
    counts[at] += 1;
    if (rule == MosaicRule::kMean && !first) {
      mosaic.intensity[at] += (intensity - mosaic.intensity[at]) / counts[at];
    }
    if (first || shows_instead(rule == MosaicRule::kMean ? MosaicRule::kBest : rule, angle, mosaic.angle[at])) {
      mosaic.intensity[at] = rule == MosaicRule::kMean && !first ? mosaic.intensity[at] : intensity;
      mosaic.angle[at] = angle;
      mosaic.line[at] = line;
      if (!mosaic.instance.empty()) {
        mosaic.instance[at] = grid.labels[at];
      }
    }
  }
}

// Altitudes, places and times of a line's pings.
struct LinePlan {
  std::vector<double> altitudes;
  std::vector<Vec3> places;
  std::vector<double> times;
  bool labelled = false;
};

LinePlan plan_of(const MosaicLine& line, const MosaicOptions& options) {
  if (line.ping_count == 0) {
    throw Error(fmt::format("{}: a line of a mosaic must have at least one ping", line.sonar.name));
  }
  check_side_looking(line.sonar);
  LinePlan plan;
  BottomTracker tracker(line.sonar, options.bottom);
  std::vector<Pose> poses;
  for (std::uint64_t number = 0; number < line.ping_count; ++number) {
    const Ping ping = line.ping(number);
    check_line_ping(ping, line.sonar);
    if (line.altitudes.empty()) {
      tracker.add(ping);
    }
    plan.places.push_back(ping.world_from_sonar.position);
    plan.times.push_back(ping.time);
    plan.labelled = plan.labelled || !ping.instance.empty();
  }
  plan.altitudes = line.altitudes.empty() ? usable_altitudes(tracker.finish().altitude, line.sonar)
                                          : altitudes_for_all(line.altitudes, plan.places.size(), line.sonar);
  if (const double least = std::ranges::min(plan.altitudes); least >= line.sonar.max_range) {
    throw Error(fmt::format("{}: no bin reaches the bed: its altitude is {:.6g} m, its ranges end at {:.6g} m",
                            line.sonar.name, least, line.sonar.max_range));
  }
  return plan;
}

// A grid around all that the lines may reach.
Mosaic grid_around(std::span<const MosaicLine> lines, const std::vector<LinePlan>& plans, double cell) {
  constexpr double kUsualCells = 16e6, kMostCells = 1e8;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    const Vec3 reach(lines[line].sonar.max_range, lines[line].sonar.max_range, 0);
    for (const Vec3& place : plans[line].places) {
      low = low.cwiseMin(place - reach);
      high = high.cwiseMax(place + reach);
    }
  }
  Mosaic mosaic;
  const double area = (high.x() - low.x()) * (high.y() - low.y());
  mosaic.cell = cell > 0 ? cell : std::max(2 * lines.front().sonar.bin_length(), std::sqrt(area / kUsualCells));
  if (area / (mosaic.cell * mosaic.cell) > kMostCells) {
    throw Error(fmt::format("a mosaic of {:.0f} m x {:.0f} m with cells of {} m has {:.3g} of them; the most is {:.0e}",
                            high.x() - low.x(), high.y() - low.y(), mosaic.cell, area / (mosaic.cell * mosaic.cell),
                            kMostCells));
  }
  if (const double most = std::min(high.x() - low.x(), high.y() - low.y()) / 2; mosaic.cell > most) {
    throw Error(fmt::format("cell = {:.6g} m must be at most {:.4g} m, half of the shorter side of {:.4g} m x {:.4g} m",
                            mosaic.cell, most, high.x() - low.x(), high.y() - low.y()));
  }
  mosaic.west = std::floor(low.x() / mosaic.cell) * mosaic.cell;
  mosaic.north = std::ceil(high.y() / mosaic.cell) * mosaic.cell;
  mosaic.columns = std::max(1, static_cast<int>(std::ceil((high.x() - mosaic.west) / mosaic.cell)));
  mosaic.rows = std::max(1, static_cast<int>(std::ceil((mosaic.north - low.y()) / mosaic.cell)));
  return mosaic;
}

// Lays a line run by run, and calls merge(grid) for each.
template <typename Merge>
void lay_line(const MosaicLine& line, const LinePlan& plan, bool normalised, const Mosaic& mosaic, const Merge& merge) {
  AngleGain gain(line.sonar.beam_count);
  for (std::uint64_t number = 0; number < line.ping_count && normalised; ++number) {
    gain.add(line.ping(number), line.sonar, plan.altitudes[number]);
  }
  for (const Run& run : runs_of(plan.times)) {
    LineGrid grid(mosaic.intensity.size());
    Rasteriser rasteriser(mosaic, grid);
    const std::span<const Vec3> places = std::span(plan.places).subspan(run.begin, run.end - run.begin);
    for (std::size_t number = run.begin; number < run.end; ++number) {
      const double altitude = plan.altitudes[number];
      Ping ping = line.ping(number);
      lay_ping(normalised ? gain.applied(std::move(ping), line.sonar, altitude) : ping, line, altitude,
               spacing_at(places, number - run.begin), mosaic, rasteriser);
    }
    merge(grid);
  }
}

}  // namespace

Mosaic make_mosaic(std::span<const MosaicLine> lines, const MosaicOptions& options) {
  check_field("", {"cell", "m", at_least(0), ""}, options.cell);
  if (lines.empty() || lines.size() >= kNoLabel) {
    throw Error(fmt::format("a mosaic of {} lines must have from 1 to {}", lines.size(), kNoLabel - 1));
  }
  std::vector<LinePlan> plans;
  std::ranges::transform(lines, std::back_inserter(plans),
                         [&](const MosaicLine& line) { return plan_of(line, options); });
  Mosaic mosaic = grid_around(lines, plans, options.cell);
  const std::size_t cells = static_cast<std::size_t>(mosaic.columns) * static_cast<std::size_t>(mosaic.rows);
  mosaic.intensity.assign(cells, kUnseen);
  mosaic.angle.assign(cells, kUnseen);
  mosaic.line.assign(cells, kNoLabel);
  if (std::ranges::any_of(plans, &LinePlan::labelled)) {
    mosaic.instance.assign(cells, kNoLabel);
  }
  std::vector<float> counts(cells);
  for (std::size_t line = 0; line < lines.size(); ++line) {
    lay_line(lines[line], plans[line], options.normalised, mosaic, [&](const LineGrid& grid) {
      if (mosaic.line_count >= kNoLabel) {
        throw Error(fmt::format("a mosaic has more than {} lines, with those after pauses", mosaic.line_count));
      }
      merge(mosaic, grid, static_cast<std::uint16_t>(mosaic.line_count++), options.rule, counts);
    });
  }
  return mosaic;
}

}  // namespace insonify
