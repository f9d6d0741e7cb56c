// foxglove_texts.cpp -- writes the JSON texts of the Foxglove WebSocket protocol.

#include "serve/foxglove_texts.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "insonify/version.h"

namespace insonify {
namespace {

using SortedJson = nlohmann::json;

std::string foxglove_text(const SortedJson& json) {
  return json.dump(-1, ' ', false, SortedJson::error_handler_t::replace);
}

}  // namespace

std::string server_info_text() {
  return foxglove_text({{"op", "serverInfo"},
                        {"name", fmt::format("insonify {}", kVersion)},
                        {"capabilities", SortedJson::array()},
                        {"supportedEncodings", SortedJson::array()},
                        {"metadata", SortedJson::object()},
                        {"sessionId", fmt::format("{}", std::chrono::system_clock::now().time_since_epoch().count())}});
}

std::string status_text(FoxgloveStatus level, const std::string& text) {
  return foxglove_text({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", text}});
}

std::string advertise_text(std::span<const FoxgloveChannel> channels) {
  SortedJson list = SortedJson::array();
  for (const FoxgloveChannel& channel : channels) {
    list.push_back({{"id", channel.id},
                    {"topic", channel.is.topic},
                    {"encoding", "cdr"},
                    {"schemaName", channel.is.type},
                    {"schemaEncoding", "ros2msg"},
                    {"schema", channel.is.definition}});
  }
  return foxglove_text({{"op", "advertise"}, {"channels", list}});
}

std::string unadvertise_text(const std::vector<std::uint32_t>& ids) {
  return foxglove_text({{"op", "unadvertise"}, {"channelIds", ids}});
}

}  // namespace insonify
