// flown_line.h -- Simulator.line(): the pings of a side-scan sonar or a multibeam along a line, as arrays.

#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <vector>

#include "python_simulator.h"

namespace insonify::python {

/// Pings of a side-scan sonar or a multibeam in a row. Their labels are not kept.
struct FlownLine {
  std::shared_ptr<const SonarFacts> facts;
  std::uint64_t first_number = 0;
  std::vector<double> time;         ///< [ping] [s]
  std::vector<Pose> poses;          ///< [ping] World from housing.
  std::vector<double> altitude;     ///< [ping] By ground truth [m]; NaN where nothing is below.
  py::array_t<float> intensity;     ///< [ping, bin, beam]; the beams of a side-scan sonar are its sides.
  std::vector<Sounding> soundings;  ///< [ping, beam] of a multibeam, else empty.
};

/// Flies a straight level line, or what the scenario says.
/// @param begin, end  Of the vehicle in the world [m]; None: the scenario's trajectory with all its pings.
/// @param speed       From begin to end [m/s]; None: 1.5.
/// @param number      Of the first ping from begin to end; None: the one after the last.
/// @throws Error for a sonar of another type than sss and mbes, for a begin without an end, for an end at the begin,
/// for speed or
///         number without them, and for neither a trajectory nor these.
[[nodiscard]] std::shared_ptr<FlownLine> fly_line(PythonSimulator& self, const py::object& sonar,
                                                  const py::object& begin, const py::object& end,
                                                  const py::object& speed, const py::object& number);

}  // namespace insonify::python
