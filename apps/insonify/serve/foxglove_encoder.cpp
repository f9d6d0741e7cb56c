// foxglove_encoder.cpp -- encodes pings from a short queue.

#include "serve/foxglove_encoder.h"

#include <algorithm>

#include "console/console.h"
#include "insonify/error.h"

namespace insonify {

FoxgloveEncoder::FoxgloveEncoder(const MessageOptions& options, std::function<void(EncodedMessage)> deliver)
    : options_(options), deliver_(std::move(deliver)), thread_([this] { work(); }) {}

FoxgloveEncoder::~FoxgloveEncoder() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    wake_.notify_all();
  }
  thread_.join();
}

void FoxgloveEncoder::add(EncoderJob job) {
  constexpr std::ptrdiff_t kMostWaiting = 4;
  const std::lock_guard lock(mutex_);
  wake_.notify_all();
  if (job.again) {
    const auto same =
        std::ranges::find_if(jobs_, [&](const EncoderJob& one) { return one.again && one.ping == job.ping; });
    if (same != jobs_.end()) {
      same->channels.merge(job.channels);
      return;
    }
  }
  jobs_.push_back(std::move(job));
  const auto is_new = [](const EncoderJob& one) { return !one.again; };
  if (std::ranges::count_if(jobs_, is_new) > kMostWaiting) {
    jobs_.erase(std::ranges::find_if(jobs_, is_new));
  }
}

void FoxgloveEncoder::encode(const EncoderJob& job) {
  const std::shared_ptr<const LiveWorld>& world = job.ping->world;
  if (world != world_) {
    world_ = world;
    messages_.clear();
    for (const SonarConfig& sonar : world->sonars) {
      messages_.emplace_back(message_source(world->scenario, sonar), options_);
    }
    taken_.assign(messages_.size(), nullptr);
  }
  const auto sonar = static_cast<std::size_t>(job.ping->sonar);
  SonarMessages& messages = messages_[sonar];
  if (taken_[sonar] != job.ping) {
    Ping ping = job.ping->ping;
    ping.time += job.time_offset;
    messages.take(ping);
    taken_[sonar] = job.ping;
  }
  for (const std::size_t channel : job.channels) {
    const std::vector<std::byte> bytes = messages.encode(channel);
    deliver_({.world = world,
              .sonar = job.ping->sonar,
              .channel = channel,
              .again = job.again,
              .time_ns = messages.time_ns(),
              .bytes = std::make_shared<const std::string>(reinterpret_cast<const char*>(bytes.data()), bytes.size())});
  }
}

void FoxgloveEncoder::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return ending_ || !jobs_.empty(); });
    if (ending_) {
      return;
    }
    const EncoderJob job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    try {
      encode(job);
    } catch (const Error& error) {
      complain(error.what());
    }
    lock.lock();
  }
}

}  // namespace insonify
