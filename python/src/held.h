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

/// What a Python object of a configuration's class holds. Parts (a struct, an optional one, a list or a dict of them)
/// are Python objects: `sonar = scenario.sonars[0]` stays what it is when the list changes, and a change of it is one
/// of the scenario's.
template <typename Config>
struct Held {
  Config value = {};                        ///< Its parts are those it was made with, perhaps no longer current.
  std::map<std::string, py::object> parts;  ///< By the part's name.
};

template <typename Config>
py::object wrap(const Config& config);
template <typename Config>
Config unwrap(py::handle object, const std::string& name);

// A part as Python object.
template <typename Config>
py::object wrap_part(const Config& part) {
  return wrap(part);
}
template <typename Config>
py::object wrap_part(const std::optional<Config>& part) {
  return part ? wrap(*part) : py::none();
}
template <typename Config>
py::object wrap_part(const std::vector<Config>& part) {
  py::list list;
  for (const Config& config : part) {
    list.append(wrap(config));
  }
  return list;
}
template <typename Config>
py::object wrap_part(const std::map<std::string, Config>& part) {
  py::dict dict;
  for (const auto& [key, config] : part) {
    dict[py::str(key)] = wrap(config);
  }
  return dict;
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
  if (!py::isinstance<py::dict>(object)) {
    throw Error("", name, fmt::format(" = {} must be a dict", shown(object)));
  }
  part.clear();
  for (const std::pair<py::handle, py::handle> item : py::reinterpret_borrow<py::dict>(object)) {
    const py::handle key = item.first, value = item.second;
    if (!py::isinstance<py::str>(key)) {
      throw Error("", name, fmt::format(" has the key {}, must be text", shown(key)));
    }
    part[key.cast<std::string>()] = unwrap<Config>(value, member_name(name, key.cast<std::string>()));
  }
}

template <typename Config>
py::object wrap(const Config& config) {
  Held<Config> held{config, {}};
  if constexpr (HasParts<Config>) {
    Config::visit_parts(
        config, [&](const Part& part, const auto& member) { held.parts[std::string(part.name)] = wrap_part(member); });
  }
  return py::cast(std::move(held));
}

/// A scenario's text and places are those of its file only as long as nothing was changed.
template <typename Config>
void forget_text(Config& config) {
  if constexpr (std::is_same_v<Config, Scenario>) {
    config.text.clear();
    config.places.clear();
  }
}

/// The configuration that a Python object stands for, with its parts as they are now.
/// @param name  What it is, for messages: "sonars[0]".
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
