// arguments.h -- arguments from Python: alternative keywords, and nested dicts and lists.

#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace insonify::python {

namespace py = pybind11;

/// The colour map given by either spelling; both None: inferno.
/// @throws Error if both are given.
[[nodiscard]] std::string colour_map_name(const py::object& colour_map, const py::object& color_map);

/// A copy made only of dicts, lists, texts, numbers, booleans and None. NumPy's scalars become numbers, arrays nested
/// lists, tuples lists, and paths (anything with __fspath__) texts.
/// @param name  Name of the value in messages: "sonars[0].max_range"; "" for the outermost dict.
/// @throws Error with the name of a value of another type, or of a dict with a key that is not text.
[[nodiscard]] py::object plain_value(py::handle value, const std::string& name);

}  // namespace insonify::python
