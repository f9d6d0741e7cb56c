// viewer_texts.h -- text messages of the viewer's protocol (docs/design/viewer.md).

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "insonify/live_loop.h"

namespace insonify {

/// Levels that a picture of a sonar shows by default [dB], with kShownGainPerDecade where shown_gain() says so.
using ShownLevels = std::pair<double, double>;

/// Gain over range with which pings of a sonar are shown [dB/decade].
[[nodiscard]] double shown_gain(const LiveWorld& world, int sonar);
/// Levels that fit a ping.
[[nodiscard]] ShownLevels shown_levels(const LivePing& ping);

/// @param levels  Of each sonar.
[[nodiscard]] std::string hello_text(const LiveWorld& world, const std::vector<ShownLevels>& levels);

/// What the server measures.
struct ServerCounts {
  double pings_per_second = 0, ms_per_ping = 0;
  std::uint64_t clients = 0;
};
[[nodiscard]] std::string state_text(const LiveState& state, const ServerCounts& counts, const std::string& sonar,
                                     std::uint64_t dropped);

[[nodiscard]] std::string error_text(const std::string& text, const std::string& of);
[[nodiscard]] std::string note_text(const std::string& text);
[[nodiscard]] std::string closing_text(const std::string& reason);
[[nodiscard]] std::string saved_text(const std::string& yaml);

}  // namespace insonify
