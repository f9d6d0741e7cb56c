// reflected_rays.h -- sixteen rays on from where sound met a mirror.

#pragma once

#include "echo/cpu/ray_packet.h"
#include "echo/model/hit_column.h"
#include "echo/model/path_footprint.h"
#include "echo/model/ray_tube.h"

namespace insonify {

/// Where a packet of reflected rays left the first surface.
struct ReflectedOrigins {
  int column[kPacketSize], row[kPacketSize];  ///< Of the lattice.
  float range[kPacketSize], selected[kPacketSize];
  float strength[kPacketSize];                                                 ///< `paper`
  float reflectance[kPacketSize], share[kPacketSize], steepness[kPacketSize];  ///< `calibrated`: see MirrorPaths.
  RayTube tube[kPacketSize];   ///< `calibrated`, where sound comes back by the mirror.
  MirrorChanges above, aside;  ///< To samples beside each.
};

/// The mirrors that a packet left, as long as their strip is at hand: see MirrorSample.
struct Mirrors {
  float place_x[kPacketSize], place_y[kPacketSize], place_z[kPacketSize];
  float normal_x[kPacketSize], normal_y[kPacketSize], normal_z[kPacketSize];
  float reflected_x[kPacketSize], reflected_y[kPacketSize], reflected_z[kPacketSize];
};

/// Readies the first `count` lanes of a packet: on from the hits at the given places of a strip, in the mirror
/// direction, as far as an echo may come from.
void aim_reflected(const HitColumn& strip, const int* place, int count, const Vec3f& sonar, float max_range,
                   RTCRay16& rays, ReflectedOrigins& origins, Mirrors& mirrors);

/// The changes from those hits to others beside them in the strip.
void compare_beside(const HitColumn& strip, const int* beside, int count, const float* range, const Mirrors& mirrors,
                    MirrorChanges& changes);

/// Turns rays that aim_reflected() readied to facets of their mirrors, whose roughness and share origins tell and take.
void turn_to_facets(const HitColumn& strip, const int* place, int count, float max_range, std::uint32_t seed,
                    const Mirrors& mirrors, RTCRay16& rays, ReflectedOrigins& origins);

}  // namespace insonify
