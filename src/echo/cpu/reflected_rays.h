// reflected_rays.h -- sets up packets of reflected rays.

#pragma once

#include "echo/cpu/ray_packet.h"
#include "echo/laws/laws.h"
#include "echo/mirror/faces.h"
#include "echo/model/hit_column.h"

namespace insonify {

/// FaceSide of both sides of the faces of sixteen mirrors, and what else face_return() needs.
struct FaceLanes {
  float low[2][kPacketSize], high[2][kPacketSize], bend[2][kPacketSize], shift[2][kPacketSize], spread[2][kPacketSize];
  float coherence[kPacketSize];
  float finite[kPacketSize];  ///< 1 where there is a face, 0 where the mirror has no edges.

  [[nodiscard, gnu::always_inline]] FaceSide side(int axis, int lane) const {
    return {low[axis][lane], high[axis][lane], bend[axis][lane], shift[axis][lane], spread[axis][lane]};
  }
  void copy(int to, const FaceLanes& from, int lane);
};

/// FaceEdges of sixteen mirrors, and the tilts that stand for diffraction at them.
struct EdgeLanes {
  float axis_x[2][kPacketSize], axis_y[2][kPacketSize], axis_z[2][kPacketSize];
  float tilt_x[kPacketSize], tilt_y[kPacketSize], tilt_z[kPacketSize];
};

/// The MirrorChange of sixteen samples.
struct alignas(64) MirrorChanges {
  float range[kPacketSize], place_x[kPacketSize], place_y[kPacketSize], place_z[kPacketSize];
  float turn_x[kPacketSize], turn_y[kPacketSize], turn_z[kPacketSize];

  [[nodiscard, gnu::always_inline]] MirrorChange at(int lane) const {
    return {range[lane], {place_x[lane], place_y[lane], place_z[lane]}, {turn_x[lane], turn_y[lane], turn_z[lane]}};
  }
  [[gnu::always_inline]] void set(int lane, const MirrorChange& change) {
    range[lane] = change.range;
    place_x[lane] = change.place.x;
    place_y[lane] = change.place.y;
    place_z[lane] = change.place.z;
    turn_x[lane] = change.turn.x;
    turn_y[lane] = change.turn.y;
    turn_z[lane] = change.turn.z;
  }
};

/// The hits on the first surface that a packet of reflected rays starts from.
struct ReflectedOrigins {
  int column[kPacketSize], row[kPacketSize];  ///< Sample of the lattice.
  float range[kPacketSize], selected[kPacketSize];
  float strength[kPacketSize];                                                 ///< `paper`: HitColumn::strength.
  float reflectance[kPacketSize], share[kPacketSize], steepness[kPacketSize];  ///< `calibrated`: see MirrorPaths.
  float roughness[kPacketSize], incidence[kPacketSize];                        ///< Arguments of facet_slope().
  float smooth_x[kPacketSize], smooth_y[kPacketSize], smooth_z[kPacketSize];   ///< Directions of smooth mirrors' rays.
  FaceLanes faces;                                                             ///< `calibrated`
  RayTube tube[kPacketSize] = {};  ///< `calibrated` with more than two surfaces.
  MirrorChanges above, aside;      ///< Changes to the neighbours in the column and in the next column.

  /// Copies a lane, except roughness, which is not read once the rays are turned.
  void copy(int to, const ReflectedOrigins& from, int lane);
};

/// MirrorSample of sixteen hits.
struct Mirrors {
  float place_x[kPacketSize], place_y[kPacketSize], place_z[kPacketSize];
  float normal_x[kPacketSize], normal_y[kPacketSize], normal_z[kPacketSize];
  float reflected_x[kPacketSize], reflected_y[kPacketSize], reflected_z[kPacketSize];
};

/// Sets up the first `count` lanes of a packet: reflected rays from the hits at the given indices of a strip, as long
/// as reflected_reach().
void aim_reflected(const HitColumn& strip, const int* place, int count, const Vec3f& sonar, float max_range,
                   RTCRay16& rays, ReflectedOrigins& origins, Mirrors& mirrors);

/// Computes the changes from those hits to their neighbours at the indices `beside` of the strip.
void compare_beside(const HitColumn& strip, const int* beside, int count, const float* range, const Mirrors& mirrors,
                    MirrorChanges& changes);

/// Reflects the rays of aim_reflected() by facets of their mirrors where facet_slope() is not 0, and sets
/// ReflectedOrigins::share of these. Reads their steepness, roughness and incidence.
void turn_to_facets(const HitColumn& strip, const int* place, int count, float max_range, std::uint32_t seed,
                    const Mirrors& mirrors, const EdgeLanes& edges, RTCRay16& rays, ReflectedOrigins& origins);

/// Sets an edge of a mirror, or that it has none, and the tilt that stands for diffraction of its ray.
/// @param incidence  Cosine of the angle of incidence, of either sign.
void set_edges(const FaceEdges& face, int lane, float wavelength, float incidence, std::uint32_t seed, EdgeLanes& edges,
               ReflectedOrigins& origins);

/// Fills in FaceLanes and ReflectedOrigins::smooth_x for the rays as they are reflected now.
void project_faces(const Mirrors& mirrors, const EdgeLanes& edges, const RTCRay16& rays, ReflectedOrigins& origins);

}  // namespace insonify
