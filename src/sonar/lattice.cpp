// lattice.cpp -- the tables of the sampling lattice.

#include "sonar/lattice.h"

#include <cmath>
#include <numeric>

namespace insonify {
namespace {

// Neighbouring columns should differ much in their stagger: a stride near the golden section of the count visits every
// phase once and puts successive ones far apart.
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

void lay_columns(const SonarConfig& sonar, int first_phase, Lattice& lattice) {
  const std::vector<double> edges = sonar.beam_edges();
  const int per_beam = lattice.columns_per_beam;
  const int stride = stagger_stride(per_beam);
  for (int column = 0; column < lattice.columns; ++column) {
    const int beam = column / per_beam;
    const double width = (edges[beam] - edges[beam + 1]) / per_beam;
    const double azimuth = edges[beam] - (column % per_beam + 0.5) * width;
    const int mirrored = std::min(column, lattice.columns - 1 - column);
    lattice.azimuth.push_back(to_float(azimuth));
    lattice.cos_azimuth.push_back(to_float(std::cos(azimuth)));
    lattice.sin_azimuth.push_back(to_float(std::sin(azimuth)));
    lattice.column_width.push_back(to_float(width));
    lattice.phase.push_back(static_cast<std::uint16_t>((first_phase + mirrored * stride) % per_beam));
  }
}

void lay_rows(double low, double high, Lattice& lattice) {
  const int phases = lattice.columns_per_beam;
  const double first = std::tan(low);
  const double step = (std::tan(high) - first) / lattice.rows;
  lattice.tan_step = to_float(step);
  for (int phase = 0; phase < phases; ++phase) {
    lattice.first_tans.push_back(to_float(first + step * (phase + 0.5) / phases));
    double below = std::sin(low);
    for (int row = 0; row < lattice.rows; ++row) {
      const double elevation = std::atan(first + step * (row + (phase + 0.5) / phases));
      lattice.elevation.push_back(to_float(elevation));
      lattice.cos_elevation.push_back(to_float(std::cos(elevation)));
      lattice.sin_elevation.push_back(to_float(std::sin(elevation)));
      lattice.interval.push_back(to_float(std::sin(elevation) - below));
      below = std::sin(elevation);
    }
    lattice.interval.push_back(to_float(std::sin(high) - below));

    const float* interval = &lattice.interval[static_cast<std::size_t>(phase) * (lattice.rows + 1)];
    for (int row = 0; row < lattice.rows; ++row) {
      const float below_row = row == 0 ? interval[0] : 0.5F * interval[row];
      const float above_row = row + 1 == lattice.rows ? interval[row + 1] : 0.5F * interval[row + 1];
      lattice.share.push_back(below_row + above_row);
    }
  }
}

}  // namespace

Lattice::Lattice(const SonarConfig& sonar, int first_phase)
    : columns(sonar.beam_count * sonar.sampling.columns_per_beam),
      rows(sonar.sampling.rows),
      columns_per_beam(sonar.sampling.columns_per_beam) {
  const double low = sonar.elevation_center - sonar.elevation_aperture / 2;
  const double high = sonar.elevation_center + sonar.elevation_aperture / 2;
  cos_low = to_float(std::cos(low));
  sin_low = to_float(std::sin(low));
  cos_high = to_float(std::cos(high));
  sin_high = to_float(std::sin(high));
  lay_columns(sonar, first_phase, *this);
  lay_rows(low, high, *this);
}

}  // namespace insonify
