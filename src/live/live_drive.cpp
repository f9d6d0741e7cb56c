// live_drive.cpp -- poses and times set by another program.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>
#include <utility>

#include "insonify/error.h"
#include "live/live_state.h"

namespace insonify {

// Whether the next pings need a pose or a time that has not arrived.
bool LiveLoop::State::waits_for_others() const {
  if (options.on_request) {
    return asked.empty();
  }
  if (options.driven && (!drive || drive_refused)) {
    return true;
  }
  constexpr double kSameTime = 1e-9;  // [s]
  return options.clocked && (!clock || *clock - clock_anchor < run->next_time() - anchor_time - kSameTime);
}

// The time of another program's clock that the next pings wait for.
std::optional<double> LiveLoop::State::awaited() const {
  return options.clocked && clock && waits_for_others() ? std::optional(clock_anchor + run->next_time() - anchor_time)
                                                        : std::nullopt;
}

// Waits for what other programs send, and for requests; tells the listener, once after each, that there is nothing to
// do.
void LiveLoop::State::wait_for_others(Lock& lock) {
  if (!told_idle && !paused) {
    told_idle = true;
    lock.unlock();
    listener->on_idle();
    lock.lock();
    return;  // Something may have come meanwhile.
  }
  wake.wait(lock);
}

// Ends the path at the vehicle's current pose; the first time, starts the run there.
// @return  Whether pings can be made from that pose.
bool LiveLoop::State::drive_to_next(Lock& lock) {
  if (options.on_request) {
    std::tie(drive, drive_received_at) = std::move(asked.front());
    asked.pop_front();
  }
  std::string refusal;
  try {
    if (!driving) {
      const LiveStart start{.follows = false, .world_from_vehicle = drive->world_from_vehicle, .time = 0};
      (void)LiveRun(scenario_from(scenario, start), start);  // Throws before anything changes.
      begin_run(start, lock);
      driving = true;
    }
    refusal = run->drive_to_next(drive->world_from_vehicle);
  } catch (const Error& error) {
    refusal = error.what();
  }
  drive_refused = !refusal.empty();
  if (drive_refused) {
    lock.unlock();
    note("no ping: " + refusal);
    lock.lock();
    answer_drive(refusal, lock);
  }
  return !drive_refused;
}

// Tells whoever called drive() that its pings are made, or why none is.
void LiveLoop::State::answer_drive(const std::string& error, Lock& lock) {
  if (!drive || !drive->done) {
    return;
  }
  const auto done = std::exchange(drive->done, nullptr);
  lock.unlock();
  done(error);
  lock.lock();
}

// keep_pace() for another program's clock.
void LiveLoop::State::keep_clock() {
  if (!options.clocked || !clock) {
    return;
  }
  const double due = clock_anchor + run->next_time() - anchor_time;
  double period = 0;
  for (const int sonar : run->next_sonars()) {
    period = std::max(period, world->sonars[static_cast<std::size_t>(sonar)].ping_period.value_or(0));
  }
  clock_anchor = *clock - due < period ? due : *clock;
}

void LiveLoop::drive(LiveDrive drive) {
  State& state = *state_;
  if (!state.options.driven) {
    throw Error("drive: the loop was started without LiveOptions::driven");
  }
  PingRequest request;
  request.world_from_vehicle = drive.world_from_vehicle;
  request.twist = drive.twist;
  request.moved = drive.moved;
  request.validate();
  for (const CarriedSonar& carried : drive.carried) {
    PingRequest of_sonar;
    of_sonar.world_from_vehicle = carried.world_from_carrier;
    of_sonar.twist = carried.twist;
    of_sonar.validate();
  }
  const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  State::Lock lock(state.mutex);
  if (state.ending) {  // Nobody would answer.
    lock.unlock();
    if (drive.done) {
      drive.done(kEnds);
    }
    return;
  }
  state.told_idle = false;
  if (state.options.on_request) {
    constexpr std::size_t kMostAsked = 1000;
    if (state.asked.size() >= kMostAsked) {
      throw Error(fmt::format("drive: {} poses wait for their pings", kMostAsked));
    }
    const double before = state.asked.empty() ? state.drive_received_at : state.asked.back().second;
    state.asked.emplace_back(std::move(drive), std::max(now, std::nextafter(before, 2 * now)));  // Tells them apart.
    state.wake.notify_all();
    return;
  }
  state.drive = std::move(drive);
  state.drive_received_at = now;
  state.drive_refused = false;
  state.wake.notify_all();
}

void LiveLoop::advance(double time) {
  State& state = *state_;
  if (!state.options.clocked) {
    throw Error("advance: the loop was started without LiveOptions::clocked");
  }
  if (!std::isfinite(time)) {
    throw Error("", "time", fmt::format(" = {} s must be finite", time));
  }
  const State::Lock lock(state.mutex);
  state.told_idle = false;
  if (!state.clock || time < *state.clock) {
    state.clock_anchor = time;
    state.anchor_time = state.run->next_time();
  }
  state.clock = time;
  state.wake.notify_all();
  if (state.listener != nullptr && !state.ending) {
    state.listener->on_clock(time);
  }
}

}  // namespace insonify
