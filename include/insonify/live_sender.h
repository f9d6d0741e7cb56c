// live_sender.h -- sends the pings of a live loop to another program as messages.

#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "insonify/live_loop.h"
#include "insonify/log.h"
#include "insonify/messages.h"

namespace insonify {

/// The other program, as a target of messages. All functions are called from one thread.
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

struct LiveSenderOptions {
  LiveOptions live = {};
  MessageOptions messages = {};
  MessageForm form = MessageForm::kRos2;
  bool at_once = false;   ///< Whether pings are sent as soon as they are computed, before their sound could be back.
  bool lossless = false;  ///< Whether no ping is dropped: the next is made when there is room for it.
  /// A line to show, such as why a message could not be sent.
  std::function<void(const std::string&)> on_note = [](const std::string&) {};
  std::function<void()> on_idle = [] {};     ///< As LiveListener::on_idle().
  std::function<void()> on_dropped = [] {};  ///< A ping has been dropped.
  /// A ping has been sent: when its sound was, and its computing time [s].
  std::function<void(std::chrono::steady_clock::time_point transmitted, double computing)> on_sent =
      [](std::chrono::steady_clock::time_point, double) {};
};

/// Encodes and sends in a thread of its own, beside the LiveLoop's and the caller's. A ping is sent when its last echo
/// could be back, by the clock of the pings, or at once with LiveSenderOptions::at_once. If sending takes longer than
/// the interval between pings, the oldest pings are dropped when more than kMostWaiting are due; with
/// LiveSenderOptions::lossless the next ping waits. No ping is made while channels are opened, which takes seconds
/// where the other program is busy.
class LiveSender : private LiveListener {
 public:
  static constexpr std::size_t kMostWaiting = 4;

  /// @throws Error for an invalid scenario or invalid options.
  LiveSender(const std::filesystem::path& scenario, const std::vector<std::string>& settings, LiveSenderOptions options,
             Transport& transport, const Log& log);
  ~LiveSender() override;
  LiveSender(const LiveSender&) = delete;
  LiveSender& operator=(const LiveSender&) = delete;

  /// Opens the channels, sends what is latched and starts to make pings.
  void start();
  /// Ends within the time of a few beams. Queued pings are discarded.
  void end();

  /// Applies a gain to a sonar's images [dB], from the next ping on: their lowest and highest value stand for levels
  /// lower by it. No effect on linear values (SonarMessages::levels()).
  void set_gain(std::size_t sonar, double gain_db);

  /// Called once, in any thread: with a sonar image, or with the reason why there is none.
  using Answer = std::function<void(std::vector<std::byte> image, const std::string& error)>;

  /// With LiveOptions::on_request: makes a ping at a pose. Its messages are sent as those of any other.
  /// @param sonar  The answer's.
  void ask(LiveDrive drive, std::size_t sonar, Answer answer);

  /// Takes poses, time and settings.
  [[nodiscard]] LiveLoop& loop() { return *loop_; }

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
  [[nodiscard]] bool is_asked(const LivePing& ping);
  void answer(std::uint64_t request, std::vector<std::byte> image, const std::string& error);
  void answer_all();
  void note_once(const std::string& problem);
  [[nodiscard]] MessageOptions options_of(const MessageSource& source, std::size_t sonar) const;

  LiveSenderOptions options_;
  Transport& transport_;
  std::unique_ptr<LiveLoop> loop_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::multimap<double, std::shared_ptr<const LivePing>> waiting_;  // By when they are due, see now().
  double clock_ = 0;                                                // Last time passed to LiveLoop::advance() [s].
  std::shared_ptr<const LiveWorld> opened_;                         // To be opened, before its first ping arrives ...
  bool opening_ = false;                                            // ... and whether that is not done yet.
  std::map<std::size_t, double> gains_db_;                          // By sonar.
  bool gains_changed_ = false;
  std::uint64_t dropped_ = 0;
  struct Asked {
    int sonar;
    Answer answer;
    bool made = false;  // Whether its ping is to be sent, or was.
  };
  std::uint64_t last_request_ = 0;
  std::map<std::uint64_t, Asked> asked_;  // By LivePing::request.
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

}  // namespace insonify
