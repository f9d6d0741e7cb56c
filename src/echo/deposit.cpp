// deposit.cpp -- echoes into cells.

#include "echo/deposit.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

// Neighbours lie on one unbroken surface when each is where the other's tangent plane says, give or take a bin and this
// share of the distance between them: curved surfaces pass, edges and shadows do not.
constexpr float kBend = 0.3F;

// Added to the cosine of incidence before it divides: bounds the reach of surfaces that are only grazed.
constexpr float kLeastFacing = 0.1F;

// How much farther a surface may go on past its last sample than between the last two.
constexpr float kMostStretch = 1.5F;

// The cells of one beam, ready for adding. Positions are in bins, from the near edge of bin 0.
struct BeamCells {
  float* energy;
  float* weight;
  EchoGrid::Label* labels;
  int bins;

  BeamCells(EchoGrid& grid, int order, int beam)
      : energy(grid.energy(order, beam).data()),
        weight(grid.weight(order, beam).data()),
        labels(grid.labels(beam).data()),
        bins(grid.bin_count()) {}

  // Boyer and Moore's majority vote (1981), weighted by energy: whoever holds more than half of a cell leads it in the
  // end.
  void vote(int bin, float added, SurfaceLabel surface, float elevation) {
    EchoGrid::Label& label = labels[bin];
    if (surface_label(label.instance, label.material) == surface) {
      label.lead += added;
    } else if (label.lead > added) {
      label.lead -= added;
      return;
    } else {
      label = {instance_of(surface), material_of(surface), added - label.lead, 0, 0};
    }
    label.energy += added;
    label.elevation_moment += added * elevation;
  }

  void add(int bin, float energy_added, float weight_added, SurfaceLabel surface, float elevation) {
    energy[bin] += energy_added;
    weight[bin] += weight_added;
    vote(bin, energy_added, surface, elevation);
  }

  void add_point(float position, float power, float weight_added, SurfaceLabel surface, float elevation) {
    if (position >= 0 && position < static_cast<float>(bins)) {
      add(static_cast<int>(position), power * weight_added, weight_added, surface, elevation);
    }
  }

  // Spreads a stretch of surface evenly over the positions between its ends; power changes linearly along it.
  void add_stretch(float from, float to, float reach, float power_from, float power_to, float weight_added,
                   SurfaceLabel surface, float elevation) {
    if (from > to) {
      std::swap(from, to);
      std::swap(power_from, power_to);
    }
    from -= reach;
    to += reach;
    if (to < 0 || from >= static_cast<float>(bins)) {
      return;
    }
    const int first = static_cast<int>(std::max(from, 0.0F));
    const int last = std::min(static_cast<int>(to), bins - 1);
    if (first == last && from >= 0 && to < static_cast<float>(bins)) {
      add(first, 0.5F * (power_from + power_to) * weight_added, weight_added, surface, elevation);
      return;
    }
    const float per_bin = 1 / (to - from);
    for (int bin = first; bin <= last; ++bin) {
      const float low = std::max(from, static_cast<float>(bin));
      const float high = std::min(to, static_cast<float>(bin + 1));
      const float share = (high - low) * per_bin * weight_added;
      const float along = (0.5F * (low + high) - from) * per_bin;
      add(bin, share * (power_from + (power_to - power_from) * along), share, surface, elevation);
    }
  }
};

// Where the tangent plane of a hit is met in another direction of its column [m]; negative or huge when it is not.
float plane_range(const HitColumn& hits, int row, float cos_other, float sin_other) {
  const float other = hits.normal_along[row] * cos_other + hits.normal_up[row] * sin_other;
  return hits.range[row] * hits.facing[row] / other;
}

}  // namespace

void measure_column(const PingPlan& plan, int column, HitColumn& hits) {
  const Lattice& lattice = plan.lattice;
  const float* cos_el = lattice.cos_elevations(column);
  const float* sin_el = lattice.sin_elevations(column);
  const float half_width = 0.5F * lattice.column_width[column];
  for (int row = 0; row < hits.rows; ++row) {
    const float facing = hits.normal_along[row] * cos_el[row] + hits.normal_up[row] * sin_el[row];
    // On the tangent plane d(range)/d(azimuth) = -range (normal . d(direction)/d(azimuth)) / (normal . direction).
    const float slope = std::abs(hits.normal_across[row]) * cos_el[row] / (std::abs(facing) + kLeastFacing);
    hits.facing[row] = facing;
    hits.reach[row] = half_width * hits.range[row] * slope;
  }
}

void deposit_column(const PingPlan& plan, int column, const HitColumn& hits, EchoGrid& grid) {
  const Lattice& lattice = plan.lattice;
  const float* cos_el = lattice.cos_elevations(column);
  const float* sin_el = lattice.sin_elevations(column);
  const float* elevation = lattice.elevations(column);
  const float* interval = lattice.intervals(column);
  const float width = lattice.column_width[column];
  const float bin_length = 1 / plan.bins_per_metre;
  BeamCells cells(grid, 1, column / lattice.columns_per_beam);
  const auto position = [&](float range) { return (range - plan.first_bin_at) * plan.bins_per_metre; };
  const auto unbroken = [&](int a, int b) {
    const float apart = std::abs(hits.range[a] - hits.range[b]);
    if (apart < bin_length) {
      return true;
    }
    const float tolerance = bin_length + kBend * apart;
    const float b_seen_from_a = plane_range(hits, a, cos_el[b], sin_el[b]);
    const float a_seen_from_b = plane_range(hits, b, cos_el[a], sin_el[a]);
    return std::abs(b_seen_from_a - hits.range[b]) < tolerance && std::abs(a_seen_from_b - hits.range[a]) < tolerance;
  };
  // Part of a sample's stretch that ends alone: from the sample along its tangent plane to another direction, if the
  // neighbour on the other side shows that the surface goes on like that.
  const auto add_alone = [&](int row, int behind, float cos_end, float sin_end, float weight) {
    if (hits.surface[row] == kNoSurface) {
      return;
    }
    float end = hits.range[row];
    if (behind >= 0 && behind < hits.rows && hits.surface[behind] == hits.surface[row] && unbroken(row, behind)) {
      const float most = kMostStretch * std::abs(hits.range[row] - hits.range[behind]);
      end = std::clamp(plane_range(hits, row, cos_end, sin_end), end - most, end + most);
    }
    cells.add_stretch(position(hits.range[row]), position(end), hits.reach[row] * plan.bins_per_metre, hits.power[row],
                      hits.power[row], weight, hits.surface[row], elevation[row]);
  };

  add_alone(0, 1, lattice.cos_low, lattice.sin_low, interval[0] * width);
  for (int row = 0; row + 1 < hits.rows; ++row) {
    const int next = row + 1;
    const float weight = interval[next] * width;
    if (hits.surface[row] == hits.surface[next] && hits.surface[row] != kNoSurface && unbroken(row, next)) {
      const float reach = 0.5F * (hits.reach[row] + hits.reach[next]) * plan.bins_per_metre;
      cells.add_stretch(position(hits.range[row]), position(hits.range[next]), reach, hits.power[row], hits.power[next],
                        weight, hits.surface[row], 0.5F * (elevation[row] + elevation[next]));
    } else {
      const float cos_middle = 0.5F * (cos_el[row] + cos_el[next]);
      const float sin_middle = 0.5F * (sin_el[row] + sin_el[next]);
      add_alone(row, row - 1, cos_middle, sin_middle, 0.5F * weight);
      add_alone(next, next + 1, cos_middle, sin_middle, 0.5F * weight);
    }
  }
  add_alone(hits.rows - 1, hits.rows - 2, lattice.cos_high, lattice.sin_high, interval[hits.rows] * width);
}

void deposit(const PingPlan& plan, const Echo& echo, EchoGrid& grid) {
  const int beam = plan.beam_of(echo.azimuth);
  if (beam >= 0) {
    const float position = (0.5F * echo.path_length - plan.first_bin_at) * plan.bins_per_metre;
    BeamCells(grid, echo.order, beam).add_point(position, echo.power, echo.weight, echo.surface, echo.elevation);
  }
}

}  // namespace insonify
