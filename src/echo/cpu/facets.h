// facets.h -- triangles as the fan rasteriser draws them: where they end in each column, and how near they are.

#pragma once

#include "echo/cpu/fan_view.h"

namespace insonify {

/// Sixteen triangles around the sonar, ready to be drawn. In the half-plane of azimuth az a direction is (cos az,
/// sin az, t) with t = tan(elevation), and everything is linear in t, as in homogeneous rasterisation (Olano and Greer,
/// "Triangle scan conversion using 2D homogeneous coordinates", 1997): an edge bounds t from below or from above at
/// edge_x cos az + edge_y sin az + edge_0, and 1 / distance, in units of the direction's length, is
/// plane_x cos az + plane_y sin az + plane_z t.
struct Facets {
  float edge_x[3][kBlockSize], edge_y[3][kBlockSize], edge_0[3][kBlockSize];
  float upper[3][kBlockSize];  // 1 where the edge bounds from above, else 0.
  float plane_x[kBlockSize], plane_y[kBlockSize], plane_z[kBlockSize];
  float low[kBlockSize], high[kBlockSize];  // Azimuths; low > high where there is nothing to draw.
};

/// Works out a block's facets. What lies wholly above tan_high or below tan_low is not drawn.
void make_facets(const TriangleBlock& block, const FanView::Placement& placement, float tan_low, float tan_high,
                 Facets& facets);

}  // namespace insonify
