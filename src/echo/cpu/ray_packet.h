// ray_packet.h -- a packet of sixteen rays for Embree.

#pragma once

#include "base/lane_bits.h"
#include "echo/embree.h"
#include "echo/rays/box_cut.h"
#include "insonify/geometry.h"

namespace insonify {

inline constexpr int kPacketSize = kRayLanes;

/// A packet of primary rays is kTile columns by kTile rows: the most compact shape.
inline constexpr int kTile = 4;

/// Sixteen rays. Embree traverses its hierarchy with all of them at once, which is fast if they are close together.
struct alignas(64) RayPacket {
  RTCRayHit16 rays;
  int valid[kPacketSize];

  RayPacket() {
    for (int lane = 0; lane < kPacketSize; ++lane) {
      rays.ray.time[lane] = 0;
      rays.ray.mask[lane] = ~0U;
      rays.ray.flags[lane] = 0;
      rays.ray.id[lane] = static_cast<unsigned>(lane);
      rays.ray.tnear[lane] = 0;
      rays.hit.u[lane] = rays.hit.v[lane] = 0;  // Read even where nothing was hit.
      valid[lane] = -1;
    }
  }

  void set_origin(int lane, const Vec3f& origin) {
    rays.ray.org_x[lane] = origin.x();
    rays.ray.org_y[lane] = origin.y();
    rays.ray.org_z[lane] = origin.z();
  }
  void set_direction(int lane, const Vec3f& direction) {
    rays.ray.dir_x[lane] = direction.x();
    rays.ray.dir_y[lane] = direction.y();
    rays.ray.dir_z[lane] = direction.z();
  }
  [[nodiscard]] Vec3f origin(int lane) const {
    return {rays.ray.org_x[lane], rays.ray.org_y[lane], rays.ray.org_z[lane]};
  }
  [[nodiscard]] Vec3f direction(int lane) const {
    return {rays.ray.dir_x[lane], rays.ray.dir_y[lane], rays.ray.dir_z[lane]};
  }
  [[nodiscard]] bool hit(int lane) const { return rays.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID; }

  [[nodiscard]] bool nothing_hit() const {
    unsigned all = RTC_INVALID_GEOMETRY_ID;
    for (const unsigned geometry : rays.hit.geomID) {
      all &= geometry;
    }
    return all == RTC_INVALID_GEOMETRY_ID;
  }

  [[nodiscard]] RayLanes lanes() const {
    const RTCRay16& ray = rays.ray;
    return {ray.org_x, ray.org_y, ray.org_z, ray.dir_x, ray.dir_y, ray.dir_z, ray.tnear, ray.tfar};
  }

  /// Enables the first `count` lanes.
  void set_count(int count) {
    for (int lane = 0; lane < kPacketSize; ++lane) {
      valid[lane] = lane < count ? -1 : 0;
    }
  }

  void set_reach(float reach) {
    for (int lane = 0; lane < kPacketSize; ++lane) {
      rays.ray.tfar[lane] = reach;
    }
  }

  /// Enables the lanes whose bit is set.
  void set_lanes(unsigned lanes) {
    for (int lane = 0; lane < kPacketSize; ++lane) {
      valid[lane] = (lanes >> lane & 1U) != 0 ? -1 : 0;
    }
  }

  /// Finds the nearest hit of each ray within its tfar; see hit().
  void intersect(RTCScene scene) {
    for (int lane = 0; lane < kPacketSize; ++lane) {
      rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    embree_intersect(scene, valid, rays, Coherence::kAlike);
  }

  /// Finds whether each ray hits anything within its tfar; see blocked().
  void occlude(RTCScene scene, Coherence coherence) { embree_occluded(scene, valid, rays.ray, coherence); }
  [[nodiscard]] bool blocked(int lane) const { return rays.ray.tfar[lane] < 0; }
};

}  // namespace insonify
