// facets.cpp -- computes edges and planes of sixteen triangles in one vector loop.

#include "echo/cpu/facets.h"

#include <cmath>

#include "base/vector_math.h"

namespace insonify {
namespace {

constexpr float kPi = 3.14159265F;

// Added at both ends of an azimuth interval [rad]: more than the error of fast_azimuth() and of rounding.
constexpr float kAzimuthMargin = 3e-4F;

// A vertical edge is no bound of t: on one side of its azimuth all of the column is inside, on the other nothing. It is
// replaced by a bound so steep that it acts the same, shifted so that a column exactly at its azimuth belongs to the
// triangles on both sides.
constexpr float kSteep = 1e20F, kSteepShift = -1e12F;

// Azimuth of (x, y), absolute error below 1e-4 rad: a polynomial for atan on 0..1 and symmetries.
[[gnu::always_inline]] inline float fast_azimuth(float x, float y) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float small = ax < ay ? ax : ay, large = (ax < ay ? ay : ax) + 1e-30F;
  const float a = small / large, s = a * a;
  float angle = ((-0.0464964749F * s + 0.15931422F) * s - 0.327622764F) * s * a + a;
  angle = ay > ax ? 0.5F * kPi - angle : angle;
  angle = x < 0 ? kPi - angle : angle;
  return y < 0 ? -angle : angle;
}

struct Corner {
  float x, y, z;
};

// Normal of the plane through the origin and two corners, computed from the lesser of both in a fixed order, so that
// the triangle on the other side of the edge gets exactly the same numbers, negated.
[[gnu::always_inline]] inline Corner edge_between(Corner a, Corner b) {
  const bool swapped = (a.x > b.x) | ((a.x == b.x) & ((a.y > b.y) | ((a.y == b.y) & (a.z > b.z))));
  const Corner p{swapped ? b.x : a.x, swapped ? b.y : a.y, swapped ? b.z : a.z};
  const Corner q{swapped ? a.x : b.x, swapped ? a.y : b.y, swapped ? a.z : b.z};
  const float dx = q.x - p.x, dy = q.y - p.y, dz = q.z - p.z;
  const float sign = swapped ? -1.0F : 1.0F;
  return {sign * (p.y * dz - p.z * dy), sign * (p.z * dx - p.x * dz), sign * (p.x * dy - p.y * dx)};
}

// Solves side (x cos az + y sin az + z t) >= 0 for t.
struct Bound {
  float x, y, shift, upper;
};
[[gnu::always_inline]] inline Bound bound_of(Corner edge, float side) {
  const float steep = std::abs(edge.z) < 1e-20F ? 1.0F : 0.0F;
  const float scale = -1 / (steep > 0 ? 1.0F : edge.z);  // The same for both sides of the edge.
  const float in_plane = -side * kSteep;
  return {edge.x * (steep > 0 ? in_plane : scale), edge.y * (steep > 0 ? in_plane : scale), steep * kSteepShift,
          side * edge.z < 0 ? 1.0F : 0.0F};
}

struct Azimuths {
  float low, high;
};
[[gnu::always_inline]] inline Azimuths azimuths_of(Corner a, Corner b, Corner c) {
  const float az0 = fast_azimuth(a.x, a.y), az1 = fast_azimuth(b.x, b.y), az2 = fast_azimuth(c.x, c.y);
  const float least01 = az0 < az1 ? az0 : az1, most01 = az0 < az1 ? az1 : az0;
  const float least = least01 < az2 ? least01 : az2, most = most01 < az2 ? az2 : most01;
  const bool around = most - least > kPi - kAzimuthMargin;  // Behind the sonar or around its axis: any azimuth.
  return {around ? -4.0F : least - kAzimuthMargin, around ? 4.0F : most + kAzimuthMargin};
}

// Whether a triangle lies outside the elevation aperture. The region above the fan is a convex cone if tan_high >= 0: a
// triangle with all corners in it is entirely in it. The same holds below.
[[gnu::always_inline]] inline bool is_outside(Corner a, Corner b, Corner c, float tan_low, float tan_high) {
  const float r0 = std::sqrt(a.x * a.x + a.y * a.y), r1 = std::sqrt(b.x * b.x + b.y * b.y),
              r2 = std::sqrt(c.x * c.x + c.y * c.y);
  const bool above = (tan_high >= 0) & (a.z > tan_high * r0) & (b.z > tan_high * r1) & (c.z > tan_high * r2);
  const bool below = (tan_low <= 0) & (a.z < tan_low * r0) & (b.z < tan_low * r1) & (c.z < tan_low * r2);
  return above | below;
}

}  // namespace

INSONIFY_VECTOR_CLONES
void make_facets(const TriangleBlock& __restrict__ block, const FanView::Placement& placement, float tan_low,
                 float tan_high, Facets& __restrict__ facets) {
  const float* turn = placement.sonar_from_part.data();  // Column-major.
  const float xx = turn[0], yx = turn[1], zx = turn[2], xy = turn[3], yy = turn[4], zy = turn[5], xz = turn[6],
              yz = turn[7], zz = turn[8];
  const float sonar_x = placement.sonar.x(), sonar_y = placement.sonar.y(), sonar_z = placement.sonar.z();
  const auto corner = [ =, &block ](int k, int lane) __attribute__((always_inline)) {
    const float x = block.x[k][lane] - sonar_x, y = block.y[k][lane] - sonar_y, z = block.z[k][lane] - sonar_z;
    return Corner{xx * x + xy * y + xz * z, yx * x + yy * y + yz * z, zx * x + zy * y + zz * z};
  };
  const auto store = [&facets](int k, int lane, Bound bound) __attribute__((always_inline)) {
    facets.edge_x[k][lane] = bound.x;
    facets.edge_y[k][lane] = bound.y;
    facets.edge_0[k][lane] = bound.shift;
    facets.upper[k][lane] = bound.upper;
  };
  for (int lane = 0; lane < kBlockSize; ++lane) {
    const Corner a = corner(0, lane), b = corner(1, lane), c = corner(2, lane);
    // From differences of corners, to keep precision for small triangles far away.
    const float ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z, vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
    const float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const float distance = nx * a.x + ny * a.y + nz * a.z;
    const float scale = distance == 0 ? 0.0F : 1 / distance;
    facets.plane_x[lane] = nx * scale;
    facets.plane_y[lane] = ny * scale;
    facets.plane_z[lane] = nz * scale;
    const float side = distance < 0 ? -1.0F : 1.0F;
    store(0, lane, bound_of(edge_between(b, c), side));
    store(1, lane, bound_of(edge_between(c, a), side));
    store(2, lane, bound_of(edge_between(a, b), side));
    const Azimuths azimuths = azimuths_of(a, b, c);
    const bool drawn = !is_outside(a, b, c, tan_low, tan_high) & (distance != 0);
    facets.low[lane] = drawn ? azimuths.low : 1.0F;
    facets.high[lane] = drawn ? azimuths.high : -1.0F;
  }
}

}  // namespace insonify
