// keywords.h -- keywords of functions: two spellings of one, and those that a function does not take.

#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace insonify::python {

namespace py = pybind11;

/// The colour map that a caller names by the one spelling or the other; both None: inferno.
/// @throws Error where both are given.
[[nodiscard]] std::string colour_map_name(const py::object& colour_map, const py::object& color_map);

/// Refuses keywords that a function does not take, with the names of those that it takes: pybind11 would list types.
/// @throws TypeError that names the first of them.
void refuse_others(const char* function, const py::kwargs& others, const char* taken);

}  // namespace insonify::python
