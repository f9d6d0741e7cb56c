// see_through.cpp -- two-way transmission through the hits of a column.

#include "echo/model/see_through.h"

#include <algorithm>

#include "base/vector_math.h"

namespace insonify {
namespace {

// Replaces |T|^2 by passed_on().
INSONIFY_VECTOR_CLONES
void pass_on(int rows, const float* __restrict__ reached, float* __restrict__ transmittance_to_passed) {
  for (int row = 0; row < rows; ++row) {
    transmittance_to_passed[row] = passed_on(reached[row], transmittance_to_passed[row]);
  }
}

}  // namespace

void find_passing(const FlatPlan& plan, HitColumn& hits) {
  if (!plan.sees_through()) {
    return;
  }
  const int rows = evaluated_rows(plan.lattice, hits);
  plan.scatter.fill_passed(rows, hits.surface, hits.facing, hits.passed);
  if (!hits.passing) {
    std::fill_n(hits.reached, rows, 1.0F);
  }
  pass_on(rows, hits.reached, hits.passed);
  hits.passing = hits.passing || any_passes_on(plan, hits);
}

void weaken_behind(const FlatPlan& plan, const HitColumn& hits) {
  if (!hits.passing) {
    return;
  }
  const int rows = evaluated_rows(plan.lattice, hits);
  for (int row = 0; row < rows; ++row) {
    hits.power[row] *= hits.reached[row];
  }
}

bool any_passes_on(const FlatPlan& plan, const HitColumn& hits) {
  const int rows = evaluated_rows(plan.lattice, hits);
  for (int row = 0; row < rows; ++row) {
    if (hits.passed[row] > 0) {
      return true;
    }
  }
  return false;
}

}  // namespace insonify
