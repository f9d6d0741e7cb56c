// viewer_texts.h -- text messages of the viewer's protocol (docs/design/viewer.md).

#pragma once

#include <string>
#include <vector>

#include "insonify/live_loop.h"
#include "serve/ping_source.h"
#include "serve/shown_scale.h"

namespace insonify {

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
