// navigation.h -- where the pings of a run were made and when, as survey files say it.

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "insonify/survey/geographic.h"
#include "io/export/export_format.h"

namespace insonify {

/// Angles as a compass has them.
struct Navigation {
  std::uint64_t time_ns = 0;  ///< Since 1970-01-01T00:00:00Z.
  double x = 0, y = 0;        ///< East and north [m]; with ExportOptions::origin longitude and latitude [deg].
  double heading = 0;         ///< From north (world y) over east (world x) [deg], 0..360.
  double pitch = 0;           ///< Positive: bow up [deg].
  double roll = 0;            ///< Positive: port up [deg].
  double course = 0;          ///< As heading, of the way over ground; the heading of a sonar that stands still [deg].
  double speed = 0;           ///< Over ground [m/s].
  double depth = 0;           ///< Below z = 0 of the world [m]; 0 above.
};

/// Positions of the housing at the pings of a sonar.
class Track {
 public:
  void add(const Ping& ping);
  [[nodiscard]] Vec3 velocity(std::uint64_t ping) const;  ///< Between the pings before and after [m/s].
  /// Mean time between pings [s]; none of a single ping.
  [[nodiscard]] std::optional<double> ping_period() const;

 private:
  std::vector<double> times_;  // [s]
  std::vector<Vec3> places_;   // [m]
};

/// The clock of a run and its place on the Earth.
class Navigator {
 public:
  Navigator(RecordedSonars recordings, const ExportOptions& options);

  [[nodiscard]] const std::optional<LocalGrid>& grid() const { return grid_; }

  /// East and north of a point of the world [m], or its longitude and latitude [deg].
  [[nodiscard]] std::array<double, 2> place_of(const Vec3& point) const;

  /// @param world_from_vehicle  Its x axis points ahead, y to port.
  [[nodiscard]] Navigation at(const Ping& ping, const Eigen::Quaterniond& world_from_vehicle, const Track& track) const;

 private:
  std::optional<LocalGrid> grid_;
  std::uint64_t start_ns_ = 0;
};

/// Sound speed by which a sonar converts time to range [m/s]: that which it assumes, else the recording's true one.
[[nodiscard]] double sound_speed_of(const RecordedTables& recording, const SonarConfig& sonar);

/// Gives all pings of several sonars in the order of their times: as write_pings().
void for_each_ping(RecordedSonars recordings, const ExportOptions& options,
                   const std::function<void(std::size_t sonar, const Ping& ping)>& take);

/// A ping's time as clocks of survey files have it.
struct ClockTime {
  int year = 1970, month = 1, day = 1, day_of_year = 1;
  int hour = 0, minute = 0, second = 0;
  int millisecond = 0;
};
[[nodiscard]] ClockTime clock_time(std::uint64_t time_ns);

inline constexpr double kMetresPerSecondPerKnot = 1852.0 / 3600;

}  // namespace insonify
