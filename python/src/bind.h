// bind.h -- the parts of the module, and their shared declarations.

#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "insonify/log.h"
#include "insonify/ping.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify::python {

namespace py = pybind11;

/// Names by the numbers in a ping's labels.
struct LabelNames {
  std::vector<std::string> instances, materials;
};

/// Facts about a ping's sonar for drawing and measuring it, and the names of its labels.
struct SonarFacts {
  SonarConfig sonar;  ///< Filled in.
  EchoModel model = EchoModel::kCalibrated;
  ReceiverConfig receiver;
  std::shared_ptr<const LabelNames> names = std::make_shared<LabelNames>();
};

/// A copy of a simulator's scene. It refuses additions, which would not reach the simulator.
struct SimulatorsScene : Scene {};

struct PythonRecording;

/// A ping in Python.
struct PythonPing : Ping {
  std::shared_ptr<const SonarFacts> facts;
  std::shared_ptr<const PythonRecording> source = {};  ///< Where a recorded ping's other tables are read from.
};

/// @throws Error for an object that is not a Ping.
[[nodiscard]] const PythonPing& ping_from(const py::object& given);

// Each adds its classes and functions to the module. In this order: a class must exist before it is used as a default.
void bind_error(py::module_& module);
void bind_geometry(py::module_& module);
void bind_configs(py::module_& module);
void bind_scene(py::module_& module);
void bind_ping(py::module_& module);
void bind_line(py::module_& module);
void bind_simulator(py::module_& module);
void bind_recording_writer(py::module_& module);
void bind_recording(py::module_& module);
void bind_pictures(py::module_& module);
void bind_acoustics(py::module_& module);
void bind_similarity(py::module_& module);
void bind_survey(py::module_& module);
void bind_export(py::module_& module);

/// Passes warnings to Python's `warnings`, as insonify.Warning; drops informational messages.
[[nodiscard]] Log warnings_log();

/// A scenario object made by load_scenario() or parse_scenario().
[[nodiscard]] py::object load_wrapped(const py::object& path, const py::object& settings);
[[nodiscard]] py::object parse_wrapped(const std::string& text, const py::object& folder, const py::object& settings);
/// Points, or pairs of depth and speed. @param name  Of the argument.
[[nodiscard]] std::vector<ProfilePoint> profile_points(const py::iterable& given, const std::string& name);
[[nodiscard]] py::object scenario_from_dict(const py::dict& dict, const py::object& folder);

}  // namespace insonify::python
