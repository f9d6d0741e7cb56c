// plain_values.h -- converts nested dicts and lists of Python to JSON values.

#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace insonify::python {

namespace py = pybind11;

/// A copy made only of dicts, lists, texts, numbers, booleans and None. NumPy's scalars become numbers, arrays nested
/// lists, tuples lists, and paths (anything with __fspath__) texts.
/// @param name  Name of the value in messages: "sonars[0].max_range"; "" for the outermost dict.
/// @throws Error with the name of a value of another type, or of a dict with a key that is not text.
[[nodiscard]] py::object plain_value(py::handle value, const std::string& name);

}  // namespace insonify::python
