// foxglove_feed.cpp -- makes the channels of a scenario's sonars and passes encoded messages to the clients.

#include "serve/foxglove_feed.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "serve/foxglove_client.h"

namespace insonify {
namespace {

std::vector<std::string> names_of(const LiveWorld& world) {
  std::vector<std::string> names;
  for (const SonarConfig& sonar : world.sonars) {
    names.push_back(sonar.name);
  }
  return names;
}

bool is_sent_once(const MessageChannel& channel) {
  return channel.kind == MessageKind::kScenario;
}

}  // namespace

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

// Stamps start at the clock's time when a run starts, but not before the last stamp of the previous run.
void FoxgloveFeed::on_world() {
  const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  time_offset_ = std::max(now, last_time_);
  const std::vector<std::string> names = names_of(hub_.world());
  for (FoxgloveClient* client : clients_) {
    client->forget_sent();
    client->send_changed_parameters();
  }
  if (names == names_) {
    return;
  }
  std::vector<std::uint32_t> gone;
  for (const FoxgloveChannel& channel : channels_) {
    gone.push_back(channel.id);
  }
  channels_.clear();
  names_ = names;
  for (std::size_t sonar = 0; sonar < names.size(); ++sonar) {
    const SonarMessages messages(message_source(hub_.world().scenario, hub_.world().sonars[sonar]));
    for (std::size_t i = 0; i < messages.channels().size(); ++i) {
      const MessageChannel& is = messages.channels()[i];
      const auto found =
          std::ranges::find_if(channels_, [&](const FoxgloveChannel& one) { return one.is.topic == is.topic; });
      const bool is_new = found == channels_.end();
      FoxgloveChannel& channel = is_new ? channels_.emplace_back() : *found;
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
      client->send_text(unadvertise_text(gone));
    }
    client->send_text(advertise_text(channels_));
  }
}

void FoxgloveFeed::on_state() {
  for (FoxgloveClient* client : clients_) {
    client->send_changed_parameters();
  }
}

bool FoxgloveFeed::is_wanted(const FoxgloveChannel& channel) const {
  return std::ranges::any_of(
      clients_, [&](const FoxgloveClient* client) { return client->wants(channel.id, is_sent_once(channel.is)); });
}

void FoxgloveFeed::on_ping(SharedPing& shared) {
  if (names_of(hub_.world()) != names_) {
    return;  // A ping of new sonars: on_world(), called next, makes their channels and sends it as the last ping.
  }
  EncoderJob job{.ping = shared.shared(), .channels = {}, .time_offset = time_offset_};
  last_time_ = time_offset_ + job.ping->ping.time;
  for (FoxgloveClient* client : clients_) {
    client->send_time(static_cast<std::uint64_t>(std::llround(last_time_ * 1e9)));
  }
  for (const FoxgloveChannel& channel : channels_) {
    const auto source = channel.sources.find(job.ping->sonar);
    if (source != channel.sources.end() && is_wanted(channel)) {
      job.channels.insert(source->second);
    }
  }
  if (!job.channels.empty()) {
    encoder_->add(std::move(job));
  }
}

// Late clients, and clients during a pause, get the last message at once.
void FoxgloveFeed::want_last(std::uint32_t id) {
  for (const FoxgloveChannel& channel : channels_) {
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
    return;  // Its scenario has been replaced.
  }
  for (const FoxgloveChannel& channel : channels_) {
    const auto source = channel.sources.find(message.sonar);
    if (source != channel.sources.end() && source->second == message.channel) {
      for (FoxgloveClient* client : clients_) {
        client->send(channel.id, is_sent_once(channel.is), message);
      }
    }
  }
}

void FoxgloveFeed::on_note(const std::string& text) {
  for (FoxgloveClient* client : clients_) {
    client->send_status(FoxgloveStatus::kInfo, text);
  }
}

}  // namespace insonify
