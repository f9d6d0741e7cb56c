// plain_values.h -- nested dicts and lists of Python as values that JSON has.

#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace insonify::python {

namespace py = pybind11;

/// A copy made of dicts, lists, texts, numbers, booleans and None alone. NumPy's scalars become numbers, arrays nested
/// lists, tuples lists, and paths (whatever has __fspath__) texts.
/// @param name  What the value is, for messages: "sonars[0].max_range"; "" for the outermost dict.
/// @throws Error with the name of the value that is something else, or of the dict with a key that is no text.
[[nodiscard]] py::object plain_value(py::handle value, const std::string& name);

}  // namespace insonify::python
