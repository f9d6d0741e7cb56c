// sound_speed_profile.h -- sound speed by depth, and the rays that it bends.

#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "insonify/field.h"

namespace insonify {

/// One point of a sound-speed profile: its sound speed, or the temperature and salinity that it follows from.
struct ProfilePoint {
  double depth = 0;                          ///< Below the surface [m], 0..12000.
  std::optional<double> sound_speed = {};    ///< [m/s], 1300..1700; absent: from temperature and salinity.
  std::optional<double> temperature_c = {};  ///< [degC], -3..40.
  std::optional<double> salinity = {};       ///< [PSU], 0..50.

  /// The given sound speed, else that of Chen and Millero at this temperature, salinity and depth [m/s].
  [[nodiscard]] double speed() const;

  /// @param object  Name of the point in messages: "water.profile[3]".
  /// @throws Error for a value out of limits, and a point without a sound speed.
  void validate(std::string_view object) const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"depth", "m", from_to(0, 12000), "Depth below the surface, rising from one point to the next."},
          self.depth);
    visit(Field{"sound_speed", "m/s", from_to(1300, 1700), "Sound speed; from temperature and salinity when absent."},
          self.sound_speed);
    visit(Field{"temperature_c", "degC", from_to(-3, 40), "Temperature, in place of sound_speed."}, self.temperature_c);
    visit(Field{"salinity", "PSU", from_to(0, 50), "Practical salinity, in place of sound_speed."}, self.salinity);
  }
};

/// Steepest change of sound speed with depth in a profile, beyond measured ones by an order of magnitude [1/s].
inline constexpr double kSteepestProfile = 100;

/// Checks each point, that depths rise, and kSteepestProfile.
/// @param object  Name of the list in messages: "water.profile".
/// @throws Error "water.profile[3].depth = 5 m must be greater than water.profile[2].depth = 5 m"
void check_profile(std::span<const ProfilePoint> points, std::string_view object);

/// A point of a ray. Horizontal distance and time are those from the source.
struct RayPoint {
  double distance = 0;  ///< Horizontal distance [m].
  double depth = 0;     ///< [m]; negative above the surface.
  double angle = 0;     ///< Angle from the horizontal, positive down [rad].
  double time = 0;      ///< One-way travel time [s].
};

/// The ray that connects two points.
struct Eigenray {
  double launch_angle = 0;   ///< At the source, from the horizontal, positive down [rad].
  double arrival_angle = 0;  ///< At the target, likewise [rad].
  double time = 0;           ///< One-way travel time [s].
};

/// Sound speed by depth: linear between the points of a profile, constant above the first and below the last.
///
/// Rays are exact in this water: arcs of circles where speed is linear, straight where it is constant, joined by
/// Snell's law. They are not reflected: a ray that leaves the water by the surface goes on, and does not return.
/// Distances are horizontal, angles from the horizontal and positive down. A copy shares nothing.
class SoundSpeedProfile {
 public:
  /// @param object  Name of the list of points in messages.
  /// @throws Error as check_profile(), and for an empty list.
  explicit SoundSpeedProfile(std::span<const ProfilePoint> points, std::string_view object = "profile");

  [[nodiscard]] double speed_at(double depth) const;

  /// Whether speed is the same at all depths, and rays are straight.
  [[nodiscard]] bool is_constant() const;

  /// Radius of the sharpest bend of any ray, the least of c/|g|; infinite where speed is constant [m].
  [[nodiscard]] double least_radius() const;

  /// Depths of the first and the last point [m].
  [[nodiscard]] double first_depth() const { return layers_.front().bottom; }
  [[nodiscard]] double last_depth() const { return layers_.back().top; }

  /// Where the ray of a launch angle is after a travel time: turns a sounding's angle and half of its two-way time into
  /// its distance and depth.
  /// @param depth         Depth of the source [m].
  /// @param launch_angle  [rad], from -pi/2 to pi/2.
  /// @param time          One-way travel time [s], >= 0.
  [[nodiscard]] RayPoint after_time(double depth, double launch_angle, double time) const;

  /// Where the ray of a launch angle is after a horizontal distance.
  /// @param launch_angle  [rad], between -pi/2 and pi/2.
  /// @param distance      [m], >= 0.
  [[nodiscard]] RayPoint at_distance(double depth, double launch_angle, double distance) const;

  /// The earliest ray between two points; none in a shadow zone.
  /// @param depth     Depth of the source [m].
  /// @param to_depth  Depth of the target [m].
  /// @param distance  Horizontal distance between them [m], >= 0.
  [[nodiscard]] std::optional<Eigenray> eigenray(double depth, double to_depth, double distance) const;

 private:
  // Water between two depths, of linear speed. The first and the last layer have no end, and constant speed.
  struct Layer {
    double top, bottom;  // [m]
    double reference;    // A depth within [m]
    double speed;        // there [m/s].
    double gradient;     // [1/s]

    [[nodiscard]] double speed_at(double depth) const { return speed + gradient * (depth - reference); }
  };
  struct State;
  struct Leg;

  [[nodiscard]] std::size_t layer_at(double depth) const;
  [[nodiscard]] State start(double depth, double launch_angle) const;
  [[nodiscard]] bool runs_along(const State& state) const;
  [[nodiscard]] Leg leg_to_boundary(const State& state) const;
  [[nodiscard]] std::vector<double> search_angles(double depth) const;

  std::vector<Layer> layers_;  // From the first, which has no top, to the last, which has no bottom.
};

}  // namespace insonify
