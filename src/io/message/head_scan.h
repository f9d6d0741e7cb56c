// head_scan.h -- the first returns of a scanning head's pings, by whole turns.

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "insonify/picture.h"
#include "insonify/ping.h"
#include "insonify/sonar_config.h"
#include "io/message/encode.h"

namespace insonify {

/// Share of the scale of levels from which on an echo is a return.
inline constexpr double kReturnShare = 0.5;

/// Range of a ping's first return: the first bin at kReturnShare of the display's scale or above, behind one that is
/// below it; bins above it from the first on are the transmission's.
/// @param raised  A ping of one beam, with the gain over range.
/// @return  Index of the bin; none without a return.
[[nodiscard]] std::optional<int> first_return(const Ping& raised, const Display& display);

/// Collects the pings of a scanning head. A scan is a whole turn, wherever it began, or a sweep from edge to edge of
/// the sector. After a missing ping another begins.
class HeadScan {
 public:
  /// @param ping     As received; `raised` with the gain over range.
  /// @param time_ns  Stamp of its messages.
  void add(const Ping& ping, const Ping& raised, std::uint64_t time_ns, const SonarConfig& sonar,
           const Display& display);

  /// The scan that ended with the last ping; none within a scan.
  struct Ended {
    std::uint64_t time_ns = 0;     ///< Of its first ping.
    std::uint64_t first_ping = 0;  ///< Number.
    LineScan scan;
  };
  [[nodiscard]] const std::optional<Ended>& ended() const { return ended_; }

 private:
  struct Line {
    std::uint64_t number, time_ns;
    double angle;
    float range, intensity;
  };
  [[nodiscard]] Ended made(const SonarConfig& sonar) const;

  std::vector<Line> lines_;
  std::optional<Ended> ended_;
};

}  // namespace insonify
