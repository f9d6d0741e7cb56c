// slant_range.cpp -- lays the footprints of bins onto cells of the bed.

#include "insonify/survey/slant_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "insonify/error.h"
#include "insonify/field.h"
#include "survey/checks.h"

namespace insonify {
namespace {

// Without the checks.
double on_level_bed(double slant, double altitude) {
  return slant > altitude ? std::sqrt((slant - altitude) * (slant + altitude)) : 0;
}

// Near edges of the bins on the bed, and the far edge of the last [m].
std::vector<double> edges_on_bed(const SonarConfig& sonar, double altitude) {
  std::vector<double> edges;
  for (int bin = 0; bin <= sonar.bin_count; ++bin) {
    edges.push_back(on_level_bed(sonar.min_range + bin * sonar.bin_length(), altitude));
  }
  return edges;
}

double in_plane(double altitude, const Ping& ping, const SonarConfig& sonar) {
  check_altitude(altitude);
  check_line_ping(ping, sonar);
  const double cosine = plane_cosine(ping.world_from_sonar);
  if (!(cosine > 0)) {
    throw Error(fmt::format("ping {} of {}: the sonar points straight up or down", ping.number, sonar.name));
  }
  return altitude / cosine;
}

// Mean over a cell from..to of what bins with these edges hold; `bin` is the first that may reach into it.
float mean_in_cell(const Ping& ping, int beam, const std::vector<double>& edges, double from, double to, int& bin) {
  double sum = 0, covered = 0;
  while (bin < ping.bin_count && edges[bin + 1] <= from) {
    ++bin;
  }
  for (int i = bin; i < ping.bin_count && edges[i] < to; ++i) {
    const double length = std::min(to, edges[i + 1]) - std::max(from, edges[i]);
    const float value = ping.intensity[ping.index(i, beam)];
    if (length > 0 && !std::isnan(value)) {
      sum += length * double{value};
      covered += length;
    }
  }
  return covered > 0 ? static_cast<float>(sum / covered) : std::numeric_limits<float>::quiet_NaN();
}

// Angle below the horizontal of the bed at a slant range [deg]; 90 above the bed.
double degrees_below(double slant, double altitude) {
  return degrees_from_radians(std::asin(std::min(1.0, altitude / slant)));
}

// Steps of 0.1 dB; silence lies below all others.
int level_step(float intensity) {
  constexpr double kStepsPerDecade = 100;
  return intensity > 0 ? static_cast<int>(std::floor(kStepsPerDecade * std::log10(double{intensity})))
                       : std::numeric_limits<int>::min();
}

}  // namespace

double ground_range(double slant_range, double altitude) {
  check_altitude(altitude);
  return on_level_bed(slant_range, altitude);
}

GroundGrid ground_grid_of(const SonarConfig& sonar) {
  return {sonar.bin_length(), static_cast<int>(std::ceil(sonar.max_range / sonar.bin_length() * (1 - 1e-12)))};
}

std::vector<float> slant_to_ground(const Ping& ping, const SonarConfig& sonar, double altitude,
                                   const GroundGrid& grid) {
  check_field("", {"cell", "m", greater_than(0), ""}, grid.cell);
  check_field("", {"count", "", at_least(1), ""}, grid.count);
  const std::vector<double> edges = edges_on_bed(sonar, in_plane(altitude, ping, sonar));
  std::vector<float> cells(static_cast<std::size_t>(grid.count) * static_cast<std::size_t>(ping.beam_count));
  for (int beam = 0; beam < ping.beam_count; ++beam) {
    int bin = 0;
    for (int cell = 0; cell < grid.count; ++cell) {
      cells[static_cast<std::size_t>(cell) * ping.beam_count + beam] =
          mean_in_cell(ping, beam, edges, cell * grid.cell, (cell + 1) * grid.cell, bin);
    }
  }
  return cells;
}

void AngleGain::add(const Ping& ping, const SonarConfig& sonar, double altitude) {
  const double height = in_plane(altitude, ping, sonar);
  means_.clear();
  for (int bin = 0; bin < ping.bin_count; ++bin) {
    if (sonar.bin_range(bin) < height) {
      continue;
    }
    const double degrees = degrees_below(sonar.bin_range(bin), height);
    for (int beam = 0; beam < ping.beam_count; ++beam) {
      const float value = ping.intensity[ping.index(bin, beam)];
      if (std::isfinite(value)) {
        Class& at = sides_[beam][std::min(static_cast<std::size_t>(degrees), sides_[beam].size() - 1)];
        for (Step* step : {&at.all, &at.steps[level_step(value)]}) {
          step->sum += double{value};
          step->count += 1;
        }
        at.degrees += degrees;
      }
    }
  }
}

// Mean of the middle half; where that is silent, as of small counts, of all.
double AngleGain::usual_of(const Class& bins) {
  double sum = 0, count = 0, before = 0;
  const double begin = 0.25 * bins.all.count, end = 0.75 * bins.all.count;
  for (const auto& [level, step] : bins.steps) {
    const double inside = std::min(end, before + step.count) - std::max(begin, before);
    if (inside > 0) {
      sum += inside * step.sum / step.count;
      count += inside;
    }
    before += step.count;
  }
  return sum > 0 ? sum / count : bins.all.sum / bins.all.count;
}

const std::vector<std::vector<AngleGain::Mean>>& AngleGain::means() const {
  if (means_.empty()) {
    for (const Side& side : sides_) {
      std::vector<Mean>& means = means_.emplace_back();
      for (const Class& at : side) {
        if (at.all.sum > 0) {
          means.push_back({at.degrees / at.all.count, usual_of(at)});
        }
      }
    }
  }
  return means_;
}

double AngleGain::mean_of_all() const {
  double sum = 0, count = 0;
  for (const std::vector<Mean>& side : means()) {
    for (const Mean& at : side) {
      sum += at.level;
      count += 1;
    }
  }
  return sum / count;
}

Ping AngleGain::applied(Ping ping, const SonarConfig& sonar, double altitude) const {
  const double height = in_plane(altitude, ping, sonar), all = mean_of_all();
  for (int beam = 0; beam < ping.beam_count; ++beam) {
    const std::vector<Mean>& means = this->means()[beam];
    if (means.empty()) {
      continue;
    }
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      const double degrees = degrees_below(sonar.bin_range(bin), height);
      const auto next = std::ranges::lower_bound(means, degrees, {}, &Mean::degrees);
      double level = next == means.end() ? means.back().level : next->level;
      if (next != means.end() && next != means.begin()) {
        const Mean& before = *(next - 1);
        level = std::lerp(before.level, next->level, (degrees - before.degrees) / (next->degrees - before.degrees));
      }
      float& value = ping.intensity[ping.index(bin, beam)];
      value = static_cast<float>(double{value} / level * all);
    }
  }
  return ping;
}

}  // namespace insonify
