// foxglove_client.h -- one client of the Foxglove WebSocket protocol: its connection and its subscriptions.

#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>

#include "serve/foxglove_feed.h"

namespace insonify {

/// One client and its subscriptions. A malformed message ends the connection, by exception.
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
  /// repeated message goes to subscriptions that have none of its sonar yet.
  void send(std::uint32_t channel, bool once, const EncodedMessage& message);

  /// Whether there is a subscription; with `once`, one that has not had its message.
  [[nodiscard]] bool wants(std::uint32_t channel, bool once) const;

  void forget_channels() { subscriptions_.clear(); }

  /// Sends the values of the parameters that it has subscribed to, if they have changed.
  void send_changed_parameters();

  /// Sends the time of the latest ping [ns].
  void send_time(std::uint64_t time_ns);

  /// To be called when the scenario was replaced: its text and pings are sent again.
  void forget_sent();

 private:
  struct Subscription {
    std::uint32_t channel = 0;
    std::set<int> sent;  // Sonars whose messages were sent.
  };

  void subscribe(const nlohmann::json& wanted);
  [[nodiscard]] bool carry_out(const std::string& op, const nlohmann::json& message);
  void set_parameters(const nlohmann::json& message);

  Connection& connection_;
  FoxgloveFeed& feed_;
  std::map<std::uint32_t, Subscription> subscriptions_;  // By the client's number.
  std::optional<std::vector<std::string>> watched_;      // Parameters; empty: all. None: no subscription.
  std::string sent_parameters_;
  std::shared_ptr<FoxgloveClient*> self_ = std::make_shared<FoxgloveClient*>(this);  // Ends with it: for late answers.
};

/// JSON messages about channels.
[[nodiscard]] std::string advertise_text(std::span<const FoxgloveChannel> channels);
[[nodiscard]] std::string unadvertise_text(const std::vector<std::uint32_t>& ids);

}  // namespace insonify
