// beam_echo.cpp -- centre of gravity of an echo, and the zero of its phase by weighted least squares.

#include "survey/beam_echo.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace insonify {
namespace {

constexpr double kBinDeviation = 0.28867513459481287;  // 1 / sqrt(12): of a place that is somewhere in a bin.

// Sums for a line through phases.
struct LineSums {
  double weight = 0, squares = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(double at, double phase, double by) {
    weight += by;
    squares += by * by;
    x += by * at;
    y += by * phase;
    xx += by * at * at;
    xy += by * at * phase;
    yy += by * phase * phase;
  }
};

// A line phase = slope (place - zero), and the variance of phases about it.
struct PhaseLine {
  double slope = 0, zero = 0, middle = 0, spread = 0, variance = 0;
  double samples = 0;  // Equally weighted ones that would be as certain.
};

std::optional<PhaseLine> line_through(const LineSums& sums) {
  if (!(sums.weight > 0)) {
    return {};
  }
  const double x = sums.x / sums.weight, y = sums.y / sums.weight;
  const double xx = sums.xx / sums.weight - x * x, xy = sums.xy / sums.weight - x * y;
  const double yy = sums.yy / sums.weight - y * y;
  if (!(xx > 0) || xy == 0) {
    return {};
  }
  const double slope = xy / xx;
  return PhaseLine{.slope = slope,
                   .zero = x - y / slope,
                   .middle = x,
                   .spread = xx,
                   .variance = std::max(0.0, yy - slope * xy),
                   .samples = sums.weight * sums.weight / sums.squares};
}

// Phases of a snippet averaged over `length` bins as numbers on a circle, weighted by intensity: noise of single bins
// would wrap.
struct MeanPhase {
  double place, phase, weight;
};

std::vector<MeanPhase> mean_phases(const BeamRow& row, const Snippet& snippet, int length) {
  std::vector<MeanPhase> means;
  for (int begin = snippet.begin; begin + length <= snippet.end; begin += length) {
    std::complex<double> sum = 0;
    double place = 0, weight = 0;
    for (int bin = begin; bin < begin + length; ++bin) {
      const double intensity = row.intensity[static_cast<std::size_t>(bin)];
      sum += std::polar(intensity, static_cast<double>(row.phase[static_cast<std::size_t>(bin)]));
      place += intensity * (bin + 0.5);
      weight += intensity;
    }
    if (weight > 0) {
      means.push_back({place / weight, std::arg(sum), std::abs(sum)});
    }
  }
  return means;
}

// The steepest run of phases through 0 in the right direction: from where they are nearest to 0, as far as they go on
// towards the ends without wrapping.
LineSums sums_of(const std::vector<MeanPhase>& means, double zero, double slope, std::size_t& count) {
  constexpr double kFarthest = 0.6 * std::numbers::pi;  // From the line: beyond, a phase has wrapped.
  constexpr double kEnd = 0.75 * std::numbers::pi;      // Of the line: there noise wraps phases.
  LineSums sums;
  count = 0;
  for (const MeanPhase& mean : means) {
    const double expected = slope * (mean.place - zero);
    if (std::abs(expected) < kEnd &&
        std::abs(std::remainder(mean.phase - expected, 2 * std::numbers::pi)) < kFarthest) {
      sums.add(mean.place, expected + std::remainder(mean.phase - expected, 2 * std::numbers::pi), mean.weight);
      ++count;
    }
  }
  return sums;
}

}  // namespace

std::optional<BeamEcho> find_echo(const BeamRow& row, const Snippet& gate, float least, bool to_port) {
  if (gate.begin >= gate.end) {  // What lies beyond the ring may lie beyond the last bin.
    return {};
  }
  const auto begin = row.smoothed.begin();
  const auto peak = std::max_element(begin + gate.begin, begin + gate.end);
  if (!(*peak > 0) || *peak < least) {
    return {};
  }
  BeamEcho echo;
  echo.snippet = snippet_around(row, static_cast<int>(peak - begin), gate.begin, gate.end);
  echo.range = range_by_amplitude(row, echo.snippet);
  const std::optional<BeamRange> by_phase = range_by_phase(row, echo.snippet, to_port);
  if (by_phase && by_phase->deviation < echo.range.deviation) {
    echo.range = *by_phase;
    echo.by_phase = true;
  }
  return echo;
}

Snippet snippet_around(const BeamRow& row, int peak, int first, int last) {
  const float floor = 0.1F * row.smoothed[static_cast<std::size_t>(peak)];
  Snippet snippet{peak, peak + 1};
  for (int bin = peak - 1; bin >= first && snippet.begin - bin <= row.bridged + 1; --bin) {
    snippet.begin = row.smoothed[static_cast<std::size_t>(bin)] >= floor ? bin : snippet.begin;
  }
  for (int bin = peak + 1; bin < last && bin - snippet.end <= row.bridged; ++bin) {
    snippet.end = row.smoothed[static_cast<std::size_t>(bin)] >= floor ? bin + 1 : snippet.end;
  }
  return snippet;
}

BeamRange range_by_amplitude(const BeamRow& row, const Snippet& snippet) {
  double weight = 0, sum = 0;
  for (int bin = snippet.begin; bin < snippet.end; ++bin) {
    const double intensity = row.intensity[static_cast<std::size_t>(bin)];
    weight += intensity;
    sum += intensity * (bin - snippet.begin + 0.5);
  }
  // Intensities of speckle have a variance of half their mean square; as many bins as resolve nothing vary together.
  const double centre = sum / weight;
  double squares = 0;
  for (int bin = snippet.begin; bin < snippet.end; ++bin) {
    const double intensity = row.intensity[static_cast<std::size_t>(bin)], off = bin - snippet.begin + 0.5 - centre;
    squares += 0.5 * intensity * intensity * off * off;
  }
  const double variance = row.resolution * squares / (weight * weight);
  return {snippet.begin + centre, std::sqrt(variance + kBinDeviation * kBinDeviation)};
}

std::optional<BeamRange> range_by_phase(const BeamRow& row, const Snippet& snippet, bool to_port) {
  constexpr int kMeans = 24, kLeastMeans = 8;
  constexpr double kLeastSamples = 4;
  const int bins = snippet.end - snippet.begin;
  const int length = std::max(1, bins / kMeans);
  if (row.phase.empty() || bins < kLeastMeans * length) {
    return {};
  }
  // Means over less than the resolution vary together.
  const double independent = std::min(1.0, static_cast<double>(length) / row.resolution);
  const std::vector<MeanPhase> means = mean_phases(row, snippet, length);
  if (means.size() < kLeastMeans) {
    return {};
  }
  // From the slope of a beam that fills the snippet, through the phase nearest to 0 at the centre of intensity, the
  // line is fitted again and again to the phases beside it.
  const BeamRange centre = range_by_amplitude(row, snippet);
  double slope = (to_port ? 1 : -1) * 1.5 * std::numbers::pi / bins, zero = centre.place;
  std::optional<PhaseLine> line;
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds; ++round) {
    std::size_t count = 0;
    const LineSums sums = sums_of(means, zero, slope, count);
    line = count >= kLeastMeans ? line_through(sums) : std::nullopt;
    if (!line || (line->slope > 0) != to_port || independent * line->samples < kLeastSamples) {
      return {};
    }
    slope = line->slope;
    zero = line->zero;
  }
  if (zero < snippet.begin || zero > snippet.end) {
    return {};
  }
  const double off = zero - line->middle;
  const double variance =
      line->variance * (1 + off * off / line->spread) / ((independent * line->samples - 2) * slope * slope);
  return BeamRange{zero, std::sqrt(variance + kBinDeviation * kBinDeviation)};
}

}  // namespace insonify
