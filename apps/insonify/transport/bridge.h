// bridge.h -- sends a scenario's live pings by another program's transport, and counts them.

#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "insonify/live_sender.h"
#include "transport/bridge_options.h"
#include "transport/transport_report.h"

namespace insonify {

/// A LiveSender whose notes go to the standard error stream, with a report.
class Bridge {
 public:
  /// @throws InputError for an invalid scenario.
  Bridge(const BridgeOptions& options, Transport& transport, MessageForm form);

  void start();
  void end() { sender_->end(); }

  /// Sets what is called when the loop waits for a pose or a time from another program, in the loop's thread. Before
  /// start().
  void when_idle(std::function<void()> call) { when_idle_ = std::move(call); }

  /// As LiveSender::set_gain().
  void set_gain(std::size_t sonar, double gain_db) { sender_->set_gain(sonar, gain_db); }

  /// As LiveSender::ask().
  void ask(LiveDrive drive, std::size_t sonar, LiveSender::Answer answer) {
    sender_->ask(std::move(drive), sonar, std::move(answer));
  }

  /// Takes poses, time and settings.
  [[nodiscard]] LiveLoop& loop() { return sender_->loop(); }
  [[nodiscard]] const TransportReport& report() const { return report_; }

 private:
  bool quiet_;
  TransportReport report_;
  std::function<void()> when_idle_ = [] {};
  std::unique_ptr<LiveSender> sender_;
};

/// Passes settings, such as max_range=20, from another program to a loop.
/// @param text    One setting per line; empty lines are ignored.
/// @param answer  Called once, in one of the loop's threads or in this one, with "done: " and the text, or "refused: "
///                and the reason, which is also printed.
void request_settings(LiveLoop& loop, const std::string& text, std::function<void(const std::string&)> answer);

}  // namespace insonify
