// side_scan_line.h -- recordings of side-scan sonars as survey files have them: samples of 16 bits from the sonar
// outwards, and the navigation of each ping.

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "insonify/survey/geographic.h"
#include "io/export/export_format.h"

namespace insonify {

/// What a survey file says of a sonar.
struct SideScanSonar {
  SonarConfig config;
  ReceiverConfig receiver;
  double sound_speed = 0;  ///< Converts time to range [m/s].
  double ping_period = 0;  ///< Mean time between pings [s]; of a single ping, the time that it takes.
  int samples = 0;         ///< Samples of one side. The first begins at range 0: bins before min_range are 0.
  bool counts = false;     ///< Whether samples are the instrument's counts, else amplitudes times 2^weight.
  int weight = 0;          ///< Amplitude, the square root of intensity, is a sample times 2^-weight.

  [[nodiscard]] double slant_range() const { return samples * config.bin_length(); }  ///< End of the last sample [m].
};

/// One ping with its navigation. Angles as a compass has them.
struct SideScanPing {
  std::uint64_t number = 0;
  std::uint64_t time_ns = 0;  ///< Since 1970-01-01T00:00:00Z.
  double x = 0, y = 0;        ///< East and north [m]; with ExportOptions::origin longitude and latitude [deg].
  double heading = 0;         ///< From north (world y) over east (world x) [deg], 0..360.
  double pitch = 0;           ///< Positive: bow up [deg].
  double roll = 0;            ///< Positive: port up [deg].
  double course = 0;          ///< As heading, of the way over ground; the heading of a sonar that stands still [deg].
  double speed = 0;           ///< Over ground [m/s].
  double depth = 0;           ///< Below z = 0 of the world [m]; 0 above.
  double altitude = 0;        ///< Above the first echo from below, by the ground truth [m]; 0: unknown.
  std::array<std::vector<std::uint16_t>, 2> sides;  ///< Port, starboard; from the sonar outwards.
};

/// The pings of several side-scan sonars of one run.
class SideScanLine {
 public:
  /// Reads all pings once, for the tracks and the loudest sample.
  SideScanLine(RecordedSonars recordings, const ExportOptions& options);

  [[nodiscard]] const std::vector<SideScanSonar>& sonars() const { return sonars_; }
  [[nodiscard]] bool is_geographic() const { return grid_.has_value(); }

  /// Gives all pings in the order of their times.
  void for_each(const std::function<void(std::size_t sonar, const SideScanPing& ping)>& take) const;

 private:
  /// Positions of the housing at the pings of a sonar.
  struct Track {
    std::vector<double> times;  // [s]
    std::vector<Vec3> places;   // [m]

    [[nodiscard]] Vec3 velocity(std::size_t ping) const;  // Between the pings before and after [m/s].
  };

  void survey(const RecordedTables& recording);
  [[nodiscard]] SideScanPing described(std::size_t sonar, const Ping& ping) const;

  RecordedSonars recordings_;
  ExportOptions options_;
  std::optional<LocalGrid> grid_;
  std::uint64_t start_ns_ = 0;
  std::vector<SideScanSonar> sonars_;
  std::vector<Track> tracks_;
};

/// A ping's time as clocks of survey files have it.
struct ClockTime {
  int year = 1970, month = 1, day = 1, day_of_year = 1;
  int hour = 0, minute = 0, second = 0;
  int millisecond = 0;
};
[[nodiscard]] ClockTime clock_time(std::uint64_t time_ns);

inline constexpr double kMetresPerSecondPerKnot = 1852.0 / 3600;

}  // namespace insonify
