// live_loop.cpp -- public functions of LiveLoop: each passes a request to its threads.

#include "insonify/live_loop.h"

#include <algorithm>
#include <utility>

#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/scene_files.h"
#include "io/file/input_file.h"
#include "live/live_state.h"

namespace insonify {
namespace {

bool is_still(const LiveVelocity& velocity) {
  return velocity.linear.isZero(0) && velocity.angular.isZero(0);
}

void refuse(const LiveLoop::Done& done) {
  if (done) {
    done("another program moves the vehicle");
  }
}

}  // namespace

LiveLoop::State::State(const std::filesystem::path& given, std::span<const std::string> changes,
                       const LiveOptions& the_options, const Log& log)
    : options(the_options), paused(the_options.paused), builder(the_options.threads) {
  const std::filesystem::path path = scenario_file(given);
  settings = {.text = read_text_or_pipe(path), .path = path};
  settings.settings.assign(changes.begin(), changes.end());
  settings.followed = options.followed;
  scenario = builder.scenario_of(settings, {}, log);
  const LiveStart start;
  simulator = builder.build(scenario, start, {}, log);
  simulator->stop_when(&ending);
  run.emplace(scenario_from(scenario, start), start);
}

LiveLoop::LiveLoop(const std::filesystem::path& scenario, std::span<const std::string> settings,
                   const LiveOptions& options, const Log& log)
    : state_(std::make_unique<State>(scenario, settings, options, log)) {}

LiveLoop::~LiveLoop() {
  try {
    end();
  } catch (const Error&) {
    return;  // As the destructor of a Recording.
  }
}

void LiveLoop::start(LiveListener& listener) {
  State& state = *state_;
  state.listener = &listener;
  {
    State::Lock lock(state.mutex);
    state.begin_run({}, lock);
  }
  state.pinging = std::thread([&state] { state.make_pings(); });
  state.preparing = std::thread([&state] { state.prepare_changes(); });
}

void LiveLoop::end() {
  State& state = *state_;
  std::vector<LiveChange> undone;
  std::vector<State::Stop> stops;
  {
    const State::Lock lock(state.mutex);
    state.ending = true;
    undone = std::exchange(state.wishes, {});
    stops = std::exchange(state.stop_recording, {});
    state.wake.notify_all();
    state.changed.notify_all();
  }
  if (state.pinging.joinable()) {
    state.pinging.join();
    state.preparing.join();
  }
  if (state.being_prepared) {
    undone.insert(undone.end(), state.being_prepared->begin(), state.being_prepared->end());
    state.being_prepared.reset();
  }
  std::vector<Done> unanswered;
  std::ranges::transform(state.asked, std::back_inserter(unanswered), [](const auto& each) { return each.first.done; });
  state.asked.clear();
  std::ranges::transform(stops, std::back_inserter(unanswered), &State::Stop::done);
  std::ranges::transform(undone, std::back_inserter(unanswered), &LiveChange::done);
  for (const Done& done : unanswered) {
    if (done) {
      done(kEnds);
    }
  }
  if (const std::string error = std::exchange(state.recording_error, ""); !error.empty()) {
    throw Error(error);
  }
}

std::shared_ptr<const LiveWorld> LiveLoop::world() const {
  const State::Lock lock(state_->mutex);
  return state_->world;
}

LiveState LiveLoop::state() const {
  const State& state = *state_;
  const State::Lock lock(state_->mutex);
  return {.paused = state.paused,
          .follows = state.run->start().follows,
          .speed = state.speed,
          .recording = state.recording_names,
          .recorded_pings = state.recording_names.empty() ? 0 : state.recorded_pings,
          .recording_error = state.recording_error,
          .pings_made = state.pings_made,
          .pings_since_change = state.run->made_in_all(),
          .time = state.run->next_time(),
          .awaited = state.awaited(),
          .preparing = state.preparing_now};
}

void LiveLoop::pause(bool on) {
  State& state = *state_;
  const State::Lock lock(state.mutex);
  if (state.paused && !on) {
    state.anchor = State::Clock::now();
  }
  state.paused = on;
  state.steps = on && state.run->made_in_all() == 0 ? 1 : 0;  // Shows the change even while paused.
  state.wake.notify_all();
}

void LiveLoop::step() {
  State& state = *state_;
  constexpr int kMost = 100;  // Largest number of pending steps.
  const State::Lock lock(state.mutex);
  state.steps = std::min(state.steps + 1, kMost);
  state.wake.notify_all();
}

void LiveLoop::set_speed(double factor) {
  check_field("", {"speed", "", from_to(0.01, 100), ""}, factor);
  State& state = *state_;
  const State::Lock lock(state.mutex);
  const double time = state.time_now();
  state.anchor_time = time;
  state.anchor = State::Clock::now();
  state.speed = factor;
  state.wake.notify_all();
}

void LiveLoop::fly(const LiveVelocity& velocity) {
  check_fields("fly", velocity);
  State& state = *state_;
  if (state.options.driven) {
    return;
  }
  bool takes_helm = false;
  {
    const State::Lock lock(state.mutex);
    (void)state.run->fly_until(state.time_now(), state.velocity);  // With the old velocity.
    state.velocity = velocity;
    takes_helm = state.run->start().follows && !is_still(velocity) && !state.taking_helm;
    state.taking_helm = state.taking_helm || takes_helm;
  }
  if (takes_helm) {
    state.request({.way = LiveWay::kFromHere, .done = [&state](const std::string&) {
                     const State::Lock lock(state.mutex);
                     state.taking_helm = false;
                   }});
  }
}

void LiveLoop::place(const Pose& world_from_vehicle, Done done) {
  PingRequest request;
  request.world_from_vehicle = world_from_vehicle;
  request.validate();
  if (state_->options.driven) {
    return refuse(done);
  }
  state_->request({.way = LiveWay::kPlaced, .place = world_from_vehicle, .done = std::move(done)});
}

void LiveLoop::follow(bool on, Done done) {
  if (state_->options.driven) {
    return refuse(done);
  }
  state_->request({.way = on ? LiveWay::kFromStart : LiveWay::kFromHere, .done = std::move(done)});
}

void LiveLoop::set(std::vector<std::string> settings, Done done) {
  state_->request({.settings = std::move(settings), .done = std::move(done)});
}

void LiveLoop::set_material(std::string object, std::string material, Done done) {
  state_->request({.material = std::pair(std::move(object), std::move(material)), .done = std::move(done)});
}

void LiveLoop::record(const std::filesystem::path& path, Done done, bool replace) {
  State& state = *state_;
  {
    const State::Lock lock(state.mutex);
    ++state.recordings_asked;
  }
  const auto answer = [&state, done = std::move(done)](const std::string& error) {
    {
      const State::Lock lock(state.mutex);
      ++state.recordings_answered;
      state.wake.notify_all();
    }
    if (done) {
      done(error);
    }
  };
  state.request({.recording = path, .replace = replace, .done = answer});
}

void LiveLoop::stop_recording(Done done) {
  State& state = *state_;
  const State::Lock lock(state.mutex);
  state.stop_recording.push_back({state.recordings_asked, std::move(done)});
  state.wake.notify_all();
}

std::string LiveLoop::saved_scenario() const {
  std::optional<Scenario> saved;
  {
    const State::Lock lock(state_->mutex);
    saved = state_->run->saved();
  }
  return to_yaml(*saved);
}

}  // namespace insonify
