// arguments.cpp -- checks keywords and copies nested dicts and lists, with the name of each value for messages.

#include "arguments.h"

#include <fmt/format.h>

#include "convert.h"

namespace insonify::python {
namespace {

// Raises RecursionError instead of exhausting the stack if a list or dict contains itself.
class RecursionGuard {
 public:
  RecursionGuard() {
    if (Py_EnterRecursiveCall(" in a scenario's dict") != 0) {
      throw py::error_already_set();
    }
  }
  ~RecursionGuard() { Py_LeaveRecursiveCall(); }
  RecursionGuard(const RecursionGuard&) = delete;
  RecursionGuard& operator=(const RecursionGuard&) = delete;
};

[[noreturn]] void refuse_value(py::handle value, const std::string& name, const std::string& expected) {
  throw Error("", name, fmt::format(" = {} must be {}", shown(value), expected));
}

py::dict plain_dict(const py::dict& given, const std::string& name) {
  py::dict plain;
  for (const std::pair<py::handle, py::handle> item : given) {
    if (!py::isinstance<py::str>(item.first)) {
      throw Error("", name, fmt::format("{}has the key {}, must be text", name.empty() ? "" : " ", shown(item.first)));
    }
    plain[item.first] = plain_value(item.second, member_name(name, item.first.cast<std::string>()));
  }
  return plain;
}

py::list plain_list(const py::sequence& given, const std::string& name) {
  py::list plain;
  for (std::size_t i = 0; i < given.size(); ++i) {
    plain.append(plain_value(given[i], fmt::format("{}[{}]", name, i)));
  }
  return plain;
}

// Whether json.dumps() writes it unchanged.
bool is_scalar(py::handle value) {
  return value.is_none() || py::isinstance<py::bool_>(value) || py::isinstance<py::str>(value) ||
         py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value);
}

}  // namespace

std::string colour_map_name(const py::object& colour_map, const py::object& color_map) {
  if (!colour_map.is_none() && !color_map.is_none()) {
    throw Error("", "colour_map", " is given twice: color_map is the same");
  }
  std::string name = "inferno";
  if (!colour_map.is_none() || !color_map.is_none()) {
    const bool british = !colour_map.is_none();
    from_python(british ? colour_map : color_map, british ? "colour_map" : "color_map", 1, name);
  }
  return name;
}

py::object plain_value(py::handle value, const std::string& name) {
  constexpr const char* kExpected = "a number, a text, True, False, None, a list or a dict";
  const RecursionGuard guard;
  if (is_scalar(value)) {
    return py::reinterpret_borrow<py::object>(value);
  }
  if (py::isinstance<py::dict>(value)) {
    return plain_dict(py::reinterpret_borrow<py::dict>(value), name);
  }
  if (py::hasattr(value, "__fspath__")) {
    return py::module_::import("os").attr("fsdecode")(value);
  }
  if (py::hasattr(value, "dtype") && py::hasattr(value, "tolist")) {  // NumPy's arrays and scalars.
    const py::object list = value.attr("tolist")();
    if (py::type::of(list).is(py::type::handle_of(value))) {  // Such as a scalar that Python has no type for.
      refuse_value(value, name, kExpected);
    }
    return plain_value(list, name);
  }
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    return plain_list(py::reinterpret_borrow<py::sequence>(value), name);
  }
  refuse_value(value, name, kExpected);
}

}  // namespace insonify::python
