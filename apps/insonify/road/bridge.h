// bridge.h -- makes a scenario's pings live, and hands them to another framework as messages.

#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "insonify/live_loop.h"
#include "insonify/messages.h"
#include "road/bridge_options.h"
#include "road/road_report.h"

namespace insonify {

/// The other framework's side. All functions are called from one thread.
class Road {
 public:
  virtual ~Road() = default;
  /// Before the sonars of a scenario are opened, and again after a change of it.
  virtual void begin(const LiveWorld& /*world*/) {}
  /// Before the first message of a sonar, and again after a change of the scenario.
  virtual void open(std::size_t sonar, const std::vector<MessageChannel>& channels) = 0;
  /// Whether anybody reads a channel: what nobody reads is not encoded. The scenario is sent in any case.
  [[nodiscard]] virtual bool is_read(std::size_t sonar, std::size_t channel) const = 0;
  /// What it throws is reported, and the next ping tries again.
  virtual void send(std::size_t sonar, std::size_t channel, std::uint64_t time_ns,
                    const std::vector<std::byte>& message) = 0;
};

/// Two threads beside those of the LiveLoop's: its own, that encodes and sends, and the caller's. Where sending takes
/// longer than the time between pings, the oldest of more than kMostWaiting pings that wait are dropped and counted.
class Bridge : private LiveListener {
 public:
  static constexpr std::size_t kMostWaiting = 4;

  /// @throws InputError for a scenario that is wrong.
  Bridge(const BridgeOptions& options, Road& road, MessageForm form);
  ~Bridge() override;
  Bridge(const Bridge&) = delete;
  Bridge& operator=(const Bridge&) = delete;

  /// Opens the channels, sends the scenario and begins to make pings.
  void start();
  /// Ends within some beams' time. Pings that wait to be sent are not.
  void end();

  /// Raises the levels of a sonar's images by a gain [dB]: what they show at their lowest and highest value is lower by
  /// it, from the next ping on. Without effect where the values are linear (SonarMessages::levels()).
  void set_gain(std::size_t sonar, double gain_db);

  /// For poses, time and settings.
  [[nodiscard]] LiveLoop& loop() { return *loop_; }
  [[nodiscard]] const RoadReport& report() const { return report_; }

 private:
  void on_ping(const std::shared_ptr<const LivePing>& ping) override;
  void on_world(const std::shared_ptr<const LiveWorld>& world) override;
  void on_note(const std::string& text) override;
  void translate();
  void open(const LiveWorld& world);
  void tell_scenario(std::uint64_t time_ns);
  void send(const LivePing& ping);
  void complain_once(const std::string& problem);
  [[nodiscard]] MessageOptions options_of(const MessageSource& source, std::size_t sonar) const;

  BridgeOptions options_;
  Road& road_;
  MessageForm form_;
  std::unique_ptr<LiveLoop> loop_;
  RoadReport report_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<const LivePing>> waiting_;
  std::shared_ptr<const LiveWorld> opened_;  // Waits to be opened, before its first ping has come.
  std::map<std::size_t, double> gains_db_;   // By sonar.
  bool gains_changed_ = false;
  std::uint64_t dropped_ = 0;
  bool ending_ = false;
  std::thread translating_;

  // Used by the thread that sends alone.
  std::shared_ptr<const LiveWorld> world_;  // That `messages_` are of.
  std::vector<SonarMessages> messages_;
  std::map<std::size_t, double> applied_gains_db_;
  std::map<int, double> told_at_;  // LivePing::told_at of each sonar's last ping.
  bool told_scenario_ = false;
  std::string last_problem_;
};

}  // namespace insonify
