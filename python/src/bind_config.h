// bind_config.h -- makes a Python class of a configuration from its table of fields and parts.

#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "held.h"
#include "python_types.h"
#include "range_followers.h"

namespace insonify::python {

/// Sets fields by keyword; those that others follow from first.
/// @throws TypeError for an unknown one.
/// @throws Error for an angle given by both of its names.
void set_fields(const py::object& config, const py::dict& given);

/// A sonar from its fields and `preset`, the name of the one that it begins with, and `mode`; as in scenario files.
[[nodiscard]] py::object make_sonar(const py::dict& given);

/// Sentence on a field for help(): meaning, unit, limits and default.
[[nodiscard]] std::string help_of(const FieldEntry& field, const void* defaults, double scale, std::string_view unit);

/// The value of a field, times `scale`.
[[nodiscard]] py::object value_of(const FieldEntry& field, const void* config, double scale);
/// Sets a field, which keeps its value where this throws.
/// @throws Error about `name` for a value of another kind or out of limits.
void set_value(const FieldEntry& field, py::handle value, const std::string& name, double scale, void* config);

// For pickle: values of the fields in SI units, in order, and parts.
[[nodiscard]] py::list state_of_fields(ConstSettings settings);
void set_state_of_fields(const py::list& values, Settings settings);
[[nodiscard]] py::dict state_of_parts(const Parts& parts);

/// Whether fields and parts are equal.
[[nodiscard]] bool equal(ConstSettings one, const Parts& parts, ConstSettings other, const Parts& other_parts);

/// "(name='fls', max_range=20.0)": what differs from the defaults.
[[nodiscard]] std::string text_of(ConstSettings settings, const Parts& parts);

template <typename Config>
class ConfigClass {
 public:
  ConfigClass(py::module_& module, const char* name, const std::string& doc)
      : class_(
            module, name,
            (doc + "\n\nFields can be given by keyword. Angles have two names: `x` in radians and `x_deg` in degrees.")
                .c_str()),
        module_(module),
        name_(name) {
    class_.def(py::init([](const py::kwargs& given) { return made_from(given).template cast<Held<Config>>(); }));
    class_of(table_of<Config>()) = {
        name, &made_from,
        [](const void* config, const char* frozen) { return wrap(*static_cast<const Config*>(config), frozen); },
        [](py::handle object, const std::string& its_name, void* config) {
          *static_cast<Config*>(config) = unwrap<Config>(object, its_name);
        }};
    for (const FieldEntry& field : table_of<Config>().fields) {
      add_field(field);
    }
    for (const PartEntry& part : table_of<Config>().parts) {
      const std::string type = part_type(part);
      describe(module_, name_, std::string(part.name), {type, given_part_type(part)});
      add_part(part);
    }
    class_.def(
        "copy",
        [](const Held<Config>& self, const py::kwargs& changes) {
          py::object copied = wrap(unwrap<Config>(py::cast(&self), "self"));
          set_fields(copied, changes);
          return copied;
        },
        "copy(**changes)\n\nA copy that can be changed, with copies of its parts. Keywords change fields.");
    class_.def("__copy__", [](const Held<Config>& self) { return wrap(unwrap<Config>(py::cast(&self), "self")); });
    class_.def("__deepcopy__",
               [](const Held<Config>& self, const py::dict&) { return wrap(unwrap<Config>(py::cast(&self), "self")); });
    class_.def(py::pickle(&state_of, &from_state));
    class_.def("__repr__",
               [name = std::string(name)](const Held<Config>& self) { return name + text_of(self.value, self.parts); });
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

  void add_property(const FieldEntry& field, const std::string& name, const std::string& help, double scale) {
    const auto get = [&field, scale](const Held<Config>& self) { return value_of(field, &self.value, scale); };
    const auto set = [&field, scale, name, owner = name_](Held<Config>& self, const py::object& value) {
      check_thawed(self, owner, name);
      if constexpr (std::is_same_v<Config, SonarConfig>) {
        if (field.name == "name") {
          SonarConfig named;
          from_python(value, name, scale, named.name);
          named.validate();
        }
      }
      const auto change = [&] { set_value(field, value, name, scale, &self.value); };
      if constexpr (std::is_same_v<Config, SonarConfig>) {
        if (is_of_range(field.name)) {
          change_range(self, change);
          return;
        }
      }
      change();
      forget_text(self.value);
    };
    class_.def_property(name.c_str(), get, set, help.c_str());
  }

  void add_field(const FieldEntry& field) {
    const auto add = [&](const std::string& name, std::string_view unit, double scale) {
      add_property(field, name, help_of(field, table_of<Config>().defaults, scale, unit), scale);
      describe(module_, name_, name, python_type(field));
    };
    add(std::string(field.name), field.unit, 1);
    if (const double scale = file_scale_of(field); scale != 1) {
      add(file_name_of(field), file_unit_of(field), scale);
    }
  }

  void add_part(const PartEntry& part) {
    const std::string name(part.name);
    const auto get = [name](const Held<Config>& self) { return self.parts.at(name); };
    const auto set = [&part, name, owner = name_](Held<Config>& self, const py::object& value) {
      check_thawed(self, owner, name);
      Config trial{};
      unwrap_part(value, name, part, &trial);
      self.parts.at(name) = as_part(value, name, part);
    };
    class_.def_property(name.c_str(), get, set, std::string(part.help).c_str());
  }

  static py::object made_from(const py::dict& given) {
    if constexpr (std::is_same_v<Config, SonarConfig>) {
      return make_sonar(given);
    } else {
      py::object made = wrap(Config{});
      set_fields(made, given);
      return made;
    }
  }

  // For pickle: fields in SI units, parts, and other members.
  static py::tuple state_of(const Held<Config>& self) {
    py::tuple rest;
    if constexpr (std::is_same_v<Config, Material>) {
      rest = py::make_tuple(self.value.name, self.value.source);
    } else if constexpr (std::is_same_v<Config, Scenario>) {
      rest = py::make_tuple(unwrap<Config>(py::cast(&self), "self").text);
    }
    return py::make_tuple(state_of_fields(self.value), state_of_parts(self.parts), rest);
  }

  // Whether both have the same class and equal fields and parts; the texts of scenario files
  // may differ.
  static bool equals(const Held<Config>& self, const Held<Config>& other) {
    bool same = equal(self.value, self.parts, other.value, other.parts);
    if constexpr (std::is_same_v<Config, Material>) {
      same = same && self.value.name == other.value.name && self.value.source == other.value.source;
    }
    return same;
  }

  static Held<Config> from_state(const py::tuple& state) {
    Held<Config> held = wrap(Config{}).template cast<Held<Config>>();
    set_state_of_fields(state[0], held.value);
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

  py::class_<Held<Config>> class_;
  py::module_ module_;
  const char* name_;
};

}  // namespace insonify::python
