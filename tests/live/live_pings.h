// live_pings.h -- a listener that keeps what a live loop makes, and waits for it.

#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>

#include "insonify/live_loop.h"

namespace insonify {

/// Keeps pings, worlds and notes.
class LiveKeeper : public LiveListener {
 public:
  void on_ping(const std::shared_ptr<const LivePing>& ping) override {
    const std::lock_guard lock(mutex_);
    pings_.push_back(*ping);
    changed_.notify_all();
  }
  void on_world(const std::shared_ptr<const LiveWorld>& world) override {
    const std::lock_guard lock(mutex_);
    worlds_.push_back(world);
    changed_.notify_all();
  }
  void on_note(const std::string& text) override {
    const std::lock_guard lock(mutex_);
    notes_.push_back(text);
    changed_.notify_all();
  }
  void on_recorded(const LiveRecording& recording) override {
    const std::lock_guard lock(mutex_);
    recordings_.push_back(recording);
  }

  [[nodiscard]] std::vector<LivePing> pings() const {
    const std::lock_guard lock(mutex_);
    return pings_;
  }
  [[nodiscard]] std::vector<std::string> notes() const {
    const std::lock_guard lock(mutex_);
    return notes_;
  }
  /// Those that have ended.
  [[nodiscard]] std::vector<LiveRecording> recordings() const {
    const std::lock_guard lock(mutex_);
    return recordings_;
  }
  [[nodiscard]] std::size_t world_count() const {
    const std::lock_guard lock(mutex_);
    return worlds_.size();
  }

  /// Waits until so many more pings have come; fails after two minutes.
  void wait_for_pings(std::size_t more) { wait_for_all(pings().size() + more); }
  /// Waits until so many have come from the start on.
  void wait_for_all(std::size_t wanted) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kLong, [&] { return pings_.size() >= wanted; })) << "no pings came";
  }
  /// Waits for the pings of all sonars after a change.
  void wait_for_change(std::uint64_t change, std::size_t sonars) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kLong, [&] {
      return pings_.size() >= sonars && pings_[pings_.size() - sonars].world->change == change;
    })) << "no pings came";
  }
  /// The last ping of a sonar.
  [[nodiscard]] LivePing last(int sonar) const {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(pings_.rbegin(), pings_.rend(), [&](const auto& ping) { return ping.sonar == sonar; });
    return found == pings_.rend() ? LivePing{} : *found;
  }
  void wait_for_notes(std::size_t count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kLong, [&] { return notes_.size() >= count; })) << "no note came";
  }

 private:
  static constexpr std::chrono::seconds kLong{120};
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<LivePing> pings_;
  std::vector<std::shared_ptr<const LiveWorld>> worlds_;
  std::vector<std::string> notes_;
  std::vector<LiveRecording> recordings_;
};

/// Calls a request of a loop with a Done, and waits for the answer.
template <typename Request>
std::string answer_to(Request&& request) {
  const auto promise = std::make_shared<std::promise<std::string>>();
  std::future<std::string> answer = promise->get_future();
  request([promise](const std::string& error) { promise->set_value(error); });
  if (answer.wait_for(std::chrono::seconds(120)) != std::future_status::ready) {
    return "no answer";
  }
  return answer.get();
}

}  // namespace insonify
