// ping_batch.h -- many pings of one sonar as arrays with a leading axis.

#pragma once

#include <pybind11/pybind11.h>

#include "python_simulator.h"

namespace insonify::python {

/// A given PingRequest, one from its dict, or one made from a pose.
[[nodiscard]] PythonSimulator::Asked asked_from(const py::object& pose);

/// Whether it may be a pose, a request or many of them, rather than a sonar's name or index.
[[nodiscard]] bool is_pose(py::handle given);

/// Simulator.ping_batch(): a dict of the pings' tables, [ping, bin, beam].
/// @param sonar_  Sonar; or the poses, where `given` is None.
/// @throws Error for the first invalid pose, time or number, with its index.
[[nodiscard]] py::dict ping_batch(PythonSimulator& self, const py::object& sonar_, const py::object& given,
                                  const py::object& times, const py::object& numbers);

}  // namespace insonify::python
