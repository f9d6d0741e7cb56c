// foxglove_client.h -- one client of the Foxglove WebSocket protocol: its connection and its subscriptions.

#pragma once

#include <nlohmann/json_fwd.hpp>

#include "serve/foxglove_feed.h"

namespace insonify {

/// One client: its subscriptions. A message of wrong form ends the connection, by exception.
class FoxgloveClient : public Client {
 public:
  /// Sends the server's name and its channels. Both arguments must outlive the client.
  FoxgloveClient(Connection& connection, FoxgloveFeed& feed);
  ~FoxgloveClient() override;
  FoxgloveClient(const FoxgloveClient&) = delete;
  FoxgloveClient& operator=(const FoxgloveClient&) = delete;

  void on_binary(std::string_view bytes) override;
  void on_text(std::string_view text) override;

  void send_text(std::string text);
  void send_status(FoxgloveStatus level, const std::string& text);

  /// Sends a message to the subscriptions of a channel. A scenario's text (`once`) goes to each subscription once. A
  /// message that is sent again goes to subscriptions that have none of its sonar yet.
  void send(std::uint32_t channel, bool once, const EncodedMessage& message);

  /// Whether there is a subscription, or if each gets a single message, one that has none yet.
  [[nodiscard]] bool wants(std::uint32_t channel, bool once) const;

  void forget_channels() { subscriptions_.clear(); }

  /// The scenario has been replaced: its text and its pings are sent anew.
  void forget_sent();

 private:
  struct Subscription {
    std::uint32_t channel = 0;
    std::set<int> sent;  // Sonars of which a message has been sent.
  };

  void subscribe(const nlohmann::json& wanted);

  Connection& connection_;
  FoxgloveFeed& feed_;
  std::map<std::uint32_t, Subscription> subscriptions_;  // By the client's number.
};

}  // namespace insonify
