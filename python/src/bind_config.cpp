// bind_config.cpp -- help, values, comparison and text of any configuration.

#include "bind_config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace insonify::python {
namespace {

// repr() of a value, but with 12 digits: angles are kept in radians, where 15 degrees are 14.999999999999998.
std::string rounded(py::handle value) {
  if (py::isinstance<py::float_>(value)) {
    return shown(py::float_(py::str(fmt::format("{:.12g}", value.cast<double>()))));
  }
  if (!py::isinstance<py::tuple>(value)) {
    return shown(value);
  }
  std::string text;
  for (const py::handle one : py::reinterpret_borrow<py::tuple>(value)) {
    text += (text.empty() ? "" : ", ") + rounded(one);
  }
  return "(" + text + (py::len(value) == 1 ? ",)" : ")");
}

// "; did you mean max_range?", or "".
std::string nearest_field(const py::object& type, py::handle key) {
  py::list fields;
  for (const auto& [name, member] : py::dict(type.attr("__dict__"))) {
    if (py::isinstance(member, py::module_::import("builtins").attr("property"))) {
      fields.append(name);
    }
  }
  const py::list near = py::module_::import("difflib").attr("get_close_matches")(py::str(key), fields, 1);
  return near.empty() ? "" : "; did you mean " + near[0].cast<std::string>() + "?";
}

}  // namespace

void set_fields(const py::object& config, const py::dict& given) {
  const py::object type = py::type::of(config), property = py::module_::import("builtins").attr("property");
  const auto is_field = [&](py::handle key) {  // Methods such as copy are none.
    return py::isinstance(type.attr("__dict__").attr("get")(key), property);
  };
  for (const auto& [key, value] : given) {
    if (!is_field(key)) {
      throw py::type_error(type_of(config) + " has no field " + shown(key) + nearest_field(type, key));
    }
    if (const py::str in_degrees(key.cast<std::string>() + "_deg"); given.contains(in_degrees)) {
      throw Error("", key.cast<std::string>(),
                  " is given twice: in radians, and in degrees as " + in_degrees.cast<std::string>());
    }
  }
  for (const bool first : {true, false}) {
    for (const auto& [key, value] : given) {
      if (is_of_range(key.cast<std::string>()) == first) {
        py::setattr(config, key, value);
      }
    }
  }
}

std::string help_of(const FieldEntry& field, const void* defaults, double scale, std::string_view unit) {
  std::vector<std::string> facts;
  if (!unit.empty()) {
    facts.emplace_back(unit);
  }
  if (std::isfinite(field.limits.least) || std::isfinite(field.limits.most)) {
    facts.push_back(field.limits.text(scale));
  }
  if (field.words != nullptr) {
    facts.push_back(fmt::format("one of {}", fmt::join(field.words->words, ", ")));
  }
  facts.push_back(field.get(defaults, [&]<typename Member>(const Member& member) {
    if constexpr (std::is_same_v<Member, double>) {
      return fmt::format("default {:.10g}", member * scale);  // 120, not 119.99999999999999.
    } else {
      return "default " + shown(to_python(member, scale));
    }
  }));
  return fmt::format("{} [{}]", field.help, fmt::join(facts, ", "));
}

py::object value_of(const FieldEntry& field, const void* config, double scale) {
  return field.get(config, [&](const auto& member) -> py::object { return to_python(member, scale); });
}

void set_value(const FieldEntry& field, py::handle value, const std::string& name, double scale, void* config) {
  field.change(config, [&](auto& member) {
    auto found = member;
    from_python(value, name, scale, found);
    check_member("", field, found);
    member = std::move(found);
  });
}

py::list state_of_fields(ConstSettings settings) {
  py::list all;
  for (const FieldEntry& field : settings.table->fields) {
    all.append(value_of(field, settings.config, 1));
  }
  return all;
}

void set_state_of_fields(const py::list& values, Settings settings) {
  std::size_t index = 0;
  for (const FieldEntry& field : settings.table->fields) {
    field.change(settings.config,
                 [&](auto& member) { from_python(values[index], std::string(field.name), 1, member); });
    ++index;
  }
}

py::dict state_of_parts(const Parts& parts) {
  py::dict state;
  for (const auto& [name, part] : parts) {
    state[py::str(name)] = thawed(part);
  }
  return state;
}

bool equal(ConstSettings one, const Parts& parts, ConstSettings other, const Parts& other_parts) {
  return std::ranges::all_of(one.table->fields,
                             [&](const FieldEntry& field) { return field.equal(one.config, other.config); }) &&
         std::ranges::all_of(
             parts, [&](const auto& part) { return thawed(part.second).equal(thawed(other_parts.at(part.first))); });
}

std::string text_of(ConstSettings settings, const Parts& parts) {
  std::vector<std::string> texts;
  for (const FieldEntry& field : settings.table->fields) {
    const double scale = file_scale_of(field);
    const py::object value = value_of(field, settings.config, scale);
    if (!value.equal(value_of(field, settings.table->defaults, scale))) {
      texts.push_back(file_name_of(field) + "=" + rounded(value));
    }
  }
  for (const auto& [name, part] : parts) {
    if (!part.is_none() && !(py::hasattr(part, "__len__") && py::len(part) == 0)) {
      texts.push_back(fmt::format("{}={}", name,
                                  py::isinstance<py::list>(thawed(part)) ? fmt::format("[{}]", py::len(part)) : "..."));
    }
  }
  return fmt::format("({})", fmt::join(texts, ", "));
}

}  // namespace insonify::python
