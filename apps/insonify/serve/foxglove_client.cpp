// foxglove_client.cpp -- handles a client's subscriptions and sends it messages.

#include "serve/foxglove_client.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/version.h"
#include "serve/foxglove_parameters.h"
#include "serve/json_messages.h"

namespace insonify {
namespace {

// Header of a message: opcode, subscription and time.
std::string data_head(std::uint32_t subscription, std::uint64_t time_ns) {
  constexpr char kMessageData = 1;
  std::array<char, 13> head{kMessageData};
  std::memcpy(head.data() + 1, &subscription, sizeof(subscription));
  std::memcpy(head.data() + 5, &time_ns, sizeof(time_ns));
  return {head.data(), head.size()};
}

std::uint32_t id_of(const nlohmann::json& value, const char* what) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0xffffffffU) {
    throw Error(fmt::format("{} must be a whole number", what));
  }
  return value.get<std::uint32_t>();
}

const nlohmann::json& list_of(const nlohmann::json& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end() || !found->is_array()) {
    throw Error(fmt::format("{} must be a list", key));
  }
  return *found;
}

std::string foxglove_text(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// Name and session of this server, for a new client.
std::string server_info_text() {
  return foxglove_text({{"op", "serverInfo"},
                        {"name", fmt::format("insonify {}", kVersion)},
                        {"capabilities", {"time", "parameters", "parametersSubscribe"}},
                        {"supportedEncodings", nlohmann::json::array()},
                        {"metadata", nlohmann::json::object()},
                        {"sessionId", fmt::format("{}", std::chrono::system_clock::now().time_since_epoch().count())}});
}

// @param id  Of the request; null: none.
std::string parameters_text(nlohmann::json parameters, const nlohmann::json& id) {
  nlohmann::json text = {{"op", "parameterValues"}, {"parameters", std::move(parameters)}};
  if (id.is_string()) {
    text["id"] = id;
  }
  return foxglove_text(text);
}

std::string status_text(FoxgloveStatus level, const std::string& text) {
  return foxglove_text({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", text}});
}

}  // namespace

std::string advertise_text(std::span<const FoxgloveChannel> channels) {
  nlohmann::json list = nlohmann::json::array();
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

FoxgloveClient::FoxgloveClient(Connection& connection, FoxgloveFeed& feed) : connection_(connection), feed_(feed) {
  feed_.clients_.insert(this);
  feed_.hub_.client_came();
  send_text(server_info_text());
  if (!feed_.channels_.empty()) {
    send_text(advertise_text(feed_.channels_));
  }
}

FoxgloveClient::~FoxgloveClient() {
  feed_.clients_.erase(this);
  feed_.hub_.client_left();
}

void FoxgloveClient::on_binary(std::string_view /*bytes*/) {
  send_status(FoxgloveStatus::kWarning, "publishing is not supported");
}

void FoxgloveClient::on_text(std::string_view text) {
  const nlohmann::json message = parse_message(text);
  if (!message.is_object() || !message.contains("op") || !message["op"].is_string()) {
    throw Error("the message is not a JSON object with an op");
  }
  const std::string op = message["op"].get<std::string>();
  if (op == "subscribe") {
    for (const nlohmann::json& one : list_of(message, "subscriptions")) {
      subscribe(one);
    }
  } else if (op == "unsubscribe") {
    for (const nlohmann::json& one : list_of(message, "subscriptionIds")) {
      subscriptions_.erase(id_of(one, "subscriptionIds"));
    }
  } else if (!carry_out(op, message)) {
    send_status(FoxgloveStatus::kWarning, fmt::format("{} is not supported", printable(op)));
  }
}

// Carries out an op about parameters. @return  False for another.
bool FoxgloveClient::carry_out(const std::string& op, const nlohmann::json& message) {
  if (op == "getParameters") {
    send_text(parameters_text(foxglove_parameters(feed_.hub_, texts_of(message, "parameterNames")),
                              message.value("id", nlohmann::json())));
  } else if (op == "setParameters") {
    set_parameters(message);
  } else if (op == "subscribeParameterUpdates") {
    watched_ = texts_of(message, "parameterNames");
    sent_parameters_.clear();
    send_changed_parameters();
  } else if (op == "unsubscribeParameterUpdates") {
    watched_.reset();
  } else {
    return false;
  }
  return true;
}

// Sets all and then answers once, with the values that they have; each refusal is a status. The client may be gone by
// then.
void FoxgloveClient::set_parameters(const nlohmann::json& message) {
  struct Request {
    nlohmann::json id;
    std::vector<std::string> names = {};
    std::size_t open = 0;  // Parameters whose change has not been made or refused.
  };
  const nlohmann::json& parameters = list_of(message, "parameters");
  const auto request = std::make_shared<Request>(Request{message.value("id", nlohmann::json())});
  request->open = parameters.size();
  for (const nlohmann::json& parameter : parameters) {
    request->names.push_back(text_of(parameter, "name"));
  }
  const auto answer = [weak = std::weak_ptr(self_), &hub = feed_.hub_, request](const std::string& error) {
    hub.post([weak, &hub, request, error] {
      if (const auto self = weak.lock()) {
        if (!error.empty()) {
          (*self)->send_status(FoxgloveStatus::kWarning, error);
        }
        if (--request->open == 0 && request->id.is_string()) {
          (*self)->send_text(parameters_text(foxglove_parameters(hub, request->names), request->id));
        }
      }
      hub.send_state_soon();
    });
  };
  for (const nlohmann::json& parameter : parameters) {
    try {
      set_foxglove_parameter(feed_.hub_, parameter, answer);
    } catch (const Error& error) {
      answer(error.what());
    }
  }
}

void FoxgloveClient::send_changed_parameters() {
  if (!watched_) {
    return;
  }
  std::string text = parameters_text(foxglove_parameters(feed_.hub_, *watched_), {});
  if (text != sent_parameters_) {
    sent_parameters_ = text;
    send_text(std::move(text));
  }
}

void FoxgloveClient::send_time(std::uint64_t time_ns) {
  constexpr char kTime = 2;
  std::array<char, 9> bytes{kTime};
  std::memcpy(bytes.data() + 1, &time_ns, sizeof(time_ns));
  connection_.send(
      {.bytes = std::make_shared<const std::string>(bytes.data(), bytes.size()), .binary = true, .droppable = true});
}

void FoxgloveClient::send_text(std::string text) {
  connection_.send({.bytes = std::make_shared<const std::string>(std::move(text))});
}

void FoxgloveClient::send_status(FoxgloveStatus level, const std::string& text) {
  send_text(status_text(level, text));
}

void FoxgloveClient::send(std::uint32_t channel, bool once, const EncodedMessage& message) {
  for (auto& [id, subscription] : subscriptions_) {
    if (subscription.channel != channel || (once && !subscription.sent.empty()) ||
        (message.again && subscription.sent.contains(message.sonar))) {
      continue;
    }
    subscription.sent.insert(message.sonar);
    // Sonars share topics; a stream of its own per sonar keeps one from dropping another's messages.
    constexpr std::uint32_t kSonars = 1U << 16U;
    connection_.send({.bytes = message.bytes,
                      .head = data_head(id, message.time_ns),
                      .binary = true,
                      .droppable = !once,
                      .stream = channel * kSonars + static_cast<std::uint32_t>(message.sonar)});
  }
}

bool FoxgloveClient::wants(std::uint32_t channel, bool once) const {
  return std::ranges::any_of(subscriptions_, [&](const auto& one) {
    return one.second.channel == channel && !(once && !one.second.sent.empty());
  });
}

void FoxgloveClient::forget_sent() {
  for (auto& [id, subscription] : subscriptions_) {
    subscription.sent.clear();
  }
}

void FoxgloveClient::subscribe(const nlohmann::json& wanted) {
  if (!wanted.is_object() || !wanted.contains("id") || !wanted.contains("channelId")) {
    throw Error("a subscription must have an id and a channelId");
  }
  constexpr std::size_t kMost = 1000;
  const std::uint32_t id = id_of(wanted["id"], "id"), channel = id_of(wanted["channelId"], "channelId");
  const auto is_it = [&](const auto& known) { return known.id == channel; };
  if (std::ranges::none_of(feed_.channels_, is_it)) {
    send_status(FoxgloveStatus::kWarning, fmt::format("there is no channel {}", channel));
  } else if (subscriptions_.contains(id) || subscriptions_.size() >= kMost) {
    send_status(FoxgloveStatus::kWarning, fmt::format("subscription {} exists already, or there are too many", id));
  } else {
    subscriptions_[id] = {.channel = channel, .sent = {}};
    feed_.want_last(channel);
  }
}

}  // namespace insonify
