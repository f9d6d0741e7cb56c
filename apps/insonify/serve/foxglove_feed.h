// foxglove_feed.h -- the Foxglove WebSocket protocol: channels of ROS 2 messages for any number of clients.

#pragma once

#include <map>
#include <set>

#include "serve/foxglove_encoder.h"
#include "serve/hub.h"

namespace insonify {

/// The name of today's clients, and that of those until 2025.
inline constexpr std::string_view kFoxgloveSdkProtocol = "foxglove.sdk.v1";
inline constexpr std::string_view kFoxgloveProtocol = "foxglove.websocket.v1";

class FoxgloveClient;

/// What all Foxglove clients share. In the server's thread.
class FoxgloveFeed : public HubMember {
 public:
  FoxgloveFeed(Hub& hub, const MessageOptions& options);
  ~FoxgloveFeed() override;
  FoxgloveFeed(const FoxgloveFeed&) = delete;
  FoxgloveFeed& operator=(const FoxgloveFeed&) = delete;

  void on_ping(SharedPing& ping) override;
  void on_world() override;
  void on_state() override {}
  void on_note(const std::string& text) override;

  [[nodiscard]] std::unique_ptr<Client> client(Connection& connection);

 private:
  friend class FoxgloveClient;

  // A channel as advertised: of one sonar, or where topics are shared, of them all.
  struct Channel {
    std::uint32_t id = 0;
    MessageChannel is;
    std::map<int, std::size_t> sources;  // Index into SonarMessages::channels(), by sonar.
  };

  void deliver(const EncodedMessage& message);
  [[nodiscard]] bool is_wanted(const Channel& channel) const;
  [[nodiscard]] std::string info_text() const;
  [[nodiscard]] std::string advertise_text() const;
  void want_last(std::uint32_t id);

  Hub& hub_;
  std::set<FoxgloveClient*> clients_;
  std::vector<Channel> channels_;
  std::vector<std::string> names_;  // Names of the sonars when channels were made.
  std::uint32_t next_id_ = 1;
  double time_offset_ = 0, last_time_ = 0;  // [s]
  std::unique_ptr<FoxgloveEncoder> encoder_;
};

}  // namespace insonify
