// double_passage.h -- interference of sound that goes over a rough mirror out and back, in the cells of a plan.

#pragma once

#include "echo/laws/laws.h"
#include "echo/model/flat_plan.h"

namespace insonify {

/// double_passage() of a path; 1 where its mirror has no facets.
/// @param column  Lattice column in the direction RoughPath::to_mirror.
inline float double_passage(const FlatPlan& plan, int column, const RoughPath& path) {
  if (!(path.over.variance > 0)) {
    return 1;
  }
  const OtherFacets others = other_facets(path, plan.lattice.shape == BeamShape::kCone);
  const float middle = plan.arrival_from({others.image.x, others.image.y, others.image.z}).bearing;
  const int cell = column / plan.lattice.columns_per_beam;
  return double_passage(path.over.coherence, others.variance, plan.starboard_edges[cell] - middle,
                        plan.port_edges[cell] - middle);
}

}  // namespace insonify
