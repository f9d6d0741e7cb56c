// bridge_kit.h -- a bridge whose transport records what is sent.

#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "support/working_folder.h"
#include "transport/bridge.h"

namespace insonify::bridge_test {

using Clock = std::chrono::steady_clock;

inline constexpr const char* kScenario = R"(world: none
points: [{position: [3, 0.2, 0], target_strength_db: -10}]
sonars:
  - {name: fls, beam_count: 12, bin_count: 30, max_range: 6, ping_period: 0.01, sampling: {columns_per_beam: 1, rows: 4}}
)";

struct Sent {
  std::size_t sonar, channel;
  std::uint64_t time_ns;
  std::vector<std::byte> message;
};

// Records sent messages, and fails or waits as configured.
class RecordingTransport : public Transport {
 public:
  void begin(const LiveWorld& world) override {
    const std::lock_guard lock(mutex_);
    begun_with_ = world.sonars.size();
  }
  void open(std::size_t /*sonar*/, const std::vector<MessageChannel>& channels) override {
    if (on_open) {
      on_open();
    }
    const std::lock_guard lock(mutex_);
    EXPECT_GT(begun_with_, 0U);  // Before.
    channels_ = channels;
    ++opened_;
  }
  [[nodiscard]] bool is_read(std::size_t /*sonar*/, std::size_t channel) const override {
    const std::lock_guard lock(mutex_);
    return channels_[channel].kind == read;
  }
  void send(std::size_t sonar, std::size_t channel, std::uint64_t time_ns,
            const std::vector<std::byte>& message) override {
    std::this_thread::sleep_for(takes);
    const std::lock_guard lock(mutex_);
    if (channels_[channel].kind != MessageKind::kScenario && fails-- > 0) {
      throw std::runtime_error("the transport is closed");
    }
    sent_.push_back({sonar, channel, time_ns, message});
    changed_.notify_all();
  }

  // What was sent of a kind, once so many are there.
  std::vector<Sent> wait_for(MessageKind kind, std::size_t count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, std::chrono::seconds(120), [&] { return of(kind).size() >= count; }));
    return of(kind);
  }
  [[nodiscard]] std::vector<Sent> all() const {
    const std::lock_guard lock(mutex_);
    return sent_;
  }
  [[nodiscard]] int opened() const {
    const std::lock_guard lock(mutex_);
    return opened_;
  }

  std::optional<MessageKind> read = MessageKind::kSonarImage;
  std::chrono::milliseconds takes{0};
  int fails = 0;
  std::function<void()> on_open;

 private:
  [[nodiscard]] std::vector<Sent> of(MessageKind kind) const {
    std::vector<Sent> found;
    for (const Sent& each : sent_) {
      if (channels_[each.channel].kind == kind) {
        found.push_back(each);
      }
    }
    return found;
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<MessageChannel> channels_;
  std::vector<Sent> sent_;
  int opened_ = 0;
  std::size_t begun_with_ = 0;
};

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class BridgeTest : public testing::Test {
 protected:
  BridgeTest() { folder_.write("dive.yaml", kScenario); }

  std::unique_ptr<Bridge> bridge(const LiveOptions& live = {}, bool at_once = false) {
    return std::make_unique<Bridge>(
        BridgeOptions{.scenario = "dive.yaml", .live = live, .at_once = at_once, .quiet = true}, transport_,
        MessageForm::kRos1);
  }

  // Waits until so many pings are made.
  static void wait_for_pings(Bridge& bridge, std::uint64_t count) {
    const Clock::time_point start = Clock::now();
    while (bridge.loop().state().pings_made < count && seconds_since(start) < 120) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_GE(bridge.loop().state().pings_made, count);
  }

  WorkingFolder folder_;
  RecordingTransport transport_;
};

// Number of the ping, the first field of a message's header in ROS 1.
inline std::uint32_t sequence(const Sent& sent) {
  std::uint32_t number = 0;
  std::memcpy(&number, sent.message.data(), sizeof number);
  return number;
}

}  // namespace insonify::bridge_test
