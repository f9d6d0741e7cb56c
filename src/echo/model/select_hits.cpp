// select_hits.cpp -- systematic sampling along a column.

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"
#include "echo/laws/laws.h"
#include "echo/model/hit_column.h"

namespace insonify {
namespace {

// Probability of each hit, as a float and in units of 2^-32; 0 where nothing was hit.
INSONIFY_VECTOR_CLONES
void share_out(int rows, const float* __restrict__ range, const float* __restrict__ facing,
               const float* __restrict__ reflectivity, float* __restrict__ share, std::uint32_t* __restrict__ turn) {
  for (int row = 0; row < rows; ++row) {
    const float own = paper_share(facing[row], reflectivity[row]);
    share[row] = range[row] > 0 ? own : 0.0F;
    turn[row] = share_in_turns(share[row]);
  }
}

// Replaces probabilities by weights.
INSONIFY_VECTOR_CLONES
void select(int rows, const std::uint32_t* __restrict__ turned, float* __restrict__ share_to_selected) {
  for (int row = 0; row < rows; ++row) {
    share_to_selected[row] = selected_weight(share_to_selected[row], turned[row]);
  }
}

// Replaces reflectances by probabilities, see share_out_energy().
INSONIFY_VECTOR_CLONES
void share_out_reflectance(int rows, const float* __restrict__ sent, float scale, float* __restrict__ reflectance,
                           std::uint32_t* __restrict__ turn) {
  for (int row = 0; row < rows; ++row) {
    reflectance[row] = calibrated_share(reflectance[row], sent[row], scale);
    turn[row] = share_in_turns(reflectance[row]);
  }
}

// `calibrated`: the probability is the square root of the energy that a hit reflects, |R|^2 times the solid angle of
// its sample weighted by the pattern on transmission, times full_energy_scale().
void share_out_energy(const FlatPlan& plan, int column, int rows, const HitColumn& hits, float* share,
                      std::uint32_t* turn) {
  const float* const sent = plan.lattice.shares(column);
  const float most = *std::max_element(sent, sent + plan.lattice.rows);
  plan.scatter.fill_mirrored(rows, hits.surface, hits.facing, share);
  if (hits.has_relief) {
    for (int row = 0; row < rows; ++row) {
      share[row] *= hits.texture[row] * hits.texture[row];
    }
  }
  share_out_reflectance(rows, sent, full_energy_scale(most), share, turn);
}

// Systematic sampling, see select_hits().
void select_some(const FlatPlan& plan, int column, int rows, const HitColumn& hits, std::uint32_t* turned) {
  if (plan.model == EchoModel::kCalibrated) {
    share_out_energy(plan, column, rows, hits, hits.selected, turned);
  } else {
    share_out(rows, hits.range, hits.facing, hits.reflectivity, hits.selected, turned);
  }
  const std::uint32_t start = selection_start(static_cast<std::uint32_t>(column), plan.stagger);
  for (int first = 0; first < rows; first += kSelectionRows) {
    std::uint32_t sum = start;
    for (int row = first; row < std::min(first + kSelectionRows, rows); ++row) {
      turned[row] = sum += turned[row];
    }
  }
  select(rows, turned, hits.selected);
}

}  // namespace

void select_hits(const FlatPlan& plan, SecondarySampling sampling, int column, int rows, const HitColumn& hits,
                 std::uint32_t* turned) {
  if (sampling == SecondarySampling::kAll) {
    for (int row = 0; row < rows; ++row) {
      hits.selected[row] = hits.surface[row] == kNoSurface ? 0.0F : 1.0F;
    }
  } else if (sampling == SecondarySampling::kSome) {
    select_some(plan, column, rows, hits, turned);
  }
  if (hits.has_relief && sampling != SecondarySampling::kNone) {
    for (int row = 0; row < rows; ++row) {
      hits.selected[row] *= hits.escapes[row];
    }
  }
}

}  // namespace insonify
