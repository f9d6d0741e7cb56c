// refraction.h -- how layered water bends the rays of a ping, as a map between true and apparent space.

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "insonify/acoustics/sound_speed_profile.h"
#include "insonify/geometry.h"

namespace insonify {

/// The layered water around a sonar.
///
/// The apparent place of a point lies in the direction in which sound leaves the sonar to get there, at the distance of
/// the plan's sound speed times its travel time. Rays from the sonar are straight in apparent space, and lengths along
/// them are ranges, so engines compute echoes there as in uniform water. Only where a ray meets the scene do they go
/// back to true space: by chords between places on the bent ray. Layers are level: bearings are the same in both.
class Refraction {
 public:
  /// @param water           Not null.
  /// @param sonar           World position [m].
  /// @param surface_height  World z of depth 0 [m].
  /// @param sound_speed     Of the plan, which makes ranges of times [m/s].
  /// @param reach           Greatest apparent distance from the sonar of interest [m]. Beyond, rays are straight.
  /// @param before          Its tables are taken where they are the same; may be null.
  Refraction(std::shared_ptr<const SoundSpeedProfile> water, const Vec3& sonar, double surface_height,
             double sound_speed, double reach, Workers& workers, const Refraction* before = nullptr);

  [[nodiscard]] const Vec3& sonar() const { return sonar_; }
  [[nodiscard]] double reach() const { return reach_; }

  /// Apparent length of chords, whose middle is off the bent ray by at most kOffChord, unless they would be more than
  /// kMostChords to the reach [m].
  [[nodiscard]] float chord() const { return table_->chord; }
  static constexpr double kOffChord = 2.5e-4;  ///< [m]
  static constexpr int kMostChords = 1024;

  /// Where an apparent place is.
  [[nodiscard]] Vec3 true_place(const Vec3& apparent) const;
  /// Where a place appears by its earliest ray; none in a shadow zone.
  [[nodiscard]] std::optional<Vec3> apparent_place(const Vec3& place) const;
  /// A direction at an apparent place, turned from true to apparent space: as the direction of arrival is there, so
  /// that angles of incidence stay.
  [[nodiscard]] Vec3 apparent_direction(const Vec3& apparent, const Vec3& direction) const;

  /// The same by tables, for places relative to the sonar.
  struct Bend {
    float outward, down;  ///< True place from apparent place, horizontally away from the sonar and down [m].
    float turn;           ///< Angle of the ray here less that at launch, positive down [rad].
  };
  /// @param launch    Angle at launch from the horizontal, positive down [rad].
  /// @param distance  Apparent distance from the sonar [m].
  [[nodiscard]] Bend bend(float launch, float distance) const;
  [[nodiscard]] Vec3f true_offset(const Vec3f& apparent) const;
  [[nodiscard]] Vec3f apparent_direction(const Vec3f& apparent, const Vec3f& direction) const;

 private:
  // Bends on a lattice of launch angles and distances. It depends on the sonar's depth, not on where it is.
  struct Table {
    double depth, sound_speed, reach;
    float chord;
    int chords;
    std::vector<Bend> bends;  // [launch angle][chord]
  };
  [[nodiscard]] std::shared_ptr<const Table> make_table(Workers& workers) const;
  [[nodiscard]] RayPoint ray_to(const Vec3& apparent) const;

  std::shared_ptr<const SoundSpeedProfile> water_;
  Vec3 sonar_;
  double depth_, sound_speed_, reach_;
  std::shared_ptr<const Table> table_;
};

/// Where a place appears; itself without refraction.
[[nodiscard]] inline std::optional<Vec3> apparent_place(const Refraction* refraction, const Vec3& place) {
  return refraction == nullptr ? place : refraction->apparent_place(place);
}

}  // namespace insonify
