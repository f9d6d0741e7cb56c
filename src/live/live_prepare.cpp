// live_prepare.cpp -- the thread that prepares changes while pings of the old state continue.

#include <algorithm>

#include "base/interruption.h"
#include "insonify/error.h"
#include "insonify/interrupted.h"
#include "live/live_state.h"

namespace insonify {
namespace {

constexpr std::size_t kMostWishes = 1000;

void answer(const std::vector<LiveChange>& changes, const std::string& error) {
  for (const LiveChange& change : changes) {
    if (change.done) {
      change.done(error);
    }
  }
}

}  // namespace

Log LiveLoop::State::log() const {
  return [this](Severity severity, const std::string& message) {
    if (severity == Severity::kWarning) {
      note("warning: " + message);
    }
  };
}

void LiveLoop::State::request(LiveChange change) {
  {
    const Lock lock(mutex);
    if (!ending && wishes.size() < kMostWishes) {
      wishes.push_back(std::move(change));
      changed.notify_all();
      return;
    }
  }
  answer({std::move(change)}, ending ? kEnds : "too many requests wait for an answer");
}

// Those left when the loop ends are only answered.
void LiveLoop::State::prepare_each(std::vector<LiveChange> batch, Lock& lock) {
  for (LiveChange& change : batch) {
    if (ending) {
      lock.unlock();
      answer({std::move(change)}, kEnds);
      lock.lock();
    } else {
      prepare_batch({std::move(change)}, lock);
    }
  }
}

// Prepares changes together; if that fails, one by one, so that valid ones are applied. The start of a
// recording is always a change of its own: there can be one recording, and other requests do not depend on
// it.
void LiveLoop::State::prepare_batch(std::vector<LiveChange> batch, Lock& lock) {
  if (batch.size() > 1 &&
      std::ranges::any_of(batch, [](const LiveChange& change) { return !change.recording.empty(); })) {
    return prepare_each(std::move(batch), lock);
  }
  const LiveSettings settings_now = settings;
  const Scenario scenario_now = scenario;
  const LiveStanding standing_now = standing();
  const LiveObjectList objects_now = objects;
  const std::shared_ptr<const LiveWorld> world_now = world;
  lock.unlock();
  std::optional<LivePrepared> next;
  std::string error;
  try {
    next = builder.prepare(batch, settings_now, scenario_now, standing_now, objects_now, world_now->scene, log());
  } catch (const Interrupted&) {
    error = kEnds;
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  if (!next && batch.size() == 1) {
    answer(batch, error);
    lock.lock();
    return;
  }
  lock.lock();
  if (!next) {
    return prepare_each(std::move(batch), lock);
  }
  // The other thread answers.
  prepared = std::move(next);
  being_prepared = std::move(batch);
  wake.notify_all();
  changed.wait(lock, [this] { return !prepared || ending; });
}

void LiveLoop::State::prepare_changes() {
  const InterruptionScope scope(ending);  // Aborts a preparation when the loop ends.
  Lock lock(mutex);
  while (true) {
    changed.wait(lock, [this] { return ending || !wishes.empty(); });
    if (ending) {
      break;
    }
    preparing_now = true;
    prepare_batch(std::exchange(wishes, {}), lock);
    preparing_now = false;
  }
}

}  // namespace insonify
