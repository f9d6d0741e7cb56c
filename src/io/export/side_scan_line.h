// side_scan_line.h -- recordings of side-scan sonars as survey files have them: samples of 16 bits from the sonar
// outwards, and the navigation of each ping.

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "io/export/navigation.h"

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

/// One ping with its navigation.
struct SideScanPing : Navigation {
  std::uint64_t number = 0;
  double altitude = 0;  ///< Above the first echo from below, by the ground truth [m]; 0: unknown.
  std::array<std::vector<std::uint16_t>, 2> sides;  ///< Port, starboard; from the sonar outwards.
};

/// The pings of several side-scan sonars of one run.
class SideScanLine {
 public:
  /// Reads all pings once, for the tracks and the loudest sample.
  SideScanLine(RecordedSonars recordings, const ExportOptions& options);

  [[nodiscard]] const std::vector<SideScanSonar>& sonars() const { return sonars_; }
  [[nodiscard]] bool is_geographic() const { return navigator_.grid().has_value(); }

  /// Gives all pings in the order of their times.
  void for_each(const std::function<void(std::size_t sonar, const SideScanPing& ping)>& take) const;

 private:
  void survey(const RecordedTables& recording);
  [[nodiscard]] SideScanPing described(std::size_t sonar, const Ping& ping) const;

  RecordedSonars recordings_;
  ExportOptions options_;
  Navigator navigator_;
  std::vector<SideScanSonar> sonars_;
  std::vector<Track> tracks_;
};

}  // namespace insonify
