// bent_packet.cpp -- traces a packet of rays through layered water, by chords of the bent rays.

#include <algorithm>
#include <cmath>

#include "echo/cpu/cpu_scene.h"

namespace insonify {
namespace {

// The chords of a packet's rays, one after another. Ends of chords are true places, distances apparent ones.
class Chords {
 public:
  Chords(const RayPacket& packet, const Refraction& refraction, const Vec3f& sonar)
      : packet_(packet), refraction_(refraction), sonar_(sonar) {
    const RTCRay16& ray = packet.rays.ray;
    const auto farthest = static_cast<float>(2 * refraction.reach());  // Some rays have no end.
    for (int lane = 0; lane < kPacketSize; ++lane) {
      chord_.valid[lane] = packet.valid[lane];
      to_[lane] = ray.tnear[lane];
      leaves_[lane] = packet.origin(lane) == sonar;
      if (leaves_[lane]) {
        const float level = std::hypot(ray.dir_x[lane], ray.dir_y[lane]);
        launch_[lane] = std::atan2(-ray.dir_z[lane], level);
        outward_[lane] = level > 0 ? Vec3f(ray.dir_x[lane] / level, ray.dir_y[lane] / level, 0) : Vec3f(Vec3f::UnitX());
      }
      end_[lane] = std::min(ray.tfar[lane], ray.tnear[lane] + farthest);
      if (chord_.valid[lane] != 0) {
        place_[lane] = true_place(lane, to_[lane]);
      }
    }
  }

  // Goes on to the next chord of each ray that is not at its end. False if there is none.
  bool next() {
    constexpr float kOver = 1.0001F;  // So that nothing lies between two chords.
    bool any = false;
    for (int lane = 0; lane < kPacketSize; ++lane) {
      if (chord_.valid[lane] == 0 || !(to_[lane] < end_[lane])) {
        chord_.valid[lane] = 0;
        continue;
      }
      from_[lane] = to_[lane];
      to_[lane] = std::min(from_[lane] + refraction_.chord(), end_[lane]);
      const Vec3f there = true_place(lane, to_[lane]);
      chord_.set_origin(lane, place_[lane]);
      chord_.set_direction(lane, there - place_[lane]);
      chord_.rays.ray.tfar[lane] = kOver;
      place_[lane] = there;
      any = true;
    }
    return any;
  }

  [[nodiscard]] RayPacket& chord() { return chord_; }

  // Apparent distance of the hit on a ray's chord.
  [[nodiscard]] float hit_at(int lane) const {
    return from_[lane] + chord_.rays.ray.tfar[lane] * (to_[lane] - from_[lane]);
  }

 private:
  [[nodiscard]] Vec3f true_place(int lane, float distance) const {
    if (leaves_[lane]) {
      const Refraction::Bend bent = refraction_.bend(launch_[lane], distance);
      return sonar_ + distance * packet_.direction(lane) + bent.outward * outward_[lane] - bent.down * Vec3f::UnitZ();
    }
    return sonar_ + refraction_.true_offset(packet_.origin(lane) + distance * packet_.direction(lane) - sonar_);
  }

  const RayPacket& packet_;
  const Refraction& refraction_;
  Vec3f sonar_;
  RayPacket chord_;
  Vec3f place_[kPacketSize];
  bool leaves_[kPacketSize];  // Whether the ray leaves the sonar: all of it has one launch angle.
  float launch_[kPacketSize];
  Vec3f outward_[kPacketSize];
  float from_[kPacketSize] = {}, to_[kPacketSize], end_[kPacketSize];
};

}  // namespace

void CpuScene::intersect_bent(RayPacket& packet, const Refraction& refraction) const {
  RTCHit16& hit = packet.rays.hit;
  for (int lane = 0; lane < kPacketSize; ++lane) {
    hit.geomID[lane] = hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
  Chords chords(packet, refraction, (refraction.sonar() - origin_).cast<float>());
  while (chords.next()) {
    RayPacket& chord = chords.chord();
    chord.intersect(scene_);
    for (int lane = 0; lane < kPacketSize; ++lane) {
      if (chord.valid[lane] != 0 && chord.hit(lane)) {
        packet.rays.ray.tfar[lane] = chords.hit_at(lane);
        hit.geomID[lane] = chord.rays.hit.geomID[lane];
        hit.instID[0][lane] = chord.rays.hit.instID[0][lane];
        hit.primID[lane] = chord.rays.hit.primID[lane];
        hit.u[lane] = chord.rays.hit.u[lane];
        hit.v[lane] = chord.rays.hit.v[lane];
        chord.valid[lane] = 0;
      }
    }
  }
}

void CpuScene::occlude_bent(RayPacket& packet, const Refraction& refraction) const {
  Chords chords(packet, refraction, (refraction.sonar() - origin_).cast<float>());
  while (chords.next()) {
    RayPacket& chord = chords.chord();
    chord.occlude(scene_, any_placed_ ? Coherence::kScattered : Coherence::kAlike);
    for (int lane = 0; lane < kPacketSize; ++lane) {
      if (chord.valid[lane] != 0 && chord.blocked(lane)) {
        packet.rays.ray.tfar[lane] = chord.rays.ray.tfar[lane];  // Negative.
        chord.valid[lane] = 0;
      }
    }
  }
}

void CpuScene::appear(const RTCRay16& rays, const Refraction& refraction, Shading& shading,
                      ReliefLanes* reliefs) const {
  const Vec3f sonar = (refraction.sonar() - origin_).cast<float>();
  for (int lane = 0; lane < kPacketSize; ++lane) {
    if (shading.surface[lane] == kNoSurface) {
      continue;
    }
    const float distance = rays.tfar[lane];
    const Vec3f place = Vec3f(rays.org_x[lane], rays.org_y[lane], rays.org_z[lane]) - sonar +
                        distance * Vec3f(rays.dir_x[lane], rays.dir_y[lane], rays.dir_z[lane]);
    const auto turn = [&](float& x, float& y, float& z) {
      const Vec3f turned = refraction.apparent_direction(place, Vec3f(x, y, z));
      x = turned.x();
      y = turned.y();
      z = turned.z();
    };
    turn(shading.normal_x[lane], shading.normal_y[lane], shading.normal_z[lane]);
    if (reliefs != nullptr) {
      turn(reliefs->gradient_x[lane], reliefs->gradient_y[lane], reliefs->gradient_z[lane]);
    }
  }
}

}  // namespace insonify
