// foxglove_feed.cpp -- advertises channels and sends what clients have subscribed to.

#include "serve/foxglove_feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/version.h"

namespace insonify {

using SortedJson = nlohmann::json;

namespace {

std::string foxglove_text(const SortedJson& json) {
  return json.dump(-1, ' ', false, SortedJson::error_handler_t::replace);
}

// Opcode, subscription and time that stand before a message.
std::string data_head(std::uint32_t subscription, std::uint64_t time_ns) {
  constexpr char kMessageData = 1;
  std::array<char, 13> head{kMessageData};
  std::memcpy(head.data() + 1, &subscription, sizeof(subscription));
  std::memcpy(head.data() + 5, &time_ns, sizeof(time_ns));
  return {head.data(), head.size()};
}

std::uint32_t id_of(const SortedJson& value, const char* what) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0xffffffffU) {
    throw Error(fmt::format("{} must be a whole number", what));
  }
  return value.get<std::uint32_t>();
}

const SortedJson& list_of(const SortedJson& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end() || !found->is_array()) {
    throw Error(fmt::format("{} must be a list", key));
  }
  return *found;
}

std::vector<std::string> names_of(const LiveWorld& world) {
  std::vector<std::string> names;
  for (const SonarConfig& sonar : world.sonars) {
    names.push_back(sonar.name);
  }
  return names;
}

bool is_told_once(const MessageChannel& channel) {
  return channel.kind == MessageKind::kScenario;
}

}  // namespace

/// One client: its subscriptions. Errors of form end the connection, by exception.
class FoxgloveClient : public Client {
 public:
  FoxgloveClient(Connection& connection, FoxgloveFeed& feed) : connection_(connection), feed_(feed) {
    feed_.clients_.insert(this);
    feed_.hub_.client_came();
    tell(feed_.info_text());
    if (!feed_.channels_.empty()) {
      tell(feed_.advertise_text());
    }
  }
  ~FoxgloveClient() override {
    feed_.clients_.erase(this);
    feed_.hub_.client_left();
  }
  FoxgloveClient(const FoxgloveClient&) = delete;
  FoxgloveClient& operator=(const FoxgloveClient&) = delete;

  void on_binary(std::string_view /*bytes*/) override { warn("nothing can be published here"); }

  void on_text(std::string_view text) override {
    const SortedJson message = SortedJson::parse(text, nullptr, false);
    if (message.is_discarded() || !message.is_object() || !message.contains("op") || !message["op"].is_string()) {
      throw Error("the message is no JSON object with an op");
    }
    const std::string op = message["op"].get<std::string>();
    if (op == "subscribe") {
      for (const SortedJson& one : list_of(message, "subscriptions")) {
        subscribe(one);
      }
    } else if (op == "unsubscribe") {
      for (const SortedJson& one : list_of(message, "subscriptionIds")) {
        subscriptions_.erase(id_of(one, "subscriptionIds"));
      }
    } else {
      warn(fmt::format("{} is not done here", printable(op)));
    }
  }

  void tell(std::string text) { connection_.send({.bytes = std::make_shared<const std::string>(std::move(text))}); }

  void tell_status(int level, const std::string& text) {
    tell(foxglove_text({{"op", "status"}, {"level", level}, {"message", text}}));
  }

  // A scenario's text (`once`) goes to each subscription once. A message that is sent again goes to subscriptions that
  // have none of its sonar yet.
  void send(std::uint32_t channel, bool once, const EncodedMessage& message) {
    for (auto& [id, subscription] : subscriptions_) {
      if (subscription.channel != channel || (once && !subscription.told.empty()) ||
          (message.again && subscription.told.contains(message.sonar))) {
        continue;
      }
      subscription.told.insert(message.sonar);
      // Sonars share topics: each has a stream of its own, so that none drops the messages of another.
      constexpr std::uint32_t kSonars = 1U << 16U;
      connection_.send({.bytes = message.bytes,
                        .head = data_head(id, message.time_ns),
                        .binary = true,
                        .droppable = !once,
                        .stream = channel * kSonars + static_cast<std::uint32_t>(message.sonar)});
    }
  }

  // Whether there is a subscription, or if each gets a single message, one that has none yet.
  [[nodiscard]] bool wants(std::uint32_t channel, bool once) const {
    return std::ranges::any_of(subscriptions_, [&](const auto& one) {
      return one.second.channel == channel && !(once && !one.second.told.empty());
    });
  }

  void forget_channels() { subscriptions_.clear(); }

  // Another world: its scenario is to be told, and its pings.
  void forget_told() {
    for (auto& [id, subscription] : subscriptions_) {
      subscription.told.clear();
    }
  }

 private:
  struct Subscription {
    std::uint32_t channel = 0;
    std::set<int> told;  // Sonars that it has got a message about.
  };

  void warn(const std::string& text) {
    constexpr int kWarning = 1;
    tell_status(kWarning, text);
  }

  void subscribe(const SortedJson& one) {
    if (!one.is_object() || !one.contains("id") || !one.contains("channelId")) {
      throw Error("a subscription must have an id and a channelId");
    }
    constexpr std::size_t kMost = 1000;
    const std::uint32_t id = id_of(one["id"], "id"), channel = id_of(one["channelId"], "channelId");
    const auto is_it = [&](const auto& known) { return known.id == channel; };
    if (std::ranges::none_of(feed_.channels_, is_it)) {
      warn(fmt::format("there is no channel {}", channel));
    } else if (subscriptions_.contains(id) || subscriptions_.size() >= kMost) {
      warn(fmt::format("subscription {} is there already, or there are too many", id));
    } else {
      subscriptions_[id] = {.channel = channel, .told = {}};
      feed_.want_last(channel);
    }
  }

  Connection& connection_;
  FoxgloveFeed& feed_;
  std::map<std::uint32_t, Subscription> subscriptions_;
};

FoxgloveFeed::FoxgloveFeed(Hub& hub, const MessageOptions& options) : hub_(hub) {
  encoder_ = std::make_unique<FoxgloveEncoder>(
      options, [this](const EncodedMessage& message) { hub_.post([this, message] { deliver(message); }); });
  hub_.join(*this);
}

FoxgloveFeed::~FoxgloveFeed() {
  hub_.leave(*this);
}

std::unique_ptr<Client> FoxgloveFeed::client(Connection& connection) {
  return std::make_unique<FoxgloveClient>(connection, *this);
}

std::string FoxgloveFeed::info_text() const {
  return foxglove_text({{"op", "serverInfo"},
                        {"name", fmt::format("insonify {}", kVersion)},
                        {"capabilities", SortedJson::array()},
                        {"supportedEncodings", SortedJson::array()},
                        {"metadata", SortedJson::object()},
                        {"sessionId", fmt::format("{}", std::chrono::system_clock::now().time_since_epoch().count())}});
}

std::string FoxgloveFeed::advertise_text() const {
  SortedJson channels = SortedJson::array();
  for (const Channel& channel : channels_) {
    channels.push_back({{"id", channel.id},
                        {"topic", channel.is.topic},
                        {"encoding", "cdr"},
                        {"schemaName", channel.is.type},
                        {"schemaEncoding", "ros2msg"},
                        {"schema", channel.is.definition}});
  }
  return foxglove_text({{"op", "advertise"}, {"channels", channels}});
}

// Stamps are those of the clock at the start of a run, and go on from those of the run before.
void FoxgloveFeed::on_world() {
  const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  time_offset_ = std::max(now, last_time_);
  const std::vector<std::string> names = names_of(hub_.world());
  for (FoxgloveClient* client : clients_) {
    client->forget_told();
  }
  if (names == names_) {
    return;
  }
  SortedJson gone = SortedJson::array();
  for (const Channel& channel : channels_) {
    gone.push_back(channel.id);
  }
  channels_.clear();
  names_ = names;
  for (std::size_t sonar = 0; sonar < names.size(); ++sonar) {
    const SonarMessages messages(message_source(hub_.world().scenario, hub_.world().sonars[sonar]));
    for (std::size_t i = 0; i < messages.channels().size(); ++i) {
      const MessageChannel& is = messages.channels()[i];
      const auto found = std::ranges::find_if(channels_, [&](const Channel& one) { return one.is.topic == is.topic; });
      const bool is_new = found == channels_.end();
      Channel& channel = is_new ? channels_.emplace_back() : *found;
      if (is_new) {
        channel.id = next_id_++;
        channel.is = is;
      }
      channel.sources[static_cast<int>(sonar)] = i;
    }
  }
  for (FoxgloveClient* client : clients_) {
    client->forget_channels();
    if (!gone.empty()) {
      client->tell(foxglove_text({{"op", "unadvertise"}, {"channelIds", gone}}));
    }
    client->tell(advertise_text());
  }
}

bool FoxgloveFeed::is_wanted(const Channel& channel) const {
  return std::ranges::any_of(
      clients_, [&](const FoxgloveClient* client) { return client->wants(channel.id, is_told_once(channel.is)); });
}

void FoxgloveFeed::on_ping(SharedPing& shared) {
  if (names_of(hub_.world()) != names_) {
    return;  // A ping of other sonars, whose channels will be there once on_world() is called: then it is the last.
  }
  EncoderJob job{.ping = shared.shared(), .channels = {}, .time_offset = time_offset_};
  last_time_ = time_offset_ + job.ping->ping.time;
  for (const Channel& channel : channels_) {
    const auto source = channel.sources.find(job.ping->sonar);
    if (source != channel.sources.end() && is_wanted(channel)) {
      job.channels.insert(source->second);
    }
  }
  if (!job.channels.empty()) {
    encoder_->add(std::move(job));
  }
}

// A client that comes late, or while nothing is made, gets the last message at once.
void FoxgloveFeed::want_last(std::uint32_t id) {
  for (const Channel& channel : channels_) {
    if (channel.id != id) {
      continue;
    }
    for (const auto& [sonar, source] : channel.sources) {
      if (const auto& ping = hub_.last_ping(sonar)) {
        encoder_->add({.ping = ping->shared(), .channels = {source}, .time_offset = time_offset_, .again = true});
      }
    }
  }
}

void FoxgloveFeed::deliver(const EncodedMessage& message) {
  if (message.world.get() != &hub_.world()) {
    return;  // What it tells is no longer so.
  }
  for (const Channel& channel : channels_) {
    const auto source = channel.sources.find(message.sonar);
    if (source != channel.sources.end() && source->second == message.channel) {
      for (FoxgloveClient* client : clients_) {
        client->send(channel.id, is_told_once(channel.is), message);
      }
    }
  }
}

void FoxgloveFeed::on_note(const std::string& text) {
  constexpr int kInfo = 0;
  for (FoxgloveClient* client : clients_) {
    client->tell_status(kInfo, text);
  }
}

}  // namespace insonify
