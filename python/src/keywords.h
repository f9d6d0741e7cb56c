// keywords.h -- keyword arguments: alternative spellings, and unknown ones.

#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace insonify::python {

namespace py = pybind11;

/// The colour map given by either spelling; both None: inferno.
/// @throws Error if both are given.
[[nodiscard]] std::string colour_map_name(const py::object& colour_map, const py::object& color_map);

/// Refuses unknown keywords with the names of the known ones: pybind11 would list types.
/// @throws TypeError that names the first of them.
void refuse_others(const char* function, const py::kwargs& others, const char* taken);

}  // namespace insonify::python
