// sound_speed.h -- sound speed of water by five published formulas, and refraction in a constant gradient.

#pragma once

namespace insonify {

/// Gauge pressure at a depth: Leroy and Parthiot, J. Acoust. Soc. Am. 103(3), 1346 (1998), "common oceans" [MPa].
/// @param depth [m], 0..12000. @param latitude [rad].
[[nodiscard]] double pressure_mpa(double depth, double latitude);

// Each takes temperature_c [degC], salinity [PSU], depth [m] and returns the sound speed [m/s].

/// UNESCO equation of Chen and Millero, J. Acoust. Soc. Am. 62(5), 1129 (1977), with the coefficients of Wong and Zhu,
/// J. Acoust. Soc. Am. 97(3), 1732 (1995): 0..40 degC, 0..40 PSU, 0..1000 bar. The default, and the only one here that
/// is valid in fresh water. Latitude [rad] is used to convert depth to pressure.
[[nodiscard]] double chen_millero_sound_speed(double temperature_c, double salinity, double depth,
                                              double latitude = 0.7853981633974483);
/// Del Grosso, J. Acoust. Soc. Am. 56(4), 1084 (1974), with the coefficients of Wong and Zhu (1995): 0..30 degC, 30..40
/// PSU.
[[nodiscard]] double del_grosso_sound_speed(double temperature_c, double salinity, double depth,
                                            double latitude = 0.7853981633974483);
/// Mackenzie, J. Acoust. Soc. Am. 70(3), 807 (1981): -2..30 degC, 25..40 PSU, to 8000 m.
[[nodiscard]] double mackenzie_sound_speed(double temperature_c, double salinity, double depth);
/// Medwin, J. Acoust. Soc. Am. 58(6), 1318 (1975): 0..35 degC, 0..45 PSU, to 1000 m.
[[nodiscard]] double medwin_sound_speed(double temperature_c, double salinity, double depth);
/// Leroy, Robinson and Goldsmith, J. Acoust. Soc. Am. 124(5), 2774 (2008): all oceans, +-0.2 m/s. Latitude [rad].
[[nodiscard]] double leroy_sound_speed(double temperature_c, double salinity, double depth, double latitude);

/// A sound path in a constant sound-speed gradient, which is an arc of a circle, after a horizontal distance.
struct BentPath {
  double radius = 0;  ///< Radius of the circle, c0/(g cos(launch angle)), with that sign [m].
  double drop = 0;    ///< Depth gained, positive down [m].
  double angle = 0;   ///< Angle from the horizontal on arrival, positive down [rad].
  double time = 0;    ///< Travel time [s].
};

/// Refraction in a constant gradient: Medwin and Clay, Fundamentals of Acoustical Oceanography (1998), ch. 3.
/// @param sound_speed  Sound speed c0 at the launch point [m/s], > 0.
/// @param gradient     Change of sound speed with depth g, positive where it increases downwards [1/s], not 0.
/// @param launch_angle Angle from the horizontal, positive down [rad], within +-pi/2.
/// @param distance     Horizontal distance [m], >= 0.
/// @throws Error if the path turns back before it has covered the distance.
[[nodiscard]] BentPath bent_path(double sound_speed, double gradient, double launch_angle, double distance);

}  // namespace insonify
