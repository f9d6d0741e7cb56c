// reflected_rays.cpp -- computes reflected rays and their neighbours' changes in vector loops.

#include "echo/cpu/reflected_rays.h"

#include "base/vector_math.h"

namespace insonify {
namespace {

INSONIFY_VECTOR_CLONES
void aim(const HitColumn& strip, const int* __restrict__ place, int count, Vec3f sonar, float max_range,
         RTCRay16& __restrict__ rays, ReflectedOrigins& __restrict__ origins, Mirrors& __restrict__ mirrors) {
  const float* __restrict__ direction_x = strip.direction_x;
  const float* __restrict__ direction_y = strip.direction_y;
  const float* __restrict__ direction_z = strip.direction_z;
  const float* __restrict__ normal_x = strip.normal_x;
  const float* __restrict__ normal_y = strip.normal_y;
  const float* __restrict__ normal_z = strip.normal_z;
  const float* __restrict__ facing = strip.facing;
  const float* __restrict__ strength = strip.strength;
  const float* __restrict__ range = strip.range;
  const float* __restrict__ selected = strip.selected;
  const float sonar_x = sonar[0], sonar_y = sonar[1], sonar_z = sonar[2];
  for (int lane = 0; lane < count; ++lane) {
    const int at = place[lane];
    const float x = direction_x[at], y = direction_y[at], z = direction_z[at];
    const float nx = normal_x[at], ny = normal_y[at], nz = normal_z[at];
    const float out = range[at], turn = 2 * facing[at];
    rays.tfar[lane] = reflected_reach(out, 1 - turn * facing[at], max_range);
    rays.org_x[lane] = sonar_x + x * out;
    rays.org_y[lane] = sonar_y + y * out;
    rays.org_z[lane] = sonar_z + z * out;
    rays.dir_x[lane] = mirrors.reflected_x[lane] = x - turn * nx;
    rays.dir_y[lane] = mirrors.reflected_y[lane] = y - turn * ny;
    rays.dir_z[lane] = mirrors.reflected_z[lane] = z - turn * nz;
    mirrors.place_x[lane] = x * out;
    mirrors.place_y[lane] = y * out;
    mirrors.place_z[lane] = z * out;
    mirrors.normal_x[lane] = nx;
    mirrors.normal_y[lane] = ny;
    mirrors.normal_z[lane] = nz;
    origins.range[lane] = out;
    origins.strength[lane] = strength[at];
    origins.selected[lane] = selected[at];
  }
}

INSONIFY_VECTOR_CLONES
void compare(const HitColumn& strip, const int* __restrict__ beside, int count, const float* __restrict__ range,
             const Mirrors& __restrict__ mirrors, MirrorChanges& __restrict__ changes) {
  const float* __restrict__ direction_x = strip.direction_x;
  const float* __restrict__ direction_y = strip.direction_y;
  const float* __restrict__ direction_z = strip.direction_z;
  const float* __restrict__ normal_x = strip.normal_x;
  const float* __restrict__ normal_y = strip.normal_y;
  const float* __restrict__ normal_z = strip.normal_z;
  const float* __restrict__ ranges = strip.range;
  for (int lane = 0; lane < count; ++lane) {
    const int at = beside[lane];
    const MirrorSample here{{mirrors.place_x[lane], mirrors.place_y[lane], mirrors.place_z[lane]},
                            {mirrors.normal_x[lane], mirrors.normal_y[lane], mirrors.normal_z[lane]},
                            {mirrors.reflected_x[lane], mirrors.reflected_y[lane], mirrors.reflected_z[lane]},
                            range[lane]};
    const MirrorSample there = mirror_sample({direction_x[at], direction_y[at], direction_z[at]},
                                             {normal_x[at], normal_y[at], normal_z[at]}, ranges[at]);
    changes.set(lane, mirror_change(here, there));
  }
}

// Facets that reflect sixteen rays, in loops of their own: as one, compilers branch where a slope is limited or 0, and
// do not vectorise it.
struct DrawnFacets {
  float along[kPacketSize], across[kPacketSize];  // FacetSlopes
  float slope[kPacketSize];                       // facet_slope()
  float reflected_x[kPacketSize], reflected_y[kPacketSize], reflected_z[kPacketSize];
  float reach[kPacketSize], share[kPacketSize];
};

INSONIFY_VECTOR_CLONES
void draw_slopes(int count, std::uint32_t seed, const ReflectedOrigins& __restrict__ origins,
                 DrawnFacets& __restrict__ facets) {
  for (int lane = 0; lane < count; ++lane) {
    const FacetSlopes slopes = facet_slopes(static_cast<std::uint32_t>(origins.column[lane]),
                                            static_cast<std::uint32_t>(origins.row[lane]), seed);
    facets.along[lane] = slopes.along;
    facets.across[lane] = slopes.across;
    facets.slope[lane] =
        facet_slope(slope_of(origins.steepness[lane]), origins.roughness[lane], origins.incidence[lane], slopes.pick);
  }
}

INSONIFY_VECTOR_CLONES
void reflect_from_facets(const HitColumn& strip, const int* __restrict__ place_of, int count, float max_range,
                         const Mirrors& __restrict__ mirrors, const EdgeLanes& __restrict__ edges,
                         const float* __restrict__ range, DrawnFacets& __restrict__ facets) {
  const float* __restrict__ gradient_x = strip.gradient_x;
  const float* __restrict__ gradient_y = strip.gradient_y;
  const float* __restrict__ gradient_z = strip.gradient_z;
  const float relief = strip.has_relief ? 1.0F : 0.0F;
  for (int lane = 0; lane < count; ++lane) {
    const float out = range[lane];
    const Triple place{mirrors.place_x[lane], mirrors.place_y[lane], mirrors.place_z[lane]};
    const Triple direction = (1 / out) * place;
    const int at = place_of[lane];
    const Triple gradient = relief * Triple{gradient_x[at], gradient_y[at], gradient_z[at]};
    const Triple tilt{edges.tilt_x[lane], edges.tilt_y[lane], edges.tilt_z[lane]};
    const MirrorFacet facet =
        mirror_facet(direction, {mirrors.normal_x[lane], mirrors.normal_y[lane], mirrors.normal_z[lane]}, gradient,
                     facets.slope[lane], {facets.along[lane], facets.across[lane], 0}, tilt);
    const Triple reflected = reflect(direction, facet.normal);
    facets.reflected_x[lane] = reflected.x;
    facets.reflected_y[lane] = reflected.y;
    facets.reflected_z[lane] = reflected.z;
    facets.reach[lane] = reflected_reach(out, dot(direction, reflected), max_range);
    facets.share[lane] = facet.share;
  }
}

// Where the slope is 0 and the mirror has no edges, the ray stays as it is.
INSONIFY_VECTOR_CLONES
void turn_rays(int count, const DrawnFacets& __restrict__ facets, const float* __restrict__ finite,
               RTCRay16& __restrict__ rays, float* __restrict__ share) {
  for (int lane = 0; lane < count; ++lane) {
    const bool turned = (facets.slope[lane] > 0) | (finite[lane] > 0);
    rays.tfar[lane] = turned ? facets.reach[lane] : rays.tfar[lane];
    rays.dir_x[lane] = turned ? facets.reflected_x[lane] : rays.dir_x[lane];
    rays.dir_y[lane] = turned ? facets.reflected_y[lane] : rays.dir_y[lane];
    rays.dir_z[lane] = turned ? facets.reflected_z[lane] : rays.dir_z[lane];
    share[lane] = turned ? facets.share[lane] : 1.0F;
  }
}

INSONIFY_VECTOR_CLONES
void project(const Mirrors& __restrict__ mirrors, const EdgeLanes& __restrict__ edges,
             const RTCRay16& __restrict__ rays, ReflectedOrigins& __restrict__ origins) {
  FaceLanes& faces = origins.faces;
  for (int lane = 0; lane < kPacketSize; ++lane) {
    const Triple place{mirrors.place_x[lane], mirrors.place_y[lane], mirrors.place_z[lane]};
    const Triple direction = (1 / origins.range[lane]) * place;
    const Triple reflected{rays.dir_x[lane], rays.dir_y[lane], rays.dir_z[lane]};
    const Triple normal{mirrors.normal_x[lane], mirrors.normal_y[lane], mirrors.normal_z[lane]};
    const float cosine = std::abs(origins.incidence[lane]), slope = slope_of(origins.steepness[lane]);
    for (int axis = 0; axis < 2; ++axis) {
      const Triple along{edges.axis_x[axis][lane], edges.axis_y[axis][lane], edges.axis_z[axis][lane]};
      const FaceSide side = face_side_of_ray(0, 0, along, direction, reflected, normal, cosine, slope);
      faces.bend[axis][lane] = side.bend;
      faces.shift[axis][lane] = side.shift;
      faces.spread[axis][lane] = side.spread;
    }
    faces.coherence[lane] = coherent_share(origins.roughness[lane], cosine);
    origins.smooth_x[lane] = mirrors.reflected_x[lane];
    origins.smooth_y[lane] = mirrors.reflected_y[lane];
    origins.smooth_z[lane] = mirrors.reflected_z[lane];
  }
}

}  // namespace

void aim_reflected(const HitColumn& strip, const int* place, int count, const Vec3f& sonar, float max_range,
                   RTCRay16& rays, ReflectedOrigins& origins, Mirrors& mirrors) {
  aim(strip, place, count, sonar, max_range, rays, origins, mirrors);
}

void compare_beside(const HitColumn& strip, const int* beside, int count, const float* range, const Mirrors& mirrors,
                    MirrorChanges& changes) {
  compare(strip, beside, count, range, mirrors, changes);
}

void turn_to_facets(const HitColumn& strip, const int* place, int count, float max_range, std::uint32_t seed,
                    const Mirrors& mirrors, const EdgeLanes& edges, RTCRay16& rays, ReflectedOrigins& origins) {
  DrawnFacets facets;
  draw_slopes(count, seed, origins, facets);
  reflect_from_facets(strip, place, count, max_range, mirrors, edges, origins.range, facets);
  turn_rays(count, facets, origins.faces.finite, rays, origins.share);
}

void set_edges(const FaceEdges& face, int lane, float wavelength, float incidence, std::uint32_t seed, EdgeLanes& edges,
               ReflectedOrigins& origins) {
  const FaceTilt drawn = FaceTilt::of(face, static_cast<std::uint32_t>(origins.column[lane]),
                                      static_cast<std::uint32_t>(origins.row[lane]), seed, wavelength, incidence);
  edges.tilt_x[lane] = drawn.tilt.x;
  edges.tilt_y[lane] = drawn.tilt.y;
  edges.tilt_z[lane] = drawn.tilt.z;
  origins.faces.finite[lane] = face.finite ? 1.0F : 0.0F;
  for (int axis = 0; axis < 2; ++axis) {
    edges.axis_x[axis][lane] = face.axes[axis].x;
    edges.axis_y[axis][lane] = face.axes[axis].y;
    edges.axis_z[axis][lane] = face.axes[axis].z;
    origins.faces.low[axis][lane] = face.low[axis];
    origins.faces.high[axis][lane] = face.high[axis];
  }
}

void project_faces(const Mirrors& mirrors, const EdgeLanes& edges, const RTCRay16& rays, ReflectedOrigins& origins) {
  project(mirrors, edges, rays, origins);
}

void FaceLanes::copy(int to, const FaceLanes& from, int lane) {
  for (int axis = 0; axis < 2; ++axis) {
    low[axis][to] = from.low[axis][lane];
    high[axis][to] = from.high[axis][lane];
    bend[axis][to] = from.bend[axis][lane];
    shift[axis][to] = from.shift[axis][lane];
    spread[axis][to] = from.spread[axis][lane];
  }
  coherence[to] = from.coherence[lane];
  finite[to] = from.finite[lane];
}

void ReflectedOrigins::copy(int to, const ReflectedOrigins& from, int lane) {
  column[to] = from.column[lane];
  row[to] = from.row[lane];
  range[to] = from.range[lane];
  selected[to] = from.selected[lane];
  strength[to] = from.strength[lane];
  reflectance[to] = from.reflectance[lane];
  share[to] = from.share[lane];
  steepness[to] = from.steepness[lane];
  incidence[to] = from.incidence[lane];
  smooth_x[to] = from.smooth_x[lane];
  smooth_y[to] = from.smooth_y[lane];
  smooth_z[to] = from.smooth_z[lane];
  faces.copy(to, from.faces, lane);
  tube[to] = from.tube[lane];
  above.set(to, from.above.at(lane));
  aside.set(to, from.aside.at(lane));
}

}  // namespace insonify
