// held.h -- a configuration as a Python object: its fields in C++, its parts as Python objects of their own.

#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>
#include <vector>

#include "convert.h"
#include "insonify/files.h"
#include "insonify/scenario.h"

namespace insonify::python {

/// The parts of a configuration as Python objects, by their names.
using Parts = std::map<std::string, py::object>;

/// The contents of a Python object of a configuration's class. Parts (a struct, an optional one, a list or a dict of
/// them) are Python objects: `sonar = scenario.sonars[0]` stays valid when the list changes, and changing it changes
/// the scenario.
template <typename Config>
struct Held {
  Config value = {};             ///< Its parts are those it was made with, perhaps no longer current.
  Parts parts;                   ///< As they are now.
  const char* frozen = nullptr;  ///< Why its fields and parts cannot be set; null where they can.
};

// A frozen object refuses changes, which would have no effect; its copy() can be changed.
inline constexpr const char* kSimulatorsSonar =
    "this is a copy of a simulator's sonar; change a copy() of it and pass that to Simulator.set_sonar()";
inline constexpr const char* kSimulatorsScenario =
    "this is a copy of a simulator's scenario; pass a changed copy() of a sonar to Simulator.set_sonar(), of the "
    "scenario to a new Simulator()";
inline constexpr const char* kPingsSonar = "a ping was made with these settings; change a copy() of them";

/// @param frozen  Why it and its parts cannot be changed, with tuples for lists; null: they can.
template <typename Config>
py::object wrap(const Config& config, const char* frozen = nullptr);
template <typename Config>
Config unwrap(py::handle object, const std::string& name);

/// The Python class of a configuration, for code that knows only its table.
struct HeldClass {
  std::string name;
  py::object (*make)(const py::dict& fields);  ///< @throws as setting a field does
  py::object (*wrap)(const void* config, const char* frozen);
  void (*unwrap)(py::handle object, const std::string& name, void* config);
};
/// The class of a table; a new one for a table that has none yet.
[[nodiscard]] HeldClass& class_of(const SettingsTable& table);

[[nodiscard]] Parts wrap_parts(ConstSettings settings, const char* frozen);

/// Sets one part, or all of them, from Python objects.
/// @throws Error about `name` for objects of another class.
void unwrap_part(py::handle object, const std::string& name, const PartEntry& part, void* config);
void unwrap_parts(const Parts& parts, const std::string& name, Settings settings);

/// An object of a configuration's class from the dict that stands for it; other objects as they are.
/// @throws Error about `name` for a dict with an unknown key or a value that is refused.
[[nodiscard]] py::object as_held(py::handle object, const std::string& name, const HeldClass& held_class);

/// A value for a part, with objects for the dicts in it, in a list or dict of its own.
[[nodiscard]] py::object as_part(const py::object& value, const std::string& name, const PartEntry& part);

/// A part, with the tuple or view of a frozen object converted back to a list or dict.
[[nodiscard]] py::object thawed(const py::object& part);

/// @throws Error "sonars[0] = 3 must be a SonarConfig or a dict of its fields"
[[noreturn]] void refuse_class(py::handle object, const std::string& name, const std::string& expected);

template <typename Config>
py::object wrap(const Config& config, const char* frozen) {
  return py::cast(Held<Config>{config, wrap_parts(config, frozen), frozen});
}

/// A scenario's text and places are valid only until something is changed.
template <typename Config>
void forget_text(Config& config) {
  if constexpr (std::is_same_v<Config, Scenario>) {
    config.text.clear();
    config.places.clear();
  }
}

/// The configuration that a Python object stands for, with its parts as they are now.
/// @param name  Its name in messages: "sonars[0]".
/// @throws Error for an object of another class, and as as_held().
template <typename Config>
Config unwrap(py::handle object, const std::string& name) {
  if constexpr (std::is_same_v<Config, MaterialOverride>) {
    if (py::isinstance<py::str>(object)) {  // As in files: `hull: steel`.
      return {.like = object.cast<std::string>()};
    }
  }
  const HeldClass& held_class = class_of(table_of<Config>());
  const py::object made = as_held(object, name, held_class);
  if (!py::isinstance<Held<Config>>(made)) {
    refuse_class(object, name, held_class.name);
  }
  const auto& held = made.cast<const Held<Config>&>();
  Config config = held.value;
  unwrap_parts(held.parts, name, config);
  if constexpr (std::is_same_v<Config, Scenario>) {
    if (!config.text.empty() && to_yaml(config) != to_yaml(held.value)) {  // A part was changed.
      forget_text(config);
    }
  }
  return config;
}

/// Configurations as a Python list.
template <typename Configs>
py::list wrap_all(const Configs& configs) {
  py::list list;
  for (const auto& config : configs) {
    list.append(wrap(config));
  }
  return list;
}

}  // namespace insonify::python
