// deposit.cpp -- echoes into cells.

#include "echo/deposit.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/beam_cells.h"

namespace insonify {
namespace {

// How much farther a surface may go on past its last sample than between the last two.
constexpr float kMostStretch = 1.5F;

}  // namespace

INSONIFY_VECTOR_CLONES [[gnu::flatten]] void deposit_column(const PingPlan& plan, int column, const HitColumn& hits,
                                                            EchoGrid& grid) {
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
      const float wished = (range_end - plan.first_bin_at) * plan.bins_per_metre;
      end = wished > here - most ? std::min(wished, here + most) : here - most;  // Also where facing_end is 0.
    }
    const float beyond = hits.reach[row] + kShortestStretch;
    const float low = std::min(here, end) - beyond;
    const float high = std::max(here, end) + beyond;
    cells.add_stretch(low, high, hits.power[row], 0, weight / (high - low), hits.surface[row], elevation[row]);
  };

  add_alone(0, 1, lattice.cos_low, lattice.sin_low, interval[0] * width);
  for (int row = 0; row + 1 < rows; ++row) {
    const int next = row + 1;
    if (hits.joined[row] != 0) {
      cells.add_stretch(hits.low[row], hits.high[row], hits.power_low[row], hits.rise[row], hits.density[row],
                        hits.surface[row], 0.5F * (elevation[row] + elevation[next]));
    } else {
      const float cos_middle = 0.5F * (cos_el[row] + cos_el[next]);
      const float sin_middle = 0.5F * (sin_el[row] + sin_el[next]);
      const float weight = interval[next] * width;
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
