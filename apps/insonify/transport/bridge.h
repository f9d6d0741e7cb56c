// bridge.h -- makes a scenario's pings live and passes them to another framework as messages.

#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "insonify/live_loop.h"
#include "insonify/messages.h"
#include "transport/bridge_options.h"
#include "transport/transport_report.h"

namespace insonify {

/// The other framework, as a target of messages. All functions are called from one thread.
class Transport {
 public:
  virtual ~Transport() = default;
  /// Called before the sonars of a scenario are opened, and again after each change of it.
  virtual void begin(const LiveWorld& /*world*/) {}
  /// Called before the first message of a sonar, and again after each change of the scenario.
  virtual void open(std::size_t sonar, const std::vector<MessageChannel>& channels) = 0;
  /// Whether a channel has readers: others are not encoded. Latched messages are always sent.
  [[nodiscard]] virtual bool is_read(std::size_t sonar, std::size_t channel) const = 0;
  /// Exceptions are reported; the next ping tries again.
  virtual void send(std::size_t sonar, std::size_t channel, std::uint64_t time_ns,
                    const std::vector<std::byte>& message) = 0;
};

/// Encodes and sends in a thread of its own, beside the LiveLoop's and the caller's. A ping is sent when its last echo
/// could be back, by the clock of the pings, or at once with BridgeOptions::at_once. If sending takes longer than the
/// interval between pings, the oldest pings are dropped and counted when more than kMostWaiting are due; with
/// BridgeOptions::lossless the next ping waits.
class Bridge : private LiveListener {
 public:
  static constexpr std::size_t kMostWaiting = 4;

  /// @throws InputError for an invalid scenario.
  Bridge(const BridgeOptions& options, Transport& transport, MessageForm form);
  ~Bridge() override;
  Bridge(const Bridge&) = delete;
  Bridge& operator=(const Bridge&) = delete;

  /// Opens the channels, sends what is latched and starts to make pings.
  void start();
  /// Ends within the time of a few beams. Queued pings are discarded.
  void end();

  /// Sets what is called when the loop waits for a pose or a time from another program, in the loop's thread. Before
  /// start().
  void when_idle(std::function<void()> call) { when_idle_ = std::move(call); }

  /// Applies a gain to a sonar's images [dB], from the next ping on: their lowest and highest value stand for levels
  /// lower by it. No effect on linear values (SonarMessages::levels()).
  void set_gain(std::size_t sonar, double gain_db);

  /// Takes poses, time and settings.
  [[nodiscard]] LiveLoop& loop() { return *loop_; }
  [[nodiscard]] const TransportReport& report() const { return report_; }

 private:
  void on_ping(const std::shared_ptr<const LivePing>& ping) override;
  void on_world(const std::shared_ptr<const LiveWorld>& world) override;
  void on_note(const std::string& text) override;
  void on_clock(double time) override;
  void on_idle() override;
  [[nodiscard]] double now() const;
  [[nodiscard]] std::size_t due() const;
  void release_all();
  void wait_for_work(std::unique_lock<std::mutex>& lock);
  void translate();
  void open(const LiveWorld& world);
  void send_latched(std::uint64_t time_ns);
  void send(const LivePing& ping);
  void complain_once(const std::string& problem);
  [[nodiscard]] MessageOptions options_of(const MessageSource& source, std::size_t sonar) const;

  BridgeOptions options_;
  Transport& transport_;
  MessageForm form_;
  std::unique_ptr<LiveLoop> loop_;
  TransportReport report_;
  std::function<void()> when_idle_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::multimap<double, std::shared_ptr<const LivePing>> waiting_;  // By when they are due, see now().
  double clock_ = 0;                                                // Last time passed to LiveLoop::advance() [s].
  std::shared_ptr<const LiveWorld> opened_;                         // To be opened, before its first ping arrives.
  std::map<std::size_t, double> gains_db_;                          // By sonar.
  bool gains_changed_ = false;
  std::uint64_t dropped_ = 0;
  bool ending_ = false;
  std::thread translating_;

  // Used by the sending thread only.
  std::shared_ptr<const LiveWorld> world_;  // World of `messages_`.
  std::vector<SonarMessages> messages_;
  std::map<std::size_t, double> applied_gains_db_;
  std::map<int, double> received_at_;  // LivePing::received_at of each sonar's last ping.
  bool sent_latched_ = false;
  std::string last_problem_;
};

/// Passes settings, such as max_range=20, from another program to a loop.
/// @param text    One setting per line; empty lines are ignored.
/// @param answer  Called once, in one of the loop's threads or in this one, with "done: " and the text, or "refused: "
///                and the reason, which is also printed.
void request_settings(LiveLoop& loop, const std::string& text, std::function<void(const std::string&)> answer);

}  // namespace insonify
