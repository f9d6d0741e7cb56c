// live_recordings.cpp -- ends recordings of a live loop: on request, or when they cannot continue.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "live/live_state.h"

namespace insonify {

void LiveLoop::State::end_recording(Lock& lock) {
  if (!recorder) {
    return;
  }
  const std::unique_ptr<LiveRecorder> ended = std::exchange(recorder, nullptr);
  recording_names.clear();
  const LiveRun run_of_it = *run;
  lock.unlock();
  std::string error;
  try {
    ended->close(run_of_it, listener->marked());
  } catch (const std::exception& failure) {
    error = failure.what();
    note("the recording: " + error);
  }
  listener->on_recorded(ended->recording());
  lock.lock();
  closing_error = error;
  recording_error = error.empty() ? recording_error : "the recording: " + error;
}

// Ends a recording that cannot continue, keeping its pings.
void LiveLoop::State::fail_recording(const std::string& error, Lock& lock) {
  recording_error = "the recording ended early: " + error;
  const std::unique_ptr<LiveRecorder> ended = std::exchange(recorder, nullptr);
  recording_names.clear();
  const LiveRun run_of_it = *run;
  lock.unlock();
  note("the recording ends here: " + error);
  try {
    if (ended) {
      ended->close(run_of_it, listener->marked());
    }
  } catch (const std::exception& failure) {
    if (failure.what() != error) {
      note(fmt::format("the recording: {}", failure.what()));
    }
  }
  if (ended) {
    listener->on_recorded(ended->recording());
  }
  lock.lock();
}

bool LiveLoop::State::stops_recording() const {
  return !stop_recording.empty() && stop_recording.front().recording <= recordings_answered;
}

void LiveLoop::State::answer_stop_recording(Lock& lock) {
  const auto later =
      std::ranges::find_if(stop_recording, [this](const Stop& stop) { return stop.recording > recordings_answered; });
  const std::vector<Stop> stops(stop_recording.begin(), later);
  stop_recording.erase(stop_recording.begin(), later);
  const bool is_recording = recorder != nullptr;
  closing_error.clear();
  end_recording(lock);
  const std::string error = is_recording ? closing_error : "nothing is being recorded";
  lock.unlock();
  for (const Stop& stop : stops) {
    if (stop.done) {
      stop.done(error);
    }
  }
  lock.lock();
}

// Continues a recording in another file after a change.
void LiveLoop::State::begin_next_recording(Lock& lock) {
  try {
    recorder = std::make_unique<LiveRecorder>(recording_path, ++recording_part, *world, recording_replaces,
                                              options.messages, log());
  } catch (const std::exception& failure) {
    fail_recording(failure.what(), lock);
  }
}

// After the pings of some sonars.
void LiveLoop::State::count_made(std::span<const int> sonars, Lock& lock) {
  for (const int sonar : sonars) {
    run->made(sonar);
  }
  pings_made += sonars.size();
  recorded_pings = recorder ? recorder->pings() : recorded_pings;
  steps = std::max(0, steps - 1);
  if (recorder && recorder->scenario_is_due()) {
    const LiveRun run_now = *run;
    lock.unlock();
    recorder->write_scenario(run_now);
    lock.lock();
  }
}

}  // namespace insonify
