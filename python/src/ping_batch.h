// ping_batch.h -- many pings of one sonar as arrays with a leading axis.

#pragma once

#include <pybind11/pybind11.h>

#include "python_simulator.h"

namespace insonify::python {

/// A PingRequest as it is, or one of a pose.
[[nodiscard]] PythonSimulator::Asked asked_from(const py::object& pose);

/// Simulator.ping_batch(): a dict of the tables that the pings have, [ping, bin, beam].
/// @throws Error for the first pose or time that makes no sense, with its index.
[[nodiscard]] py::dict ping_batch(PythonSimulator& self, const py::object& sonar_, const py::object& given,
                                  const py::object& times);

}  // namespace insonify::python
