// lattice.cpp -- computes the columns, rows and weights of the sampling lattice.

#include "sonar/lattice.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "insonify/array_pattern.h"
#include "sonar/elevation_pattern.h"
#include "sonar/fan_pattern.h"

namespace insonify {
namespace {

// The arc of directions of one column, from its lower to its upper edge, divided into steps much smaller than a side
// lobe.
class ColumnArc {
 public:
  // Computes the arc of a column at a bearing [rad]. Where a cone does not reach the sector of the patterns, the arc
  // has zero length and lies at the elevation nearest to it.
  void set(BeamShape shape, double bearing, const ElevationPatterns& patterns);

  // Edges of t, the angle along the arc (see Lattice) [rad].
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

  // The t below which a share 0..1 of the rows lies; row density is proportional to the pattern's envelope.
  [[nodiscard]] double at_share(double share) const;

  // Solid angle below t per unit of Lattice::column_measure, weighted by the gain of transmission, of reception, and
  // of both; unweighted with top hats.
  [[nodiscard]] double sent_below(double t) const { return integral(sent_, t); }
  [[nodiscard]] double received_below(double t) const { return integral(received_, t); }
  [[nodiscard]] double both_below(double t) const { return integral(both_, t); }

 private:
  [[nodiscard]] double integral(const std::vector<double>& sums, double t) const;

  double low_ = 0, high_ = 0;
  std::vector<double> rows_, sent_, received_, both_;  // Cumulative integrals at the end of each step.
};

constexpr int kSteps = 2048;

// Angle t along the arc of a cone of bearing a at which it reaches an elevation: sin(elevation) = cos a sin t. Where
// the cone does not reach it, t is straight up or down.
double arc_angle(double bearing, double elevation) {
  return std::asin(std::clamp(std::sin(elevation) / std::cos(bearing), -1.0, 1.0));
}

void ColumnArc::set(BeamShape shape, double bearing, const ElevationPatterns& patterns) {
  const bool wedge = shape == BeamShape::kWedge;
  low_ = wedge ? patterns.low() : arc_angle(bearing, patterns.low());
  high_ = wedge ? patterns.high() : arc_angle(bearing, patterns.high());
  const double step = (high_ - low_) / kSteps, cos_bearing = std::cos(bearing);
  for (std::vector<double>* sums : {&rows_, &sent_, &received_, &both_}) {
    sums->assign(kSteps + 1, 0.0);
  }
  for (int i = 0; i < kSteps; ++i) {
    const double t = low_ + (i + 0.5) * step;
    const double angle = step * (wedge ? std::cos(t) : 1);  // d(solid angle) = cos t da dt, or d(sin a) dt.
    double sent = 1, received = 1, density = 1;
    if (!patterns.is_top_hat()) {
      const double elevation = wedge ? t : std::asin(cos_bearing * std::sin(t));
      received = gain_at(patterns.received(), elevation);
      sent = patterns.differ() ? gain_at(patterns.sent(), elevation) : received;
      density = patterns.envelope(elevation);
    }
    rows_[i + 1] = rows_[i] + step * density;
    sent_[i + 1] = sent_[i] + angle * sent;
    received_[i + 1] = received_[i] + angle * received;
    both_[i + 1] = both_[i] + angle * sent * received;
  }
}

double ColumnArc::at_share(double share) const {
  const double wanted = share * rows_.back();
  const auto above = std::ranges::upper_bound(rows_, wanted);
  if (above == rows_.end()) {
    return high_;
  }
  const auto end = static_cast<double>(above - rows_.begin());
  const double within = (wanted - *(above - 1)) / (*above - *(above - 1));
  return low_ + (end - 1 + within) / kSteps * (high_ - low_);
}

double ColumnArc::integral(const std::vector<double>& sums, double t) const {
  if (!(high_ > low_)) {
    return 0;
  }
  const double at = std::clamp((t - low_) / (high_ - low_) * kSteps, 0.0, static_cast<double>(kSteps));
  const int below = std::min(static_cast<int>(at), kSteps - 1);
  return std::lerp(sums[below], sums[below + 1], at - below);
}

// Step between the stagger phases of neighbouring columns. A stride near the golden section of the number of phases,
// and coprime to it, visits every phase once and makes successive phases differ much.
int stagger_stride(int phases) {
  int stride = std::max(1, static_cast<int>(std::lround(0.618 * phases)));
  while (std::gcd(stride, phases) != 1) {
    ++stride;
  }
  return stride;
}

float to_float(double value) {
  return static_cast<float>(value);
}

void make_columns(const BearingGrid& bearings, const FanPattern& transmitter, Lattice& lattice) {
  const int per_beam = lattice.columns_per_beam;
  for (int column = 0; column < lattice.columns; ++column) {
    const int beam = column / per_beam;
    const double width = bearings.width(beam) / per_beam;
    const double azimuth = bearings.port[beam] - (column % per_beam + 0.5) * width;
    const double half = 0.5 * width;
    lattice.azimuth.push_back(to_float(azimuth));
    lattice.cos_azimuth.push_back(to_float(std::cos(azimuth)));
    lattice.sin_azimuth.push_back(to_float(std::sin(azimuth)));
    lattice.column_width.push_back(to_float(width));
    const double measure =
        lattice.shape == BeamShape::kWedge ? width : std::sin(azimuth + half) - std::sin(azimuth - half);
    const double sent = transmitter.intensity(std::sin(azimuth));
    lattice.transmitted.push_back(to_float(sent));
    lattice.column_measure.push_back(to_float(sent * measure));
    lattice.touching.push_back(column % per_beam + 1 < per_beam || !bearings.gap_after(beam) ? 1 : 0);
  }
}

// Rows at ts[1] to ts[rows], between the edges ts.front() and ts.back().
struct RowSet {
  std::vector<double> ts;
  double cos_bearing;  // sin(elevation) = cos_bearing sin t; 1 for a wedge.
  const ElevationPatterns& patterns;
};

// What a sample of the rows' intervals represents, see Lattice::share.
std::vector<float> shares_of(const std::vector<float>& intervals) {
  std::vector<float> shares;
  const std::size_t rows = intervals.size() - 1;
  for (std::size_t row = 0; row < rows; ++row) {
    const float below = row == 0 ? intervals[0] : 0.5F * intervals[row];
    const float above = row + 1 == rows ? intervals[row + 1] : 0.5F * intervals[row + 1];
    shares.push_back(below + above);
  }
  return shares;
}

// Appends a set of rows to the lattice's tables.
// @param sent_below, received_below, both_below  Integrals up to t of the solid angle, see ColumnArc.
void add_row_set(const RowSet& set, const auto& sent_below, const auto& received_below, const auto& both_below,
                 Lattice& lattice) {
  const int rows = lattice.rows;
  const auto& ts = set.ts;
  lattice.edges.push_back({to_float(std::cos(ts.front())), to_float(std::sin(ts.front())),
                           to_float(std::cos(ts.back())), to_float(std::sin(ts.back()))});
  std::vector<float> sent, received;
  for (int i = 1; i <= rows + 1; ++i) {
    lattice.interval.push_back(to_float(both_below(ts[i]) - both_below(ts[i - 1])));
    sent.push_back(to_float(sent_below(ts[i]) - sent_below(ts[i - 1])));
    received.push_back(to_float(received_below(ts[i]) - received_below(ts[i - 1])));
  }
  const std::vector<float> sent_shares = shares_of(sent), received_shares = shares_of(received);
  lattice.share.insert(lattice.share.end(), sent_shares.begin(), sent_shares.end());
  for (int row = 0; row < rows; ++row) {
    const double t = ts[row + 1];
    const double elevation = lattice.shape == BeamShape::kWedge ? t : std::asin(set.cos_bearing * std::sin(t));
    lattice.elevation.push_back(to_float(elevation));
    lattice.cos_t.push_back(to_float(std::cos(t)));
    lattice.sin_t.push_back(to_float(std::sin(t)));
    lattice.row_pattern.push_back(to_float(gain_at(set.patterns.received(), elevation)));
    const bool same = !set.patterns.differ() || sent_shares[row] == received_shares[row];
    lattice.reciprocal.push_back(same ? 1.0F : received_shares[row] / sent_shares[row]);
  }
}

// Adds one set of rows per stagger phase, evenly spaced in slope.
void make_even_rows(double middle, const ElevationPatterns& patterns, Lattice& lattice) {
  const int phases = lattice.columns_per_beam;
  const double half = patterns.half();
  const double first = std::tan(-half);
  const double step = (std::tan(half) - first) / lattice.rows;
  const auto sine = [](double t) { return std::sin(t); };
  lattice.cos_middle = to_float(std::cos(middle));
  lattice.sin_middle = to_float(std::sin(middle));
  lattice.slope_step = to_float(step);
  for (int phase = 0; phase < phases; ++phase) {
    lattice.first_slopes.push_back(to_float(first + step * (phase + 0.5) / phases));
    RowSet set{{middle - half}, 1, patterns};
    for (int row = 0; row < lattice.rows; ++row) {
      set.ts.push_back(middle + std::atan(first + step * (row + (phase + 0.5) / phases)));
    }
    set.ts.push_back(middle + half);
    add_row_set(set, sine, sine, sine, lattice);
  }
}

// Adds a set of rows with the row density of an arc.
void make_rows_along(const ColumnArc& arc, int phase, double cos_bearing, const ElevationPatterns& patterns,
                     Lattice& lattice) {
  RowSet set{{arc.low()}, cos_bearing, patterns};
  for (int row = 0; row < lattice.rows; ++row) {
    set.ts.push_back(arc.at_share((row + (phase + 0.5) / lattice.columns_per_beam) / lattice.rows));
  }
  set.ts.push_back(arc.high());
  add_row_set(
      set, [&](double t) { return arc.sent_below(t); }, [&](double t) { return arc.received_below(t); },
      [&](double t) { return arc.both_below(t); }, lattice);
}

}  // namespace

Lattice::Lattice(const BearingGrid& bearings, int columns_of_each, const SonarConfig& sonar,
                 const ElevationPatterns& patterns, int first_phase) {
  shape = bearings.shape;
  even_rows = shape == BeamShape::kWedge && patterns.is_top_hat();
  columns = bearings.count() * columns_of_each;
  rows = sonar.sampling.rows.value_or(Sampling::kRows);
  columns_per_beam = columns_of_each;
  make_columns(bearings, FanPattern(sonar.transmit_width), *this);
  const int phases = columns_per_beam, stride = stagger_stride(phases);
  const auto phase_of = [&](int column) {
    return (first_phase + std::min(column, columns - 1 - column) * stride) % phases;
  };
  ColumnArc arc;
  if (shape == BeamShape::kCone) {
    // Each column's edges are its own.
    for (int column = 0; column < columns; ++column) {
      arc.set(shape, static_cast<double>(azimuth[column]), patterns);
      make_rows_along(arc, phase_of(column), std::cos(static_cast<double>(azimuth[column])), patterns, *this);
      row_set.push_back(static_cast<std::uint32_t>(column));
    }
    return;
  }
  if (even_rows) {
    make_even_rows(sonar.elevation_center, patterns, *this);
  } else {
    arc.set(shape, 0, patterns);
    for (int phase = 0; phase < phases; ++phase) {
      make_rows_along(arc, phase, 1, patterns, *this);
    }
  }
  for (int column = 0; column < columns; ++column) {
    row_set.push_back(static_cast<std::uint32_t>(phase_of(column)));
  }
}

double Lattice::beam_angle(int beam) const {
  double sum = 0;
  for (int column = beam * columns_per_beam; column < (beam + 1) * columns_per_beam; ++column) {
    double column_sum = 0;
    for (int i = 0; i <= rows; ++i) {
      column_sum += static_cast<double>(intervals(column)[i]);
    }
    sum += column_sum * static_cast<double>(column_measure[column]);
  }
  return sum;
}

}  // namespace insonify
