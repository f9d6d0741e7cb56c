// held.h -- a configuration as a Python object: its fields in C++, its parts as Python objects of their own.

#pragma once

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "convert.h"
#include "insonify/field.h"
#include "insonify/files.h"

namespace insonify::python {

/// The contents of a Python object of a configuration's class. Parts (a struct, an optional one, a list or a dict of
/// them) are Python objects: `sonar = scenario.sonars[0]` stays valid when the list changes, and changing it changes
/// the scenario.
template <typename Config>
struct Held {
  Config value = {};                        ///< Its parts are those it was made with, perhaps no longer current.
  std::map<std::string, py::object> parts;  ///< By the part's name.
  const char* frozen = nullptr;             ///< Why its fields and parts cannot be set; null where they can.
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

// A part as a Python object.
template <typename Config>
py::object wrap_part(const Config& part, const char* frozen = nullptr) {
  return wrap(part, frozen);
}
template <typename Config>
py::object wrap_part(const std::optional<Config>& part, const char* frozen = nullptr) {
  return part ? wrap(*part, frozen) : py::none();
}
template <typename Config>
py::object wrap_part(const std::vector<Config>& part, const char* frozen = nullptr) {
  py::list list;
  for (const Config& config : part) {
    list.append(wrap(config, frozen));
  }
  return frozen == nullptr ? py::object(list) : py::object(py::tuple(list));
}
template <typename Config>
py::object wrap_part(const std::map<std::string, Config>& part, const char* frozen = nullptr) {
  py::dict dict;
  for (const auto& [key, config] : part) {
    dict[py::str(key)] = wrap(config, frozen);
  }
  return frozen == nullptr ? py::object(dict) : py::reinterpret_steal<py::object>(PyDictProxy_New(dict.ptr()));
}

/// Whether it is a dict, or a frozen object's read-only view of one.
inline bool is_mapping(py::handle object) {
  return py::isinstance<py::dict>(object) || Py_IS_TYPE(object.ptr(), &PyDictProxy_Type);
}

/// A part, with the tuple or view of a frozen object converted back to a list or dict.
inline py::object thawed(const py::object& part) {
  return py::isinstance<py::tuple>(part) ? py::object(py::list(part))
         : is_mapping(part)              ? py::object(py::dict(part))
                                         : part;
}

// The way back.
template <typename Config>
void unwrap_part(py::handle object, const std::string& name, Config& part) {
  part = unwrap<Config>(object, name);
}
template <typename Config>
void unwrap_part(py::handle object, const std::string& name, std::optional<Config>& part) {
  part = object.is_none() ? std::nullopt : std::optional(unwrap<Config>(object, name));
}
template <typename Config>
void unwrap_part(py::handle object, const std::string& name, std::vector<Config>& part) {
  if (py::isinstance<py::str>(object) || PySequence_Check(object.ptr()) == 0) {
    throw Error("", name, fmt::format(" = {} must be a list", shown(object)));
  }
  const auto items = py::reinterpret_borrow<py::sequence>(object);
  part.clear();
  for (std::size_t i = 0; i < items.size(); ++i) {
    part.push_back(unwrap<Config>(items[i], fmt::format("{}[{}]", name, i)));
  }
}
template <typename Config>
void unwrap_part(py::handle object, const std::string& name, std::map<std::string, Config>& part) {
  if (!is_mapping(object)) {
    throw Error("", name, fmt::format(" = {} must be a dict", shown(object)));
  }
  part.clear();
  for (const std::pair<py::handle, py::handle> item : py::dict(py::reinterpret_borrow<py::object>(object))) {
    const py::handle key = item.first, value = item.second;
    if (!py::isinstance<py::str>(key)) {
      throw Error("", name, fmt::format(" has the key {}, must be text", shown(key)));
    }
    part[key.cast<std::string>()] = unwrap<Config>(value, member_name(name, key.cast<std::string>()));
  }
}

template <typename Config>
py::object wrap(const Config& config, const char* frozen) {
  Held<Config> held{config, {}, frozen};
  if constexpr (HasParts<Config>) {
    Config::visit_parts(config, [&](const Part& part, const auto& member) {
      held.parts[std::string(part.name)] = wrap_part(member, frozen);
    });
  }
  return py::cast(std::move(held));
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
/// @throws Error for an object of another class.
template <typename Config>
Config unwrap(py::handle object, const std::string& name) {
  if constexpr (std::is_same_v<Config, MaterialOverride>) {
    if (py::isinstance<py::str>(object)) {  // As in files: `hull: steel`.
      return {.like = object.cast<std::string>()};
    }
  }
  if (!py::isinstance<Held<Config>>(object)) {
    const std::string expected = py::str(py::type::of<Held<Config>>().attr("__name__"));
    throw Error("", name, fmt::format(" = {} must be a {}", shown(object), expected));
  }
  const auto& held = object.cast<const Held<Config>&>();
  Config config = held.value;
  if constexpr (HasParts<Config>) {
    Config::visit_parts(config, [&](const Part& part, auto& member) {
      unwrap_part(held.parts.at(std::string(part.name)), member_name(name, part.name), member);
    });
  }
  if constexpr (std::is_same_v<Config, Scenario>) {
    if (!config.text.empty() && to_yaml(config) != to_yaml(held.value)) {  // A part was changed.
      forget_text(config);
    }
  }
  return config;
}

}  // namespace insonify::python
