// foxglove_feed.h -- the Foxglove WebSocket protocol: channels of ROS 2 messages for any number of clients.

#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "serve/foxglove_encoder.h"
#include "serve/hub.h"

namespace insonify {

/// Subprotocols of current clients, and of those until 2025.
inline constexpr std::string_view kFoxgloveSdkProtocol = "foxglove.sdk.v1";
inline constexpr std::string_view kFoxgloveProtocol = "foxglove.websocket.v1";

/// An advertised channel, of one sonar or of all sonars that share a topic.
struct FoxgloveChannel {
  std::uint32_t id = 0;
  MessageChannel is;
  std::map<int, std::size_t> sources;  ///< Index into SonarMessages::channels(), by sonar.
};

/// Levels of a status message.
enum class FoxgloveStatus { kInfo = 0, kWarning = 1 };

class FoxgloveClient;

/// State shared by all Foxglove clients. For the server's thread.
class FoxgloveFeed : public HubMember {
 public:
  FoxgloveFeed(Hub& hub, const MessageOptions& options);
  ~FoxgloveFeed() override;
  FoxgloveFeed(const FoxgloveFeed&) = delete;
  FoxgloveFeed& operator=(const FoxgloveFeed&) = delete;

  void on_ping(SharedPing& ping) override;
  void on_world() override;
  void on_state() override;
  void on_note(const std::string& text) override;

  [[nodiscard]] std::unique_ptr<Client> client(Connection& connection);

 private:
  friend class FoxgloveClient;

  void deliver(const EncodedMessage& message);
  [[nodiscard]] bool is_wanted(const FoxgloveChannel& channel) const;
  void want_last(std::uint32_t id);

  Hub& hub_;
  std::set<FoxgloveClient*> clients_;
  std::vector<FoxgloveChannel> channels_;
  std::vector<std::string> names_;  // Sonars for which channels were made.
  std::uint32_t next_id_ = 1;
  double time_offset_ = 0, last_time_ = 0;  // [s]
  std::unique_ptr<FoxgloveEncoder> encoder_;
};

}  // namespace insonify
