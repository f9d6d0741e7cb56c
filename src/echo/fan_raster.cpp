// fan_raster.cpp -- edge functions and planes of sixteen triangles at a time, then rows column by column.

#include "echo/fan_raster.h"

#include <algorithm>
#include <cmath>

#include "base/vector_math.h"

namespace insonify {
namespace {

constexpr std::uint32_t kNothing = 0xffffffff;
constexpr float kPi = 3.14159265F;

// Added to both ends of an azimuth interval [rad]: more than fast_azimuth() and rounding can be wrong by.
constexpr float kAzimuthMargin = 3e-4F;

// Azimuth of (x, y), absolute error below 1e-4 rad: a polynomial for atan on 0..1 and the symmetries of the circle.
[[gnu::always_inline]] inline float fast_azimuth(float x, float y) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float small = ax < ay ? ax : ay, large = (ax < ay ? ay : ax) + 1e-30F;
  const float a = small / large, s = a * a;
  float angle = ((-0.0464964749F * s + 0.15931422F) * s - 0.327622764F) * s * a + a;
  angle = ay > ax ? 0.5F * kPi - angle : angle;
  angle = x < 0 ? kPi - angle : angle;
  return y < 0 ? -angle : angle;
}

// Sixteen triangles around the sonar, ready to be drawn. For the direction d = (cos az, sin az, tan el):
// edge k . d >= 0 for all k where d meets the triangle, plane . d is 1 / distance, in units of |d|.
struct Facets {
  float edge_x[3][kBlockSize], edge_y[3][kBlockSize], edge_z[3][kBlockSize];
  float plane_x[kBlockSize], plane_y[kBlockSize], plane_z[kBlockSize];
  float low[kBlockSize], high[kBlockSize];  // Azimuths; low > high where there is nothing to draw.
};

struct Corner {
  float x, y, z;
};

// Normal of the plane through the origin and two corners, seen from whichever of them comes first: a triangle on the
// other side of the edge gets the same numbers, negated.
[[gnu::always_inline]] inline Corner edge_between(Corner a, Corner b) {
  const bool swapped = (a.x > b.x) | ((a.x == b.x) & ((a.y > b.y) | ((a.y == b.y) & (a.z > b.z))));
  const Corner p{swapped ? b.x : a.x, swapped ? b.y : a.y, swapped ? b.z : a.z};
  const Corner q{swapped ? a.x : b.x, swapped ? a.y : b.y, swapped ? a.z : b.z};
  const float dx = q.x - p.x, dy = q.y - p.y, dz = q.z - p.z;
  const float sign = swapped ? -1.0F : 1.0F;
  return {sign * (p.y * dz - p.z * dy), sign * (p.z * dx - p.x * dz), sign * (p.x * dy - p.y * dx)};
}

INSONIFY_VECTOR_CLONES
void set_up(const TriangleBlock& __restrict__ block, const FanView::Placement& placement, float tan_low, float tan_high,
            Facets& __restrict__ facets) {
  const float* turn = placement.sonar_from_part.data();  // Column-major.
  const float xx = turn[0], yx = turn[1], zx = turn[2], xy = turn[3], yy = turn[4], zy = turn[5], xz = turn[6],
              yz = turn[7], zz = turn[8];
  const float sonar_x = placement.sonar.x(), sonar_y = placement.sonar.y(), sonar_z = placement.sonar.z();
  const bool may_be_above = tan_high >= 0, may_be_below = tan_low <= 0;
  const float *x0 = block.x[0], *x1 = block.x[1], *x2 = block.x[2];
  const float *y0 = block.y[0], *y1 = block.y[1], *y2 = block.y[2];
  const float *z0 = block.z[0], *z1 = block.z[1], *z2 = block.z[2];
  const auto corner = [=](float x, float y, float z) __attribute__((always_inline)) {
    return Corner{xx * x + xy * y + xz * z, yx * x + yy * y + yz * z, zx * x + zy * y + zz * z};
  };
  for (int lane = 0; lane < kBlockSize; ++lane) {
    const Corner a = corner(x0[lane] - sonar_x, y0[lane] - sonar_y, z0[lane] - sonar_z);
    const Corner b = corner(x1[lane] - sonar_x, y1[lane] - sonar_y, z1[lane] - sonar_z);
    const Corner c = corner(x2[lane] - sonar_x, y2[lane] - sonar_y, z2[lane] - sonar_z);

    // From differences: products of whole coordinates would lose the plane of a small triangle far away.
    const float ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z, vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
    const float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const float distance = nx * a.x + ny * a.y + nz * a.z;
    const float scale = distance == 0 ? 0.0F : 1 / distance;
    facets.plane_x[lane] = nx * scale;
    facets.plane_y[lane] = ny * scale;
    facets.plane_z[lane] = nz * scale;
    const float side = distance < 0 ? -1.0F : 1.0F;
    const Corner e0 = edge_between(b, c), e1 = edge_between(c, a), e2 = edge_between(a, b);
    facets.edge_x[0][lane] = side * e0.x;
    facets.edge_y[0][lane] = side * e0.y;
    facets.edge_z[0][lane] = side * e0.z;
    facets.edge_x[1][lane] = side * e1.x;
    facets.edge_y[1][lane] = side * e1.y;
    facets.edge_z[1][lane] = side * e1.z;
    facets.edge_x[2][lane] = side * e2.x;
    facets.edge_y[2][lane] = side * e2.y;
    facets.edge_z[2][lane] = side * e2.z;

    const float az0 = fast_azimuth(a.x, a.y), az1 = fast_azimuth(b.x, b.y), az2 = fast_azimuth(c.x, c.y);
    const float least01 = az0 < az1 ? az0 : az1, most01 = az0 < az1 ? az1 : az0;
    const float least = least01 < az2 ? least01 : az2, most = most01 < az2 ? az2 : most01;
    const bool around = most - least > kPi - kAzimuthMargin;  // Behind the sonar, or around its axis: everywhere.
    // Above the upper edge of the fan is a convex cone, and below the lower one: what has its corners there is all
    // there.
    const float r0 = std::sqrt(a.x * a.x + a.y * a.y), r1 = std::sqrt(b.x * b.x + b.y * b.y),
                r2 = std::sqrt(c.x * c.x + c.y * c.y);
    const bool above = may_be_above & (a.z > tan_high * r0) & (b.z > tan_high * r1) & (c.z > tan_high * r2);
    const bool below = may_be_below & (a.z < tan_low * r0) & (b.z < tan_low * r1) & (c.z < tan_low * r2);
    const bool drawn = !above & !below & (distance != 0);
    facets.low[lane] = !drawn ? 1.0F : around ? -4.0F : least - kAzimuthMargin;
    facets.high[lane] = !drawn ? -1.0F : around ? 4.0F : most + kAzimuthMargin;
  }
}

// One triangle in one column: its rows are those between the edges that bound it.
struct Rows {
  float low, high;  // Row coordinates; nothing when low > high.
};
[[gnu::always_inline]] inline Rows bounded(Rows rows, float a, float b, float first_tan, float rows_per_tan) {
  const float at = (-a / b - first_tan) * rows_per_tan;
  if (b > 0) {
    rows.low = std::max(rows.low, at);
  } else if (b < 0) {
    rows.high = std::min(rows.high, at);
  } else if (a < 0) {
    rows.high = -1;
  }
  return rows;
}

// Draws one triangle in one column.
[[gnu::always_inline]] inline void draw_rows(const Facets& facets, int lane, float cos_az, float sin_az,
                                             float first_tan, float tan_step, int row_count, std::uint32_t triangle,
                                             float* __restrict__ nearness, std::uint32_t* __restrict__ nearest) {
  Rows rows{0, static_cast<float>(row_count - 1)};
  const float rows_per_tan = 1 / tan_step;
  for (int k = 0; k < 3; ++k) {
    const float a = facets.edge_x[k][lane] * cos_az + facets.edge_y[k][lane] * sin_az;
    rows = bounded(rows, a, facets.edge_z[k][lane], first_tan, rows_per_tan);
  }
  if (!(rows.low <= rows.high)) {
    return;
  }
  const int first = static_cast<int>(std::ceil(rows.low));
  const int last = static_cast<int>(rows.high);
  const float at_first =
      facets.plane_x[lane] * cos_az + facets.plane_y[lane] * sin_az + facets.plane_z[lane] * first_tan;
  const float per_row = facets.plane_z[lane] * tan_step;
  for (int row = first; row <= last; ++row) {
    const float near = at_first + per_row * static_cast<float>(row);
    const bool nearer = near > nearness[row];
    nearness[row] = nearer ? near : nearness[row];
    nearest[row] = nearer ? triangle : nearest[row];
  }
}

}  // namespace

void FanRaster::draw(const RasterScene& scene, const FanView& view, const PingPlan& plan, int first_column,
                     int last_column) {
  scene_ = &scene;
  view_ = &view;
  plan_ = &plan;
  first_column_ = first_column;
  const Lattice& lattice = plan.lattice;
  stride_ = lattice.rows + HitStrip::kPadding;
  const std::size_t cells = static_cast<std::size_t>(last_column - first_column) * stride_;
  if (nearness_.size() < cells) {
    nearness_.resize(cells);
    nearest_.resize(cells);
  }
  std::fill_n(nearest_.begin(), cells, kNothing);
  // What is farther than the range never gets in: |d| = 1 / cos(elevation).
  for (int column = first_column; column < last_column; ++column) {
    float* nearness = &nearness_[static_cast<std::size_t>(column - first_column) * stride_];
    const float* cos_el = lattice.cos_elevations(column);
    for (int row = 0; row < lattice.rows; ++row) {
      nearness[row] = 1 / (cos_el[row] * plan.true_max_range);
    }
  }
  for (const FanView::Visible& visible : view.visible()) {
    const int first = std::max(first_column, visible.first_column);
    const int last = std::min(last_column, visible.last_column);
    if (first < last) {
      draw_cluster(scene.clusters()[visible.cluster], first, last);
    }
  }
}

INSONIFY_VECTOR_CLONES
void FanRaster::draw_cluster(const TriangleCluster& cluster, int first_column, int last_column) {
  const Lattice& lattice = plan_->lattice;
  const FanView::Placement& placement = view_->placement(cluster.instance);
  const float* cos_az = lattice.cos_azimuth.data();
  const float* sin_az = lattice.sin_azimuth.data();
  const float tan_step = lattice.tan_step;
  const float tan_low = lattice.sin_low / lattice.cos_low, tan_high = lattice.sin_high / lattice.cos_high;
  const int rows = lattice.rows;
  Facets facets;
  for (std::uint32_t done = 0; done < cluster.triangle_count; done += kBlockSize) {
    const std::uint32_t block = cluster.first_block + done / kBlockSize;
    set_up(scene_->blocks()[block], placement, tan_low, tan_high, facets);
    const int count = static_cast<int>(std::min<std::uint32_t>(kBlockSize, cluster.triangle_count - done));
    for (int lane = 0; lane < count; ++lane) {
      if (facets.low[lane] > facets.high[lane]) {
        continue;
      }
      const auto [first, last] = view_->finder().between(facets.low[lane], facets.high[lane]);
      for (int column = std::max(first, first_column); column < std::min(last, last_column); ++column) {
        const std::size_t start = static_cast<std::size_t>(column - first_column_) * stride_;
        draw_rows(facets, lane, cos_az[column], sin_az[column], lattice.first_tan(column), tan_step, rows,
                  block * kBlockSize + static_cast<std::uint32_t>(lane), &nearness_[start], &nearest_[start]);
      }
    }
  }
}

int FanRaster::read(int column, const HitColumn& hits) const {
  const Lattice& lattice = plan_->lattice;
  const std::size_t start = static_cast<std::size_t>(column - first_column_) * stride_;
  const std::uint32_t* nearest = &nearest_[start];
  const float* nearness = &nearness_[start];
  const float* cos_el = lattice.cos_elevations(column);
  const float cos_az = lattice.cos_azimuth[column], sin_az = lattice.sin_azimuth[column];
  int rows_met = 0;
  for (int row = 0; row < lattice.rows;) {
    // Rows one after another that see the same triangle.
    const std::uint32_t triangle = nearest[row];
    int end = row + 1;
    while (end < lattice.rows && nearest[end] == triangle) {
      ++end;
    }
    if (triangle == kNothing) {
      for (; row < end; ++row) {
        hits.surface[row] = kNoSurface;
        hits.range[row] = hits.reflectivity[row] = 0;
      }
      continue;
    }
    rows_met = end;
    const Shading shading = shading_of(triangle);
    const Vec3f normal = shading.edges[0] * cos_az + shading.edges[1] * sin_az;
    const float reflectivity = scene_->reflectivity(shading.surface);
    for (; row < end; ++row) {
      const float tan_el = lattice.first_tan(column) + lattice.tan_step * static_cast<float>(row);
      hits.surface[row] = shading.surface;
      hits.range[row] = 1 / (cos_el[row] * nearness[row]);
      hits.normal_x[row] = normal.x() + shading.edges[2].x() * tan_el;
      hits.normal_y[row] = normal.y() + shading.edges[2].y() * tan_el;
      hits.normal_z[row] = normal.z() + shading.edges[2].z() * tan_el;
      hits.reflectivity[row] = reflectivity;
    }
  }
  return rows_met;
}

// The weights of a triangle's corners are its edge functions, linear in the direction d = (cos az, sin az, tan el): so
// is their sum of vertex normals, which need not be of unit length.
FanRaster::Shading FanRaster::shading_of(std::uint32_t place) const {
  const int lane = static_cast<int>(place % kBlockSize);
  const std::uint32_t number = place / kBlockSize;
  const TriangleBlock& block = scene_->blocks()[number];
  const RasterScene::Part& part = scene_->parts()[scene_->instance(number)];
  const FanView::Placement& placement = view_->placement(scene_->instance(number));
  const std::uint32_t triangle = scene_->triangle(number, lane);
  const auto& corners = part.mesh->triangles[triangle];
  Vec3f at[3], normal[3];
  for (int k = 0; k < 3; ++k) {
    at[k] = placement.sonar_from_part * (Vec3f(block.x[k][lane], block.y[k][lane], block.z[k][lane]) - placement.sonar);
    normal[k] = part.turn * part.mesh->normals[corners[k]];
  }
  const Vec3f edge[3] = {at[1].cross(at[2] - at[1]), at[2].cross(at[0] - at[2]), at[0].cross(at[1] - at[0])};
  const float size =
      1 / (edge[0].cwiseAbs().maxCoeff() + edge[1].cwiseAbs().maxCoeff() + edge[2].cwiseAbs().maxCoeff());
  Shading shading;
  shading.surface = part.surfaces[part.mesh->slot_of(triangle)];
  for (int axis = 0; axis < 3; ++axis) {
    shading.edges[axis] = size * (edge[0][axis] * normal[0] + edge[1][axis] * normal[1] + edge[2][axis] * normal[2]);
  }
  return shading;
}

}  // namespace insonify
