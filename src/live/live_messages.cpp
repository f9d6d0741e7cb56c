// live_messages.cpp -- opens the channels of a LiveSender, and encodes and sends what they carry.

#include <algorithm>
#include <chrono>
#include <utility>

#include "insonify/live_sender.h"

namespace insonify {
namespace {

// A Unix time by the steady clock.
std::chrono::steady_clock::time_point steady_time(double unix) {
  const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  return std::chrono::steady_clock::now() -
         std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(now - unix));
}

}  // namespace

MessageOptions LiveSender::options_of(const MessageSource& source, std::size_t sonar) const {
  MessageOptions options = options_.messages;
  const auto gain = applied_gains_db_.find(sonar);
  const MessageLevels levels = SonarMessages(source, options, options_.form).levels();
  if (gain != applied_gains_db_.end() && levels.decibels) {
    options.low_db = levels.low_db - gain->second;
    options.high_db = levels.high_db - gain->second;
  }
  return options;
}

void LiveSender::open(const LiveWorld& world) {
  sent_latched_ = false;
  messages_.clear();
  transport_.begin(world);
  std::vector<std::string> labels;
  for (const Instance& instance : world.scene.instances) {
    labels.push_back(instance.name);
  }
  for (const SonarConfig& sonar : world.sonars) {
    MessageSource source = message_source(world.scenario, sonar);
    source.labels = labels;
    messages_.emplace_back(source, options_of(source, messages_.size()), options_.form);
    transport_.open(messages_.size() - 1, messages_.back().channels());
  }
}

// The scenario's text and the mountings of all sonars are one message each.
void LiveSender::send_latched(std::uint64_t time_ns) {
  for (std::size_t sonar = 0; sonar < messages_.size() && !sent_latched_; ++sonar) {
    const std::vector<MessageChannel>& channels = messages_[sonar].channels();
    for (std::size_t channel = 0; channel < channels.size(); ++channel) {
      const MessageKind kind = channels[channel].kind;
      if (channels[channel].latched && (sonar == 0 || kind == MessageKind::kDescription)) {
        transport_.send(
            sonar, channel, time_ns,
            kind == MessageKind::kTransforms ? SonarMessages::mountings(messages_) : messages_[sonar].encode(channel));
      }
    }
  }
  sent_latched_ = true;
}

// A message has the stamp of the pose that its ping was made from. Further pings from the same pose are later by the
// interval between them. On the scenario's own trajectory, the stamp is the time of transmission. A stamp of 0 means
// "the latest" to readers of transforms: the first one of a clock that begins at 0 is 1 ns.
void LiveSender::send(const LivePing& live) {
  if (!world_ || live.world->change != world_->change) {
    open(*live.world);
    world_ = live.world;
  }
  const auto sonar = static_cast<std::size_t>(live.sonar);
  SonarMessages& messages = messages_[sonar];
  const double transmitted = live.made_at - live.computing_time;
  const bool told = live.received_at > 0;
  const bool new_pose = told && std::exchange(received_at_[live.sonar], live.received_at) != live.received_at;
  const double by_clock = options_.live.clocked ? std::max(live.clock, live.stamp)
                                                : transmitted + (told ? live.stamp - live.received_at : 0);
  constexpr double kEarliest = 1e-9;
  messages.take(live.ping, std::max(kEarliest, new_pose ? live.stamp : by_clock));
  send_latched(messages.time_ns());
  for (std::size_t channel = 0; channel < messages.channels().size(); ++channel) {
    const MessageChannel& is = messages.channels()[channel];
    if (!is.latched && transport_.is_read(sonar, channel) &&
        (is.kind != MessageKind::kScan || messages.is_due(channel))) {
      transport_.send(sonar, channel, messages.time_ns(), messages.encode(channel));
    }
  }
  if (is_asked(live)) {
    const auto image = std::ranges::find(messages.channels(), MessageKind::kSonarImage, &MessageChannel::kind);
    answer(live.request, messages.encode(static_cast<std::size_t>(image - messages.channels().begin())), "");
  }
  options_.on_sent(steady_time(new_pose ? live.received_at : transmitted), live.computing_time);
}

}  // namespace insonify
