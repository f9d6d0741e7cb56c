// viewer_texts.h -- text messages of the viewer's protocol (docs/design/viewer.md), and the display levels that they
// name.

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "insonify/live_loop.h"
#include "serve/ping_source.h"

namespace insonify {

/// Darkest and brightest level of a picture [dB], after shown_gain().
using ShownLevels = std::pair<double, double>;

/// Gain over range in the display of a sonar's pings [dB/decade].
[[nodiscard]] double shown_gain(const LiveWorld& world, int sonar);

/// Fits levels as `insonify draw` does: to the first ping of a forward-looking sonar, or to all pings of a scanning
/// head's first turn, since a single one may hold only noise.
class ShownScale {
 public:
  /// Adds a ping of the sonar.
  /// @return  Whether levels() changed.
  bool add(const LivePing& live);

  /// Absent before the first ping.
  [[nodiscard]] const std::optional<ShownLevels>& levels() const { return levels_; }

 private:
  std::optional<ShownLevels> levels_;
  std::vector<float> intensities_;  // Intensities of the pings so far, until the scale is complete.
  double full_scale_ = 0;
  std::size_t pings_ = 0;
  bool complete_ = false;
};

/// @param levels    Of each sonar.
/// @param playback  The recording; null for a simulation.
[[nodiscard]] std::string hello_text(const LiveWorld& world, const std::vector<ShownLevels>& levels,
                                     const Playback* playback);

/// Rates measured by the server.
struct ServerCounts {
  double pings_per_second = 0, ms_per_ping = 0;
  std::uint64_t clients = 0;
};
[[nodiscard]] std::string state_text(const LiveState& state, const ServerCounts& counts, const std::string& sonar,
                                     std::uint64_t dropped);

[[nodiscard]] std::string levels_text(const std::string& sonar, const ShownLevels& levels);
[[nodiscard]] std::string error_text(const std::string& text, const std::string& of);
[[nodiscard]] std::string note_text(const std::string& text);
[[nodiscard]] std::string closing_text(const std::string& reason);
[[nodiscard]] std::string saved_text(const std::string& yaml);

}  // namespace insonify
