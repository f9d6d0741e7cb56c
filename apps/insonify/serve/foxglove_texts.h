// foxglove_texts.h -- JSON messages of a Foxglove WebSocket server.

#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "insonify/messages.h"

namespace insonify {

/// An advertised channel, of one sonar or of all sonars that share a topic.
struct FoxgloveChannel {
  std::uint32_t id = 0;
  MessageChannel is;
  std::map<int, std::size_t> sources;  ///< Index into SonarMessages::channels(), by sonar.
};

/// Levels of a status message.
enum class FoxgloveStatus { kInfo = 0, kWarning = 1 };

/// Name and session of this server, for a new client.
[[nodiscard]] std::string server_info_text();
[[nodiscard]] std::string status_text(FoxgloveStatus level, const std::string& text);
[[nodiscard]] std::string advertise_text(std::span<const FoxgloveChannel> channels);
[[nodiscard]] std::string unadvertise_text(const std::vector<std::uint32_t>& ids);

}  // namespace insonify
