// facets.h -- set-up of triangles for the fan rasteriser: their edges and depth as linear functions of the direction.

#pragma once

#include "echo/cpu/fan_view.h"

namespace insonify {

/// Sixteen triangles in the sonar frame. A direction of azimuth az is (cos az, sin az, t) with t = tan(elevation). As
/// in homogeneous rasterisation (Olano and Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997),
/// edges and depth are linear in this vector: an edge is a lower or upper bound of t at edge_x cos az + edge_y sin az +
/// edge_0, and 1 / distance, in units of the direction's length, is plane_x cos az + plane_y sin az + plane_z t.
struct Facets {
  float edge_x[3][kBlockSize], edge_y[3][kBlockSize], edge_0[3][kBlockSize];
  float upper[3][kBlockSize];  // 1 if the edge is an upper bound, 0 if a lower bound.
  float plane_x[kBlockSize], plane_y[kBlockSize], plane_z[kBlockSize];
  float low[kBlockSize], high[kBlockSize];  // Range of azimuths [rad]; low > high if there is nothing to draw.
};

/// Computes the facets of a block. Triangles entirely above tan_high or below tan_low are not drawn.
void make_facets(const TriangleBlock& block, const FanView::Placement& placement, float tan_low, float tan_high,
                 Facets& facets);

}  // namespace insonify
