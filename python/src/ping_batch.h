// ping_batch.h -- many pings of one sonar as arrays with a leading axis.

#pragma once

#include <pybind11/pybind11.h>

#include "python_simulator.h"

namespace insonify::python {

/// A given PingRequest, or one made from a pose.
[[nodiscard]] PythonSimulator::Asked asked_from(const py::object& pose);

/// Simulator.ping_batch(): a dict of the pings' tables, [ping, bin, beam].
/// @throws Error for the first invalid pose or time, with its index.
[[nodiscard]] py::dict ping_batch(PythonSimulator& self, const py::object& sonar_, const py::object& given,
                                  const py::object& times);

}  // namespace insonify::python
