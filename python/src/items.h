// items.h -- sequence[number] of sequences of pings, as Python's lists have it.

#pragma once

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <string>

#include "convert.h"

namespace insonify::python {

/// A ping for a whole number, counted from the end where negative; a list of pings for a slice.
/// @param owner    What has them, for messages: "the recording".
/// @param ping_at  Makes the ping of an index from 0.
/// @throws IndexError for a number out of range, TypeError for anything else.
template <typename PingAt>
py::object items_of(const py::object& number, py::ssize_t count, const char* owner, const PingAt& ping_at) {
  if (py::isinstance<py::slice>(number)) {
    py::ssize_t start = 0, stop = 0, step = 0, length = 0;
    if (!number.cast<py::slice>().compute(count, &start, &stop, &step, &length)) {
      throw py::error_already_set();
    }
    py::list pings;
    for (py::ssize_t i = 0; i < length; ++i) {
      pings.append(ping_at(start + i * step));
    }
    return pings;
  }
  if (PyIndex_Check(number.ptr()) == 0) {
    throw py::type_error("the number of a ping must be a whole number or a slice, not " + shown(number));
  }
  const py::ssize_t index = PyNumber_AsSsize_t(number.ptr(), PyExc_IndexError);
  if (index == -1 && PyErr_Occurred() != nullptr) {
    throw py::error_already_set();
  }
  const py::ssize_t from_start = index < 0 ? index + count : index;
  if (from_start < 0 || from_start >= count) {
    throw py::index_error(fmt::format("there is no ping {}; {} has {}", index, owner, count));
  }
  return py::cast(ping_at(from_start));
}

}  // namespace insonify::python
