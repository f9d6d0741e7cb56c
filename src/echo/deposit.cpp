// deposit.cpp -- echoes into cells.

#include "echo/deposit.h"

#include <algorithm>
#include <cmath>

namespace insonify {
namespace {

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

}  // namespace

void deposit_column(const PingPlan& plan, int column, const HitColumn& hits, EchoGrid& grid) {
  const Lattice& lattice = plan.lattice;
  const float* cos_el = lattice.cos_elevations(column);
  const float* sin_el = lattice.sin_elevations(column);
  const float* elevation = lattice.elevations(column);
  const float* interval = lattice.intervals(column);
  const float width = lattice.column_width[column];
  const int rows = lattice.rows;
  BeamCells cells(grid, 1, column / lattice.columns_per_beam);
  // Part of a sample's stretch that ends alone: from the sample along its tangent plane to another direction, if the
  // neighbour on the other side shows that the surface goes on like that.
  const auto add_alone = [&](int row, int behind, float cos_end, float sin_end, float weight) {
    if (hits.surface[row] == kNoSurface) {
      return;
    }
    const float here = hits.position[row];
    float end = here;
    if (behind >= 0 && behind < rows && hits.joined[std::min(row, behind)] != 0) {
      const float facing_end = hits.normal_along[row] * cos_end + hits.normal_up[row] * sin_end;
      const float range_end = hits.range[row] * hits.facing[row] / facing_end;
      const float most = kMostStretch * std::abs(here - hits.position[behind]);
      end = std::clamp((range_end - plan.first_bin_at) * plan.bins_per_metre, here - most, here + most);
    }
    cells.add_stretch(here, end, hits.reach[row], hits.power[row], hits.power[row], weight, hits.surface[row],
                      elevation[row]);
  };

  add_alone(0, 1, lattice.cos_low, lattice.sin_low, interval[0] * width);
  for (int row = 0; row + 1 < rows; ++row) {
    const int next = row + 1;
    const float weight = interval[next] * width;
    if (hits.joined[row] != 0) {
      cells.add_stretch(hits.position[row], hits.position[next], 0.5F * (hits.reach[row] + hits.reach[next]),
                        hits.power[row], hits.power[next], weight, hits.surface[row],
                        0.5F * (elevation[row] + elevation[next]));
    } else {
      const float cos_middle = 0.5F * (cos_el[row] + cos_el[next]);
      const float sin_middle = 0.5F * (sin_el[row] + sin_el[next]);
      add_alone(row, row - 1, cos_middle, sin_middle, 0.5F * weight);
      add_alone(next, next + 1, cos_middle, sin_middle, 0.5F * weight);
    }
  }
  add_alone(rows - 1, rows - 2, lattice.cos_high, lattice.sin_high, interval[rows] * width);
}

void deposit(const PingPlan& plan, const Echo& echo, EchoGrid& grid) {
  const int beam = plan.beam_of(echo.azimuth);
  if (beam >= 0) {
    const float position = (0.5F * echo.path_length - plan.first_bin_at) * plan.bins_per_metre;
    BeamCells(grid, echo.order, beam).add_point(position, echo.power, echo.weight, echo.surface, echo.elevation);
  }
}

}  // namespace insonify
