// live_pings.cpp -- the thread that makes pings: their pace, and changes between them.

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

LiveWorld world_of(Scenario scenario, const Simulator& simulator) {
  LiveWorld world;
  world.scenario = std::move(scenario);
  world.scenario.engine = simulator.scenario().engine;
  world.engine_choice = simulator.engine_choice();
  world.scene = simulator.scene();
  for (const SonarConfig& sonar : world.scenario.sonars) {
    world.sonars.push_back(world.scenario.filled_in(sonar));
  }
  return world;
}

}  // namespace

// Due time of the next pings.
Clock::time_point LiveLoop::State::next_due() const {
  Clock::time_point due = anchor + clock_time((run->next_time() - anchor_time) / speed);
  if (options.rate_limit) {
    for (const int sonar : run->next_sonars()) {
      due = std::max(due, last_pings[static_cast<std::size_t>(sonar)] + clock_time(1 / *options.rate_limit));
    }
  }
  return due;
}

// Does not catch up after late pings: time slows down instead.
void LiveLoop::State::keep_pace(Clock::time_point due, double time, std::span<const int> sonars) {
  constexpr std::chrono::milliseconds kLate{20};
  const Clock::time_point now = Clock::now();
  anchor = now - due < kLate ? due : now;
  anchor_time = time;
  for (const int sonar : sonars) {
    last_pings[static_cast<std::size_t>(sonar)] = anchor;
  }
}

// Run time by the clock, at most that of the next pings.
double LiveLoop::State::time_now() const {
  const double since = std::chrono::duration<double>(Clock::now() - anchor).count();
  return paused ? anchor_time : std::min(run->next_time(), anchor_time + std::max(0.0, since) * speed);
}

void LiveLoop::State::begin_run(const LiveStart& start, Lock& lock) {
  run.emplace(scenario_from(scenario, start), start);
  anchor_time = 0;
  anchor = Clock::now();
  clock_anchor = clock.value_or(0);
  last_pings.assign(scenario.sonars.size(), Clock::time_point{});
  announce_world(lock);
}

// Makes the world for the following pings and announces it to the listener.
void LiveLoop::State::announce_world(Lock& lock) {
  auto next_world = std::make_shared<LiveWorld>(world_of(scenario_from(scenario, run->start()), *simulator));
  next_world->change = world ? world->change + 1 : 0;
  next_world->trajectory = scenario.trajectory;
  world = next_world;
  steps = 1;  // Shows the change even while paused.
  lock.unlock();
  listener->on_world(next_world);
  lock.lock();
}

// Applies the prepared change.
void LiveLoop::State::take_place(Lock& lock) {
  const std::vector<LiveChange> changes = std::move(*being_prepared);
  std::string error;
  try {
    apply(std::move(*prepared), lock);
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

void LiveLoop::State::apply(LivePrepared next, Lock& lock) {
  const bool begins_recording = !next.recording.empty();
  if (begins_recording && recorder) {
    throw Error(fmt::format("{} is being recorded already", recording_names));
  }
  const LiveStart start = next.start.value_or(start_after(next.way, next.place, next.scenario, standing()));
  (void)LiveRun(scenario_from(next.scenario, start), start);
  if (begins_recording) {  // Before anything changes.
    const Simulator& made = next.simulator ? *next.simulator : *simulator;
    const LiveWorld trial = world_of(scenario_from(next.scenario, start), made);
    recorder = std::make_unique<LiveRecorder>(next.recording, 0, trial, next.replace, options.messages, log());
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
    simulated_objects = std::move(next.objects);
    objects_changed = true;  // They may have changed since the preparation.
  }
  for (std::size_t i = 0; i < next.sonars.size(); ++i) {
    simulator->set_sonar(static_cast<int>(i), std::move(next.sonars[i]));
  }
  settings = std::move(next.settings);
  scenario = std::move(next.scenario);
  if (!start.follows && run->start().follows && next.way == LiveWay::kPlaced) {
    velocity = {};
  }
  begin_run(start, lock);
  if (goes_on_recording) {
    begin_next_recording(lock);
  }
  recording_names = recorder ? recorder->names() : "";
  recorded_pings = 0;
}

// The request of a sonar's next ping, with what other programs have sent.
PingRequest LiveLoop::State::next_request(int sonar) const {
  PingRequest request;
  run->fill(sonar, request);
  if (!drive) {
    return request;
  }
  request.twist = drive->twist;
  std::ranges::copy_if(drive->moved, std::back_inserter(request.moved), [&](const MovedObject& moved) {
    return !options.followed || moved.instance >= 0 || simulated_names.contains(moved.name);
  });
  for (const CarriedSonar& carried : drive->carried) {
    if (carried.sonar == scenario.sonars[static_cast<std::size_t>(sonar)].name) {
      request.world_from_vehicle = carried.world_from_carrier;
      request.twist = carried.twist;
    }
  }
  return request;
}

// Makes one ping and passes it to the listener. Without the lock.
std::shared_ptr<LivePing> LiveLoop::State::make_one(int sonar, const PingRequest& request, const Stamps& stamps) {
  const Clock::time_point start = Clock::now();
  std::shared_ptr<LivePing> ping = pool.take();
  simulator->ping(sonar, request, ping->ping);
  ping->world = stamps.world;
  ping->sonar = sonar;
  ping->world_from_vehicle = request.world_from_vehicle;
  ping->moved = moved_instances(*simulator, request);
  ping->computing_time = std::chrono::duration<double>(Clock::now() - start).count();
  ping->made_at = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  ping->stamp = stamps.stamp;
  ping->received_at = stamps.received_at;
  ping->request = stamps.request;
  ping->clock = stamps.clock;
  listener->on_ping(ping);
  for (const std::string& text : solids.entered(*simulator, sonar, request)) {
    note(text);
  }
  return ping;
}

// Makes the pings that are due and records them.
LiveLoop::State::Made LiveLoop::State::make_all(std::span<const int> sonars, std::span<const PingRequest> requests,
                                                const Stamps& stamps) {
  Made made;
  std::vector<std::shared_ptr<LivePing>> pings;
  try {
    for (std::size_t i = 0; i < sonars.size(); ++i) {
      pings.push_back(make_one(sonars[i], requests[i], stamps));
    }
  } catch (const Interrupted&) {
    made.interrupted = true;
    return made;
  } catch (const std::exception& failure) {
    made.error = failure.what();
    note((options.on_request ? "no ping: " : "paused: ") + made.error);
    return made;
  }
  try {
    for (std::size_t i = 0; recorder && i < pings.size(); ++i) {
      recorder->add(*pings[i]);
    }
  } catch (const std::exception& failure) {
    made.not_recorded = failure.what();
  }
  return made;
}

// Makes the next pings of all sonars due. They count once all are made.
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
  const std::vector<int> sonars = run->next_sonars();
  std::vector<PingRequest> requests;
  requests.reserve(sonars.size());
  for (const int sonar : sonars) {
    requests.push_back(next_request(sonar));
  }
  const Stamps stamps{world, drive ? drive->stamp : 0, drive_received_at, clock.value_or(0),
                      drive ? drive->request : 0};
  keep_clock();
  keep_pace(due, run->next_time(), sonars);
  lock.unlock();
  if (run->made_in_all() == 0) {
    solids.forget();
  }
  if (!obstacle.empty()) {
    note("the vehicle stops: " + obstacle);
  }
  const Made made = make_all(sonars, requests, stamps);
  lock.lock();
  answer_drive(made.interrupted ? kEnds : made.error, lock);
  if (made.interrupted) {
    return;
  }
  if (!made.not_recorded.empty()) {
    fail_recording(made.not_recorded, lock);
  }
  if (!made.error.empty()) {
    paused = !options.on_request;
    steps = 0;
    return;
  }
  count_made(sonars, lock);
}

void LiveLoop::State::make_pings() {
  Lock lock(mutex);
  while (!ending) {
    if (stops_recording()) {
      answer_stop_recording(lock);
    } else if (prepared) {
      take_place(lock);
    } else if (objects_changed) {
      take_objects(lock);
    } else if ((paused && steps == 0) || waits_for_others()) {
      wait_for_others(lock);
    } else if (!paused && !options.clocked && !options.on_request && Clock::now() < next_due()) {
      wake.wait_until(lock, next_due());
    } else {
      make_next(lock);
    }
  }
  closing_error.clear();
  end_recording(lock);
}

}  // namespace insonify
