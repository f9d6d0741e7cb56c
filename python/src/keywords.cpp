// keywords.cpp -- checks keywords, with messages of one line.

#include "keywords.h"

#include <fmt/format.h>

#include "convert.h"

namespace insonify::python {

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

void refuse_others(const char* function, const py::kwargs& others, const char* taken) {
  for (const std::pair<py::handle, py::handle> item : others) {
    throw py::type_error(fmt::format("{}() has no argument {}; it takes {}", function, shown(item.first), taken));
  }
}

}  // namespace insonify::python
