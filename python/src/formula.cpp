// formula.cpp -- checks the arguments of formulas before pybind11 maps them element by element.

#include "formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace insonify::python {

py::array_t<double> array_from(const Numbers& numbers, const std::string& name) {
  py::array_t<double> array;
  try {
    const py::array given = py::module_::import("numpy").attr("asarray")(numbers.given);
    const bool is_text = std::string("USOcmM").find(given.dtype().kind()) != std::string::npos;
    array = is_text ? py::array_t<double>() : py::array_t<double>::ensure(given);
    if (is_text || !array) {
      PyErr_Clear();
      throw Error("", name, fmt::format(" = {} must be a number or an array of numbers", shown(numbers.given)));
    }
  } catch (const py::error_already_set&) {  // Lists of unequal lengths are not an array.
    throw Error("", name, fmt::format(" = {} must be a number or an array of numbers", shown(numbers.given)));
  }
  return array;
}

void check_shapes(const py::array_t<double>* arrays, const std::string* names, std::size_t count) {
  std::vector<py::ssize_t> common;  // Lengths of the axes, the last one first.
  bool fits = true;
  std::string shapes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto axes = static_cast<std::size_t>(arrays[i].ndim());
    common.resize(std::max(common.size(), axes), 1);
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const py::ssize_t length = arrays[i].shape(static_cast<py::ssize_t>(axes - 1 - axis));
      fits = fits && (length == common[axis] || length == 1 || common[axis] == 1);
      common[axis] = common[axis] == 1 ? length : common[axis];
    }
    if (axes > 0) {
      shapes += fmt::format("{}{} {}", shapes.empty() ? "" : ", ", names[i],
                            py::str(arrays[i].attr("shape")).cast<std::string>());
    }
  }
  if (!fits) {
    throw Error(fmt::format("the shapes of the arrays do not fit together: {}", shapes));
  }
}

}  // namespace insonify::python
