// recording_player.cpp -- the thread that reads pings when they are due.

#include "replay/recording_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

#include "insonify/error.h"

namespace insonify {

RecordingPlayer::RecordingPlayer(RecordedRun& run, std::string name, std::vector<Marker> markers, bool paused)
    : run_(run),
      moments_(run.moments()),
      name_(std::move(name)),
      markers_(std::move(markers)),
      paused_(paused),
      goal_(moments_.front().time),
      anchor_time_(moments_.front().time) {}

void RecordingPlayer::start(LiveListener& listener) {
  listener_ = &listener;
  playing_ = std::thread([this] { play(); });
}

void RecordingPlayer::end() {
  {
    const Lock lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  if (playing_.joinable()) {
    playing_.join();
  }
}

LiveState RecordingPlayer::state() const {
  const Lock lock(mutex_);
  LiveState state;
  state.paused = paused_;
  state.speed = speed_;
  state.pings_made = shown_;
  state.pings_since_change = next_;
  state.time = shown_time();
  return state;
}

void RecordingPlayer::pause(bool on) {
  const Lock lock(mutex_);
  if (!on && paused_ && next_ == moments_.size()) {
    goal_ = first_time();
  }
  paused_ = on;
  until_.reset();
  keep_pace();
  wake_.notify_all();
}

void RecordingPlayer::step(int sonar) {
  const Lock lock(mutex_);
  if (paused_) {
    until_ = time_after(goal_.value_or(until_.value_or(shown_time())), sonar);
    wake_.notify_all();
  }
}

void RecordingPlayer::set_speed(double factor) {
  if (!(factor >= 0.01 && factor <= 100)) {
    throw Error(fmt::format("speed = {} must be from 0.01 to 100", factor));
  }
  const Lock lock(mutex_);
  keep_pace();
  speed_ = factor;
  wake_.notify_all();
}

void RecordingPlayer::seek(double time) {
  if (!std::isfinite(time)) {
    throw Error(fmt::format("time = {} s must be a number", time));
  }
  const Lock lock(mutex_);
  goal_ = time;
  until_.reset();
  wake_.notify_all();
}

void RecordingPlayer::step_back(int sonar) {
  const Lock lock(mutex_);
  goal_ = time_before(goal_.value_or(shown_time()), sonar).value_or(first_time());
  paused_ = true;
  until_.reset();
  wake_.notify_all();
}

// Time of the next ping of a sonar, or of any sonar if it has none [s]; absent at the end.
std::optional<double> RecordingPlayer::time_after(double time, int sonar) const {
  const auto next = std::ranges::upper_bound(moments_, time, {}, &RecordedMoment::time);
  const auto of_sonar = std::ranges::find(next, moments_.end(), sonar, &RecordedMoment::sonar);
  const auto found = of_sonar == moments_.end() ? next : of_sonar;
  return found == moments_.end() ? std::nullopt : std::optional(found->time);
}

// Time of the previous ping, in the same way [s]; absent at the first.
std::optional<double> RecordingPlayer::time_before(double time, int sonar) const {
  const auto end = std::ranges::lower_bound(moments_, time, {}, &RecordedMoment::time);
  const auto before = std::ranges::reverse_view(moments_.first(static_cast<std::size_t>(end - moments_.begin())));
  const auto of_sonar = std::ranges::find(before, sonar, &RecordedMoment::sonar);
  const auto found = of_sonar == before.end() ? before.begin() : of_sonar;
  return found == before.end() ? std::nullopt : std::optional(found->time);
}

// Time of the shown ping [s].
double RecordingPlayer::shown_time() const {
  return next_ == 0 ? first_time() : moments_[next_ - 1].time;
}

// Restarts the pace at the current time.
void RecordingPlayer::keep_pace() {
  anchor_time_ = shown_time();
  anchor_ = Clock::now();
}

RecordingPlayer::Clock::time_point RecordingPlayer::next_due() const {
  const std::chrono::duration<double> wait((moments_[next_].time - anchor_time_) / speed_);
  return anchor_ + std::chrono::duration_cast<Clock::duration>(wait);
}

void RecordingPlayer::show(const RecordedMoment& moment, Lock& lock) {
  lock.unlock();
  try {
    listener_->on_ping(run_.ping(moment));
    lock.lock();
    ++shown_;
  } catch (const Error& error) {
    listener_->on_note(error.what());
    lock.lock();
    paused_ = true;
    until_.reset();
  }
}

// Shows the last ping of each sonar until then, or its first.
void RecordingPlayer::go_to(double time, Lock& lock) {
  const auto after = std::ranges::upper_bound(moments_, std::max(time, first_time()), {}, &RecordedMoment::time);
  next_ = static_cast<std::size_t>(after - moments_.begin());
  const std::size_t sonars = run_.world()->sonars.size();
  std::vector<const RecordedMoment*> last(sonars, nullptr);
  for (std::size_t i = next_, left = sonars; i > 0 && left > 0; --i) {
    const RecordedMoment*& of_sonar = last[static_cast<std::size_t>(moments_[i - 1].sonar)];
    left -= of_sonar == nullptr ? 1 : 0;
    of_sonar = of_sonar == nullptr ? &moments_[i - 1] : of_sonar;
  }
  for (std::size_t sonar = 0; sonar < sonars; ++sonar) {
    if (last[sonar] == nullptr) {
      last[sonar] = &*std::ranges::find(moments_, static_cast<int>(sonar), &RecordedMoment::sonar);
    }
    show(*last[sonar], lock);
  }
  keep_pace();
}

void RecordingPlayer::play() {
  listener_->on_world(run_.world());
  Lock lock(mutex_);
  while (!ending_) {
    if (goal_) {
      go_to(*std::exchange(goal_, {}), lock);
    } else if (next_ == moments_.size()) {
      paused_ = true;
      until_.reset();
      wake_.wait(lock);
    } else if (paused_ && !(until_ && moments_[next_].time <= *until_)) {
      until_.reset();
      wake_.wait(lock);
    } else if (!paused_ && Clock::now() < next_due()) {
      wake_.wait_until(lock, next_due());
    } else {
      // A step shows all sonars that ping at that time.
      const double time = moments_[next_].time;
      do {
        const RecordedMoment& moment = moments_[next_++];
        show(moment, lock);
      } while (!goal_ && !ending_ && next_ < moments_.size() && moments_[next_].time == time);
    }
  }
}

}  // namespace insonify
