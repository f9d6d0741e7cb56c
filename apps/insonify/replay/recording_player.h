// recording_player.h -- plays a recording in real time, faster, slower or step by step.

#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "replay/recorded_run.h"
#include "serve/ping_source.h"

namespace insonify {

/// Pauses at the end; resuming from there restarts.
class RecordingPlayer : public PingSource, public Playback {
 public:
  /// @param name     For the viewer.
  /// @param markers  Of the recording.
  /// @param paused   Whether it starts paused.
  RecordingPlayer(RecordedRun& run, std::string name, std::vector<Marker> markers, bool paused);
  ~RecordingPlayer() override { RecordingPlayer::end(); }
  RecordingPlayer(const RecordingPlayer&) = delete;
  RecordingPlayer& operator=(const RecordingPlayer&) = delete;

  void start(LiveListener& listener) override;
  void end() override;
  [[nodiscard]] LiveState state() const override;
  void pause(bool on) override;
  void step(int sonar) override;
  void set_speed(double factor) override;
  [[nodiscard]] Playback* playback() override { return this; }
  [[nodiscard]] std::vector<Marker> marked() const override { return markers_; }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::uint64_t ping_count() const override { return moments_.size(); }
  [[nodiscard]] double first_time() const override { return moments_.front().time; }
  [[nodiscard]] double last_time() const override { return moments_.back().time; }
  void seek(double time) override;
  void step_back(int sonar) override;

 private:
  using Clock = std::chrono::steady_clock;
  using Lock = std::unique_lock<std::mutex>;

  void play();
  void go_to(double time, Lock& lock);
  void show(const RecordedMoment& moment, Lock& lock);
  void keep_pace();
  [[nodiscard]] double shown_time() const;
  [[nodiscard]] std::optional<double> time_after(double time, int sonar) const;
  [[nodiscard]] std::optional<double> time_before(double time, int sonar) const;
  [[nodiscard]] Clock::time_point next_due() const;

  RecordedRun& run_;
  std::span<const RecordedMoment> moments_;
  std::string name_;
  std::vector<Marker> markers_;
  LiveListener* listener_ = nullptr;

  mutable std::mutex mutex_;  // Guards the members below.
  std::condition_variable wake_;
  bool ending_ = false;
  bool paused_;
  std::optional<double> until_;  // Time up to which pings are shown while paused [s].
  std::optional<double> goal_;   // Time to seek to [s].
  double speed_ = 1;
  std::size_t next_ = 0;  // Index of the next moment.
  std::uint64_t shown_ = 0;
  // Pace: a time of the recording [s] and the corresponding time of the clock.
  double anchor_time_;
  Clock::time_point anchor_ = Clock::now();

  std::thread playing_;
};

}  // namespace insonify
