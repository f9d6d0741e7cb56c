// bind_config.h -- makes a Python class of a configuration from its lists of fields and parts.

#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "field_table.h"
#include "held.h"

namespace insonify::python {

/// Sets fields by keyword.
/// @throws TypeError for an unknown one.
/// @throws Error for an angle given by both of its names.
inline void set_fields(const py::object& config, const py::dict& given) {
  const py::object property = py::module_::import("builtins").attr("property");
  for (const auto& [key, value] : given) {
    const py::object type = py::type::of(config);
    // Methods such as copy are not fields.
    if (!py::hasattr(type, key) || !py::isinstance(type.attr("__dict__").attr("get")(key), property)) {
      const bool is_preset = py::hasattr(type, "preset") && key.equal(py::str("preset"));
      throw py::type_error(type_of(config) + " has no field " + shown(key) +
                           (is_preset ? "; SonarConfig.preset(name, **fields) makes the sonar of a preset" : ""));
    }
    if (const py::str in_degrees(key.cast<std::string>() + "_deg"); given.contains(in_degrees)) {
      throw Error("", key.cast<std::string>(),
                  " is given twice: in radians, and in degrees as " + in_degrees.cast<std::string>());
    }
    py::setattr(config, key, value);
  }
}

template <typename Config>
class ConfigClass {
 public:
  ConfigClass(py::module_& module, const char* name, const std::string& doc)
      : class_(module, name,
               (doc + "\n\nFields can be given by keyword. Angles have two names: `x` in radians and "
                      "`x_deg` in degrees.")
                   .c_str()),
        module_(module),
        name_(name) {
    class_.def(py::init([](const py::kwargs& given) { return made_from(given); }));
    const Config defaults{};
    for (const FieldEntry& entry : field_table<Config>().entries()) {
      add_field(entry, defaults);
    }
    if constexpr (HasParts<Config>) {
      Config::visit_parts(defaults, [&](const Part& part, const auto& member) {
        const std::string type = part_type<std::remove_cvref_t<decltype(member)>>();
        describe(module_, name_, std::string(part.name), {type, type});
        add_part(part);
      });
    }
    class_.def(
        "copy", [](const Held<Config>& self) { return wrap(unwrap<Config>(py::cast(&self), "self")); },
        "A copy that can be changed, with copies of its parts.");
    class_.def("__copy__", [](const Held<Config>& self) { return wrap(unwrap<Config>(py::cast(&self), "self")); });
    class_.def("__deepcopy__",
               [](const Held<Config>& self, const py::dict&) { return wrap(unwrap<Config>(py::cast(&self), "self")); });
    class_.def(py::pickle(&state_of, &from_state));
    class_.def("__repr__", [name = std::string(name)](const Held<Config>& self) { return name + text_of(self); });
    class_.def("__eq__", &equals, py::is_operator());
    class_.attr("__hash__") = py::none();
  }

  py::class_<Held<Config>>& operator*() { return class_; }
  py::class_<Held<Config>>* operator->() { return &class_; }

 private:
  static void check_thawed(const Held<Config>& self, const char* owner, const std::string& name) {
    if (self.frozen != nullptr) {
      throw py::attribute_error(fmt::format("{}.{} cannot be set: {}", owner, name, self.frozen));
    }
  }

  void add_property(const FieldEntry& entry, const std::string& name, const std::string& help, double scale) {
    const auto get = [&entry, scale](const Held<Config>& self) {
      return entry.type->to_python(entry.in(&self.value), scale);
    };
    const auto set = [&entry, scale, name, owner = name_](Held<Config>& self, const py::object& value) {
      check_thawed(self, owner, name);
      if constexpr (std::is_same_v<Config, SonarConfig>) {
        if (entry.field.name == "name") {
          SonarConfig named;
          from_python(value, name, scale, named.name);
          named.validate();
        }
      }
      entry.type->set(value, name, scale, entry.field, entry.in(&self.value));
      forget_text(self.value);
    };
    class_.def_property(name.c_str(), get, set, help.c_str());
  }

  void add_field(const FieldEntry& entry, const Config& defaults) {
    const auto add = [&](const std::string& name, std::string_view unit, double scale) {
      add_property(entry, name, FieldTable::help_of(entry, &defaults, scale, unit), scale);
      describe(module_, name_, name, entry.type->python);
    };
    add(std::string(entry.field.name), entry.field.unit, 1);
    if (const double scale = file_scale_of(entry.field); scale != 1) {
      add(file_name_of(entry.field), file_unit_of(entry.field), scale);
    }
  }

  void add_part(const Part& part) {
    const std::string name(part.name);
    const auto get = [name](const Held<Config>& self) { return self.parts.at(name); };
    const auto set = [name, owner = name_](Held<Config>& self, const py::object& value) {
      check_thawed(self, owner, name);
      Config trial{};
      Config::visit_parts(trial, [&](const Part& one, auto& member) {
        if (one.name == name) {
          unwrap_part(value, name, member);
        }
      });
      const bool is_list = PySequence_Check(value.ptr()) != 0 && !py::isinstance<py::list>(value);
      self.parts.at(name) = is_list ? py::list(value) : value;
    };
    class_.def_property(name.c_str(), get, set, std::string(part.help).c_str());
  }

  static Held<Config> made_from(const py::kwargs& given) {
    py::object made = wrap(Config{});
    set_fields(made, given);
    return made.template cast<Held<Config>>();
  }

  // For pickle: fields in SI units, parts, and other members.
  static py::tuple state_of(const Held<Config>& self) {
    py::dict parts;
    for (const auto& [name, part] : self.parts) {
      parts[py::str(name)] = thawed(part);
    }
    py::tuple rest;
    if constexpr (std::is_same_v<Config, Material>) {
      rest = py::make_tuple(self.value.name, self.value.source);
    } else if constexpr (std::is_same_v<Config, Scenario>) {
      rest = py::make_tuple(unwrap<Config>(py::cast(&self), "self").text);
    }
    return py::make_tuple(field_table<Config>().values(&self.value), parts, rest);
  }

  // Whether both have the same class and equal fields and parts; the texts of scenario files
  // may differ.
  static bool equals(const Held<Config>& self, const Held<Config>& other) {
    bool same = field_table<Config>().equal(&self.value, &other.value);
    if constexpr (std::is_same_v<Config, Material>) {
      same = same && self.value.name == other.value.name && self.value.source == other.value.source;
    }
    for (const auto& [name, part] : self.parts) {
      same = same && thawed(part).equal(thawed(other.parts.at(name)));
    }
    return same;
  }

  static Held<Config> from_state(const py::tuple& state) {
    Held<Config> held = wrap(Config{}).template cast<Held<Config>>();
    field_table<Config>().set_values(state[0], &held.value);
    for (const std::pair<py::handle, py::handle> part : py::dict(state[1])) {
      held.parts.at(part.first.cast<std::string>()) = py::reinterpret_borrow<py::object>(part.second);
    }
    Config config = unwrap<Config>(py::cast(&held), "self");
    if constexpr (std::is_same_v<Config, Material>) {
      const py::tuple rest = state[2];
      config.name = rest[0].template cast<std::string>();
      config.source = rest[1].template cast<std::string>();
    } else if constexpr (std::is_same_v<Config, Scenario>) {
      config.text = py::tuple(state[2])[0].template cast<std::string>();
    }
    return wrap(config).template cast<Held<Config>>();
  }

  // "(name='fls', max_range=20.0)": fields that differ from the defaults.
  static std::string text_of(const Held<Config>& self) {
    const Config defaults{};
    std::string text = field_table<Config>().changes(&self.value, &defaults);
    for (const auto& [name, part] : self.parts) {
      if (!part.is_none() && !(py::hasattr(part, "__len__") && py::len(part) == 0)) {
        text += (text.empty() ? "" : ", ") + name + "=" +
                (py::isinstance<py::list>(thawed(part)) ? "[" + std::to_string(py::len(part)) + "]" : "...");
      }
    }
    return "(" + text + ")";
  }

  py::class_<Held<Config>> class_;
  py::module_ module_;
  const char* name_;
};

}  // namespace insonify::python
