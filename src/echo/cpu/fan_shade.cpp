// fan_shade.cpp -- fills in the hits of a column from the nearest triangles of the raster.

#include <algorithm>

#include "base/vector_math.h"
#include "echo/cpu/fan_raster.h"

namespace insonify {
namespace {

INSONIFY_VECTOR_CLONES
void measure_ranges(int rows, std::uint32_t nothing, const std::uint32_t* __restrict__ nearest,
                    const float* __restrict__ nearness, const Lattice& lattice, int column, float* __restrict__ range) {
  const float *cos_el = lattice.cosines(column), *sin_el = lattice.sines(column);
  for (int row = 0; row < rows; ++row) {
    const float met = 1 / ((cos_el[row] * lattice.cos_middle + sin_el[row] * lattice.sin_middle) * nearness[row]);
    range[row] = nearest[row] == nothing ? 0.0F : met;
  }
}

}  // namespace

INSONIFY_VECTOR_CLONES
int FanRaster::read(int column, const HitColumn& hits) {
  const Lattice& lattice = plan_->lattice;
  const std::size_t start = static_cast<std::size_t>(column - first_column_) * stride_;
  const std::uint32_t* nearest = &nearest_[start];
  const int rows = lattice.rows;
  measure_ranges(rows, kNothing, nearest, &nearness_[start], lattice, column, hits.range);
  const float cos_az = lattice.cos_azimuth[column], sin_az = lattice.sin_azimuth[column];
  const float first_slope = lattice.first_slope(column), slope_step = lattice.slope_step;
  SurfaceLabel* __restrict__ surface = hits.surface;
  std::uint32_t* __restrict__ in_mesh = hits.triangle;
  float* __restrict__ normal_x = hits.normal_x;
  float* __restrict__ normal_y = hits.normal_y;
  float* __restrict__ normal_z = hits.normal_z;
  float* __restrict__ reflectivity = hits.reflectivity;
  int rows_met = 0;
  for (int row = 0; row < rows;) {
    // Consecutive rows with the same triangle. Sixteen are written at a time; surplus ones are overwritten later.
    const std::uint32_t triangle = nearest[row];
    int end = row + 1;
    while (end < rows && nearest[end] == triangle) {
      ++end;
    }
    const Shading& shading = triangle == kNothing ? no_shading_ : known_shading(triangle);
    rows_met = triangle == kNothing ? rows_met : end;
    // The normal in the direction of slope s in this column is normal_0 + s normal_1: see shading_of().
    const Vec3f level = shading.edges[0] * cos_az + shading.edges[1] * sin_az, up = shading.edges[2];
    const Vec3f normal_0 = lattice.cos_middle * level + lattice.sin_middle * up;
    const Vec3f normal_1 = lattice.cos_middle * up - lattice.sin_middle * level;
    const float x0 = normal_0.x(), y0 = normal_0.y(), z0 = normal_0.z();
    const float x1 = normal_1.x(), y1 = normal_1.y(), z1 = normal_1.z();
    for (; row < end; row += kTogether) {
#pragma GCC unroll 1
#pragma GCC ivdep
      for (int i = 0; i < kTogether; ++i) {
        const float slope = first_slope + slope_step * static_cast<float>(row + i);
        surface[row + i] = shading.surface;
        in_mesh[row + i] = shading.in_mesh;
        normal_x[row + i] = x0 + x1 * slope;
        normal_y[row + i] = y0 + y1 * slope;
        normal_z[row + i] = z0 + z1 * slope;
        reflectivity[row + i] = shading.reflectivity;
      }
    }
    row = end;
  }
  return rows_met;
}

const FanRaster::Shading& FanRaster::known_shading(std::uint32_t triangle) {
  Shading& shading = shadings_[triangle % kShadings];
  if (shading.triangle != triangle) {
    shading = shading_of(triangle);
  }
  return shading;
}

// The barycentric weights of a triangle's corners are, up to a common factor, its edge functions, which are linear in
// the direction d = (cos az, sin az, tan el). So the interpolated normal is linear in d too; its length does not
// matter.
FanRaster::Shading FanRaster::shading_of(std::uint32_t triangle) const {
  const int lane = static_cast<int>(triangle % kBlockSize);
  const std::uint32_t number = triangle / kBlockSize;
  const TriangleBlock& block = scene_->blocks()[number];
  const RasterScene::Part& part = scene_->parts()[scene_->instance(number)];
  const FanView::Placement& placement = view_->placement(scene_->instance(number));
  const std::uint32_t in_mesh = scene_->triangle(number, lane);
  const auto& corners = part.mesh->triangles[in_mesh];
  Vec3f at[3], normal[3];
  for (int k = 0; k < 3; ++k) {
    at[k] = placement.sonar_from_part * (Vec3f(block.x[k][lane], block.y[k][lane], block.z[k][lane]) - placement.sonar);
    normal[k] = part.turn * part.mesh->normals[corners[k]];
  }
  const Vec3f edge[3] = {at[1].cross(at[2] - at[1]), at[2].cross(at[0] - at[2]), at[0].cross(at[1] - at[0])};
  // Seen from the side that the winding points to, all weights are negative.
  const float side = at[0].dot((at[1] - at[0]).cross(at[2] - at[0])) < 0 ? -1.0F : 1.0F;
  const float size =
      side / (edge[0].cwiseAbs().maxCoeff() + edge[1].cwiseAbs().maxCoeff() + edge[2].cwiseAbs().maxCoeff());
  Shading shading;
  shading.triangle = triangle;
  shading.in_mesh = in_mesh;
  shading.surface = part.surfaces[part.mesh->slot_of(in_mesh)];
  shading.reflectivity = scene_->reflectivity(shading.surface);
  for (int axis = 0; axis < 3; ++axis) {
    shading.edges[axis] = size * (edge[0][axis] * normal[0] + edge[1][axis] * normal[1] + edge[2][axis] * normal[2]);
  }
  return shading;
}

}  // namespace insonify
