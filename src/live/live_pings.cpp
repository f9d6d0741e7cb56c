// live_pings.cpp -- the thread that makes pings: pace, changes between pings, recordings.

#include <fmt/format.h>

#include <algorithm>

#include "insonify/error.h"
#include "live/live_state.h"

namespace insonify {
namespace {

using Clock = std::chrono::steady_clock;

Clock::duration clock_time(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

std::vector<MovedInstance> moved_instances(Simulator& simulator, const PingRequest& request) {
  std::vector<MovedInstance> moved;
  if (request.moved.empty()) {
    return moved;
  }
  const Scene scene = simulator.scene_at(request);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (scene.instances[i].moving && !scene.instances[i].endless) {
      moved.push_back({static_cast<int>(i), scene.instances[i].world_from_mesh});
    }
  }
  return moved;
}

}  // namespace

// When the next pings are to be made.
Clock::time_point LiveLoop::State::next_due() const {
  Clock::time_point due = anchor + clock_time((run->next_time() - anchor_time) / speed);
  if (options.rate_limit) {
    for (const int sonar : run->next_sonars()) {
      due = std::max(due, last_pings[static_cast<std::size_t>(sonar)] + clock_time(1 / *options.rate_limit));
    }
  }
  return due;
}

// Pings that come late are not caught up with: time then passes more slowly.
void LiveLoop::State::keep_pace(Clock::time_point due, double time, std::span<const int> sonars) {
  constexpr std::chrono::milliseconds kLate{20};
  const Clock::time_point now = Clock::now();
  anchor = now - due < kLate ? due : now;
  anchor_time = time;
  for (const int sonar : sonars) {
    last_pings[static_cast<std::size_t>(sonar)] = anchor;
  }
}

// The time of the run that the clock says, at most that of the next pings.
double LiveLoop::State::time_now() const {
  const double since = std::chrono::duration<double>(Clock::now() - anchor).count();
  return paused ? anchor_time : std::min(run->next_time(), anchor_time + std::max(0.0, since) * speed);
}

void LiveLoop::State::begin_run(LiveStart start, Lock& lock) {
  auto next_world = std::make_shared<LiveWorld>();
  next_world->change = world ? world->change + 1 : 0;
  next_world->scenario = scenario_from(scenario, start);
  next_world->trajectory = scenario.trajectory;
  next_world->scene = simulator->scene();
  for (const SonarConfig& sonar : next_world->scenario.sonars) {
    next_world->sonars.push_back(next_world->scenario.filled_in(sonar));
  }
  run.emplace(next_world->scenario, start);
  world = next_world;
  anchor_time = 0;
  anchor = Clock::now();
  clock_anchor = clock.value_or(0);
  last_pings.assign(next_world->sonars.size(), Clock::time_point{});
  steps = 1;  // A change shows at once, paused or not.
  lock.unlock();
  listener->on_world(next_world);
  lock.lock();
}

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
    ended->close(run_of_it);
  } catch (const std::exception& failure) {
    error = failure.what();
    note("the recording: " + error);
  }
  listener->on_recorded(ended->recording());
  lock.lock();
  closing_error = error;
  recording_error = error.empty() ? recording_error : "the recording: " + error;
}

// Ends a recording that cannot go on, with what it holds.
void LiveLoop::State::fail_recording(const std::string& error, Lock& lock) {
  recording_error = "the recording ended early: " + error;
  const std::unique_ptr<LiveRecorder> ended = std::exchange(recorder, nullptr);
  recording_names.clear();
  const LiveRun run_of_it = *run;
  lock.unlock();
  note("the recording ends here: " + error);
  try {
    if (ended) {
      ended->close(run_of_it);
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

void LiveLoop::State::answer_stop_recording(Lock& lock) {
  const std::vector<Done> done = std::exchange(stop_recording, {});
  const bool is_recording = recorder != nullptr;
  closing_error.clear();
  end_recording(lock);
  const std::string error = is_recording ? closing_error : "nothing is being recorded";
  lock.unlock();
  for (const Done& answer : done) {
    if (answer) {
      answer(error);
    }
  }
  lock.lock();
}

// What was prepared takes place.
void LiveLoop::State::take_place(Lock& lock) {
  LivePrepared next = std::move(*prepared);
  const std::vector<LiveChange> changes = std::move(*being_prepared);
  std::string error;
  try {
    const bool begins_recording = !next.recording.empty();
    if (begins_recording && recorder) {
      throw Error(fmt::format("{} is being recorded already", recording_names));
    }
    const LiveStart start = next.start.value_or(start_after(next.way, next.place, next.scenario, standing()));
    (void)LiveRun(scenario_from(next.scenario, start), start);
    if (begins_recording) {  // Before anything changes.
      LiveWorld trial;
      trial.scenario = scenario_from(next.scenario, start);
      for (const SonarConfig& sonar : trial.scenario.sonars) {
        trial.sonars.push_back(trial.scenario.filled_in(sonar));
      }
      trial.scene = (next.simulator ? *next.simulator : *simulator).scene();
      recorder = std::make_unique<LiveRecorder>(next.recording, 0, trial, next.replace);
      recording_path = next.recording;
      recording_replaces = next.replace;
      recording_part = 0;
    }
    const bool goes_on_recording = recorder && !begins_recording;
    if (goes_on_recording) {
      end_recording(lock);
    }
    if (next.simulator) {
      simulator = std::move(next.simulator);
      simulator->stop_when(&ending);
    } else if (next.sonars_change) {
      for (std::size_t i = 0; i < next.scenario.sonars.size(); ++i) {
        simulator->set_sonar(static_cast<int>(i), next.scenario.sonars[i]);
      }
    }
    settings = std::move(next.settings);
    scenario = std::move(next.scenario);
    if (!start.follows && run->start().follows && next.way == LiveWay::kPlaced) {
      velocity = {};
    }
    begin_run(start, lock);
    if (goes_on_recording) {
      try {
        recorder = std::make_unique<LiveRecorder>(recording_path, ++recording_part, *world, recording_replaces);
      } catch (const std::exception& failure) {
        fail_recording(failure.what(), lock);
      }
    }
    recording_names = recorder ? recorder->names() : "";
    recorded_pings = 0;
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  prepared.reset();
  being_prepared.reset();
  changed.notify_all();
  lock.unlock();
  for (const LiveChange& change : changes) {
    if (change.done) {
      change.done(error);
    }
  }
  lock.lock();
}

// Makes the pings of all sonars that are next. They count once all are made.
void LiveLoop::State::make_next(Lock& lock) {
  const Clock::time_point due = paused ? Clock::now() : next_due();
  std::string obstacle;
  if (options.driven) {
    if (!drive_to_next(lock)) {
      return;
    }
  } else {
    obstacle = run->fly_to_next(velocity);
    velocity = obstacle.empty() ? velocity : LiveVelocity();
  }
  const double time = run->next_time();
  const std::vector<int> sonars = run->next_sonars();
  std::vector<PingRequest> requests(sonars.size());
  for (std::size_t i = 0; i < sonars.size(); ++i) {
    run->fill(sonars[i], requests[i]);
    if (drive) {
      requests[i].twist = drive->twist;
      requests[i].moved.insert(requests[i].moved.end(), drive->moved.begin(), drive->moved.end());
    }
  }
  const double stamp = drive ? drive->stamp : 0, told_at = drive_told_at;
  keep_clock();
  keep_pace(due, time, sonars);
  const std::shared_ptr<const LiveWorld> of_world = world;
  lock.unlock();
  if (run->made_in_all() == 0) {
    solids.forget();
  }
  std::vector<std::shared_ptr<LivePing>> pings;
  std::string error;
  try {
    if (!obstacle.empty()) {
      note("the vehicle stops: " + obstacle);
    }
    for (std::size_t i = 0; i < sonars.size(); ++i) {
      const Clock::time_point start = Clock::now();
      const std::shared_ptr<LivePing> ping = pool.take();
      simulator->ping(sonars[i], requests[i], ping->ping);
      ping->world = of_world;
      ping->sonar = sonars[i];
      ping->world_from_vehicle = requests[i].world_from_vehicle;
      ping->moved = moved_instances(*simulator, requests[i]);
      ping->computing_time = std::chrono::duration<double>(Clock::now() - start).count();
      ping->made_at = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
      ping->stamp = stamp;
      ping->told_at = told_at;
      listener->on_ping(ping);
      for (const std::string& text : solids.entered(*simulator, sonars[i], requests[i])) {
        note(text);
      }
      pings.push_back(ping);
    }
  } catch (const Interrupted&) {
    lock.lock();
    return;
  } catch (const std::exception& failure) {
    error = failure.what();
    note("paused: " + error);
  }
  std::string not_recorded;
  if (error.empty() && recorder) {
    try {
      for (const std::shared_ptr<LivePing>& ping : pings) {
        recorder->add(*ping);
      }
    } catch (const std::exception& failure) {
      not_recorded = failure.what();
    }
  }
  lock.lock();
  if (!not_recorded.empty()) {
    fail_recording(not_recorded, lock);
  }
  if (!error.empty()) {
    paused = true;
    steps = 0;
    return;
  }
  for (const int sonar : sonars) {
    run->made(sonar);
  }
  pings_made += sonars.size();
  recorded_pings = recorder ? recorder->pings() : recorded_pings;
  steps = std::max(0, steps - 1);
}

void LiveLoop::State::make_pings() {
  Lock lock(mutex);
  while (!ending) {
    if (prepared) {
      take_place(lock);
    } else if (!stop_recording.empty()) {
      answer_stop_recording(lock);
    } else if ((paused && steps == 0) || waits_for_others()) {
      wake.wait(lock);
    } else if (!paused && !options.clocked && Clock::now() < next_due()) {
      wake.wait_until(lock, next_due());
    } else {
      make_next(lock);
    }
  }
  closing_error.clear();
  end_recording(lock);
}

}  // namespace insonify
