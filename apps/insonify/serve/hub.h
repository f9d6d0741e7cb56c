// hub.h -- shared by all clients: the source of pings, the last pings, and messages encoded once.

#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>

#include "insonify/live_loop.h"
#include "serve/markers.h"
#include "serve/net/net_server.h"
#include "serve/ping_source.h"
#include "serve/viewer_frames.h"
#include "serve/viewer_texts.h"

namespace insonify {

/// A ping to be sent; caches its encoded messages for all clients.
class SharedPing {
 public:
  explicit SharedPing(std::shared_ptr<const LivePing> ping) : ping_(std::move(ping)) {}
  [[nodiscard]] const LivePing& ping() const { return *ping_; }
  [[nodiscard]] const std::shared_ptr<const LivePing>& shared() const { return ping_; }
  /// ping_frame(), made once for each set of tables.
  [[nodiscard]] const Bytes& frame(unsigned tables);

 private:
  std::shared_ptr<const LivePing> ping_;
  std::map<unsigned, Bytes> frames_;
};

/// Receives a hub's events for one client. Called in the server's thread.
class HubMember {
 public:
  virtual ~HubMember() = default;
  virtual void on_ping(SharedPing& ping) = 0;
  virtual void on_world() = 0;
  virtual void on_state() = 0;
  virtual void on_note(const std::string& text) = 0;
  /// @param text  levels_text() of a sonar whose display levels have changed.
  virtual void on_levels(const Bytes& /*text*/) {}
  /// @param text  Markers::text(), which has changed.
  virtual void on_markers(const Bytes& /*text*/) {}
  /// Velocity that this client steers with.
  [[nodiscard]] virtual bool flies() const { return false; }
};

/// Passes pings from the source's thread to the server's, through a queue of the last few per sonar.
class Hub : public LiveListener {
 public:
  /// @param recording  File name from which names of recordings are derived.
  /// @param quiet      Do not print finished recordings on the terminal.
  Hub(PingSource& source, NetServer& server, std::filesystem::path recording, bool quiet)
      : source_(source), server_(server), recording_(std::move(recording)), quiet_(quiet), markers_(source.marked()) {}

  // For the source's threads. These print on the terminal at once, since the server's thread may have ended.
  void on_ping(const std::shared_ptr<const LivePing>& ping) override;
  void on_world(const std::shared_ptr<const LiveWorld>& world) override;
  void on_note(const std::string& text) override;
  void on_recorded(const LiveRecording& recording) override;
  [[nodiscard]] std::vector<Marker> marked() override { return markers_.all(); }

  // For the server's thread.
  void join(HubMember& member) { members_.insert(&member); }
  void client_came() { ++counts_.clients; }
  void client_left() { --counts_.clients; }
  void leave(HubMember& member);
  [[nodiscard]] PingSource& source() { return source_; }
  [[nodiscard]] bool ready() const { return hello_ != nullptr; }
  [[nodiscard]] const Bytes& hello() const { return hello_; }
  [[nodiscard]] const Bytes& scene() const { return scene_; }
  [[nodiscard]] const LiveWorld& world() const { return *world_; }
  [[nodiscard]] const std::shared_ptr<SharedPing>& last_ping(int sonar) const {
    return last_pings_.at(static_cast<std::size_t>(sonar));
  }
  [[nodiscard]] Markers& markers() { return markers_; }
  /// Sends them to all clients.
  void send_markers();
  [[nodiscard]] const ServerCounts& counts() const { return counts_; }
  /// Updates the rate and sends the state to all clients.
  void send_state();
  /// Schedules send_state() in the server's thread. From any thread.
  void send_state_soon();
  /// Posts a function to the server's thread, if that still runs. From any thread.
  void post(std::function<void()> function) { server_.post(std::move(function)); }

  /// An unused file name for a recording.
  [[nodiscard]] std::filesystem::path recording_path(const std::string& ending);
  [[nodiscard]] std::uint64_t pings() const { return pings_; }

 private:
  void send_note(const std::string& text);
  void take_pings();
  void send_position();
  void greet();
  void send_levels(std::size_t sonar);
  [[nodiscard]] bool make_hello();

  PingSource& source_;
  NetServer& server_;
  std::filesystem::path recording_;
  bool quiet_;

  std::mutex mutex_;  // Guards the members below, up to the blank line.
  std::deque<std::shared_ptr<const LivePing>> waiting_;
  bool asked_ = false;

  std::atomic<bool> telling_ = false;
  Markers markers_;

  std::set<HubMember*> members_;
  std::shared_ptr<const LiveWorld> world_;
  std::vector<std::shared_ptr<SharedPing>> last_pings_;
  std::vector<ShownScale> scales_;
  Bytes hello_, scene_;
  std::uint64_t pings_ = 0, counted_pings_ = 0;
  double computing_time_ = 0;
  std::chrono::steady_clock::time_point counted_at_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point sent_position_at_;
  ServerCounts counts_;
};

inline constexpr std::string_view kViewerProtocol = "insonify.viewer.v1";  ///< docs/design/viewer.md

/// The connection to one page.
/// @param hub  Must outlive the client.
[[nodiscard]] std::unique_ptr<Client> make_viewer_client(Connection& connection, Hub& hub);

}  // namespace insonify
