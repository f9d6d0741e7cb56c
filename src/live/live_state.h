// live_state.h -- data shared by the threads of a LiveLoop.

#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "insonify/simulator.h"
#include "live/live_change.h"
#include "live/live_objects.h"
#include "live/live_recorder.h"
#include "live/ping_pool.h"
#include "live/solids_watch.h"

namespace insonify {

/// Answer to requests that are pending at the end.
inline constexpr const char* kEnds = "the simulation ends";

/// Two threads: one makes pings, the other prepares changes. `mutex` guards all members unless marked otherwise.
struct LiveLoop::State {
  using Clock = std::chrono::steady_clock;

  State(const std::filesystem::path& scenario, std::span<const std::string> settings, const LiveOptions& the_options,
        const Log& log);

  LiveOptions options;
  LiveListener* listener = nullptr;  // Set once, before the threads start.

  std::mutex mutex;
  std::condition_variable wake;     // Wakes the thread that makes pings.
  std::condition_variable changed;  // Wakes the thread that prepares changes.
  std::atomic<bool> ending = false;

  // Requests.
  bool paused = false;
  int steps = 0;  // Pending while paused.
  double speed = 1;
  LiveVelocity velocity;
  std::optional<LiveDrive> drive;  // The newest.
  double drive_received_at = 0;    // Unix time [s].
  bool drive_refused = false;      // Whether no ping can be made from its pose.
  bool told_idle = false;          // Whether the listener knows that what has come since was not enough for a ping.
  std::deque<std::pair<LiveDrive, double>> asked;  // With LiveOptions::on_request, and when they came.
  std::optional<double> clock;                     // With LiveOptions::clocked: the newest time [s].
  LiveObjectList objects;                          // Added by change_objects() and not removed.
  std::uint64_t next_object = 0;                   // Serial number.
  bool objects_changed = false;                    // Whether the simulator does not have them yet.
  std::vector<LiveChange> wishes;                  // To prepare.
  std::optional<std::vector<LiveChange>> being_prepared;
  std::optional<LivePrepared> prepared;  // To apply between two pings.
  bool preparing_now = false;
  bool taking_helm = false;  // Whether a request to steer is pending.
  struct Stop {
    std::uint64_t recording;  // The last that record() was asked for before: it has to begin, or fail, first.
    Done done;
  };
  std::vector<Stop> stop_recording;  // To answer when the recording has ended.
  std::uint64_t recordings_asked = 0, recordings_answered = 0;

  // The simulation.
  LiveSettings settings;
  Scenario scenario;  // With its own trajectory.
  std::optional<LiveRun> run;
  std::shared_ptr<const LiveWorld> world;
  bool driving = false;  // Whether the run starts at a pose from drive().
  std::uint64_t pings_made = 0;
  std::string recording_names;
  std::uint64_t recorded_pings = 0;
  std::string recording_error;  // Why a recording is incomplete, kept until the end.

  // Pace: a time of the run and the corresponding time of the clock.
  double anchor_time = 0;
  Clock::time_point anchor = Clock::now();
  double clock_anchor = 0;                    // The same by the clock of LiveOptions::clocked [s].
  std::vector<Clock::time_point> last_pings;  // Time of each sonar's last ping, for the rate limit.

  // Used only by the thread that makes pings.
  std::unique_ptr<Simulator> simulator;
  LiveObjectList simulated_objects;       // In it ...
  std::set<std::string> simulated_names;  // ... and their names.
  std::unique_ptr<LiveRecorder> recorder;
  std::filesystem::path recording_path;
  bool recording_replaces = false;
  int recording_part = 0;
  PingPool pool;
  SolidsWatch solids;
  std::string closing_error;

  LiveBuilder builder;  // Used only by the thread that prepares changes.
  std::thread pinging, preparing;

  using Lock = std::unique_lock<std::mutex>;

  // live_drive.cpp: poses and times from other programs.
  [[nodiscard]] bool waits_for_others() const;
  void wait_for_others(Lock& lock);
  [[nodiscard]] std::optional<double> awaited() const;
  [[nodiscard]] bool drive_to_next(Lock& lock);
  void answer_drive(const std::string& error, Lock& lock);
  void keep_clock();

  // live_objects.cpp: added and removed objects.
  void take_objects(Lock& lock);

  // live_pings.cpp: the thread that makes pings.
  struct Stamps {  // What pings that are made together carry.
    std::shared_ptr<const LiveWorld> world;
    double stamp, received_at, clock;  // LivePing's.
    std::uint64_t request;
  };
  struct Made {  // Errors, "": none.
    bool interrupted = false;
    std::string error, not_recorded;
  };
  void make_pings();
  void make_next(Lock& lock);
  [[nodiscard]] PingRequest next_request(int sonar) const;
  Made make_all(std::span<const int> sonars, std::span<const PingRequest> requests, const Stamps& stamps);
  void count_made(std::span<const int> sonars, Lock& lock);
  std::shared_ptr<LivePing> make_one(int sonar, const PingRequest& request, const Stamps& stamps);
  void take_place(Lock& lock);
  void apply(LivePrepared next, Lock& lock);
  void begin_run(const LiveStart& start, Lock& lock);
  void announce_world(Lock& lock);
  void begin_next_recording(Lock& lock);
  void end_recording(Lock& lock);
  void fail_recording(const std::string& error, Lock& lock);
  [[nodiscard]] bool stops_recording() const;
  void answer_stop_recording(Lock& lock);
  [[nodiscard]] Clock::time_point next_due() const;
  void keep_pace(Clock::time_point due, double time, std::span<const int> sonars);
  [[nodiscard]] double time_now() const;

  // live_prepare.cpp: the thread that prepares changes.
  void prepare_changes();
  void prepare_batch(std::vector<LiveChange> batch, Lock& lock);
  void prepare_each(std::vector<LiveChange> batch, Lock& lock);

  [[nodiscard]] LiveStanding standing() const { return {run->start(), run->next_time(), run->next_pose()}; }
  void request(LiveChange change);
  void note(const std::string& text) const { listener->on_note(text); }
  [[nodiscard]] Log log() const;
};

}  // namespace insonify
