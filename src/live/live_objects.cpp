// live_objects.cpp -- adds objects to the simulator and removes them, between two pings.

#include "live/live_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/printable.h"
#include "live/live_state.h"

namespace insonify {
namespace {

// Adds objects together, or if that fails one by one, so that only those that cannot be added are skipped.
// @return  Names of the skipped ones; the reasons go to the log.
std::set<std::string> add(const LiveObjectList& objects, const Scenario& scenario, Simulator& simulator,
                          const Log& log) {
  try {
    Scene scene;
    for (const LiveObject& object : objects) {
      scene.instances.push_back(object.instance);
    }
    assign_scenario_materials(scene, scenario, log);
    (void)simulator.add_objects(scene);
    return {};
  } catch (const Error& error) {
    if (objects.size() == 1) {
      const std::string& name = objects.front().instance.name;
      log(Severity::kWarning, fmt::format("{} is skipped: {}", printable(name), error.what()));
      return {name};
    }
  }
  std::set<std::string> left_out;
  for (const LiveObject& object : objects) {
    left_out.merge(add({object}, scenario, simulator, log));
  }
  return left_out;
}

}  // namespace

LiveObjectList live_objects_only_in(const LiveObjectList& list, const LiveObjectList& other) {
  std::set<std::uint64_t> serials;
  for (const LiveObject& object : other) {
    serials.insert(object.serial);
  }
  LiveObjectList only;
  std::ranges::copy_if(list, std::back_inserter(only),
                       [&](const LiveObject& object) { return !serials.contains(object.serial); });
  return only;
}

bool has_live_object(const LiveObjectList& list, std::string_view name) {
  return std::ranges::any_of(list, [&](const LiveObject& object) { return object.instance.name == name; });
}

// Updates the simulator to the current objects.
void LiveLoop::State::take_objects(Lock& lock) {
  objects_changed = false;
  const LiveObjectList gone = live_objects_only_in(simulated_objects, objects);
  const LiveObjectList come = live_objects_only_in(objects, simulated_objects);
  if (gone.empty() && come.empty()) {
    return;
  }
  const bool records = recorder != nullptr;
  if (records) {
    end_recording(lock);
  }
  const Scenario scenario_now = scenario;
  lock.unlock();
  for (const LiveObject& object : gone) {
    try {
      simulator->remove_object(object.instance.name);
    } catch (const Error& error) {
      note(fmt::format("warning: {}", error.what()));
    }
  }
  const std::set<std::string> left_out =
      come.empty() ? std::set<std::string>() : add(come, scenario_now, *simulator, log());
  lock.lock();
  const auto is_left_out = [&](const LiveObject& object) {
    return left_out.contains(object.instance.name) &&
           std::ranges::find(come, object.serial, &LiveObject::serial) != come.end();
  };
  std::erase_if(simulated_objects, [&](const LiveObject& object) {
    return std::ranges::find(gone, object.serial, &LiveObject::serial) != gone.end();
  });
  std::ranges::copy_if(come, std::back_inserter(simulated_objects), std::not_fn(is_left_out));
  std::erase_if(objects, is_left_out);
  simulated_names.clear();
  for (const LiveObject& object : simulated_objects) {
    simulated_names.insert(object.instance.name);
  }
  if (!records) {
    announce_world(lock);
    return;
  }
  const LiveStart start = start_after(LiveWay::kGoesOn, {}, scenario, standing());
  begin_run(start, lock);
  begin_next_recording(lock);
  recording_names = recorder ? recorder->names() : "";
  recorded_pings = 0;
}

void LiveLoop::change_objects(LiveObjects change) {
  State& state = *state_;
  const State::Lock lock(state.mutex);
  LiveObjectList objects = state.objects;
  for (const std::string& name : change.removed) {
    if (!has_live_object(objects, name)) {
      throw Error(fmt::format("there is no object {} to remove", printable(name)));
    }
    std::erase_if(objects, [&](const LiveObject& object) { return object.instance.name == name; });
  }
  for (Instance& instance : change.added.instances) {
    if (instance.name.empty() || instance.mesh == nullptr) {
      throw Error(fmt::format("an object to be added has no {}", instance.name.empty() ? "name" : "mesh"));
    }
    if (has_live_object(objects, instance.name)) {
      throw Error(fmt::format("an object {} exists already; remove it first, or choose another name", instance.name));
    }
    objects.push_back({state.next_object++, std::move(instance)});
  }
  state.objects = std::move(objects);
  state.objects_changed = true;
  state.wake.notify_all();
}

}  // namespace insonify
