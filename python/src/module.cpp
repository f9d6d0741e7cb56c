// module.cpp -- the compiled part of the Python package insonify; insonify.Error and insonify.Warning.

#include "bind.h"
#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/interrupted.h"
#include "insonify/version.h"
#include "interpreter_lock.h"

namespace insonify::python {
namespace {

py::handle error_class, warning_class;  // Live as long as the interpreter.

void raise(const Error& error) {
  py::object raised = error_class(error.what());
  const Place& place = error.place();
  raised.attr("file") = place.file.empty() ? py::object(py::none()) : py::str(place.file);
  raised.attr("line") = place.line == 0 ? py::object(py::none()) : py::int_(place.line);
  raised.attr("column") = place.column == 0 ? py::object(py::none()) : py::int_(place.column);
  raised.attr("object") = error.object();
  raised.attr("field") = error.field();
  PyErr_SetObject(error_class.ptr(), raised.ptr());
}

// pybind11 calls methods of uninitialised objects, such as Simulator.__new__(Simulator), with empty memory that it
// allocates here for the type.
void* refuse_memory(std::size_t) {
  throw py::type_error("this object was not initialised: its class must be called, not __new__() alone");
}

// Makes the methods of all classes of a module refuse uninitialised objects.
void guard_classes(const py::module_& module) {
  for (const std::pair<py::handle, py::handle> item : py::dict(module.attr("__dict__"))) {
    if (PyType_Check(item.second.ptr()) == 0) {
      continue;
    }
    if (auto* const type = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(item.second.ptr()))) {
      type->operator_new = refuse_memory;
    }
  }
}

}  // namespace

void bind_error(py::module_& module) {
  const auto make = [&](const char* name, PyObject* base, const char* doc) {
    PyObject* made = PyErr_NewExceptionWithDoc((std::string("insonify.") + name).c_str(), doc, base, nullptr);
    module.add_object(name, py::reinterpret_steal<py::object>(made));
    return py::handle(made).inc_ref();
  };
  error_class = make("Error", PyExc_ValueError,
                     "Invalid input: a file, a configuration, a value.\n\n"
                     "The message is one line, as on the command line. `file`, `line` and `column` say where, None if "
                     "unknown; `object` and `field` name the setting, \"\" if there is none.");
  warning_class = make("Warning", PyExc_UserWarning, "Something that is probably a mistake: see the message.");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) {
        std::rethrow_exception(thrown);
      }
    } catch (const Interrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    } catch (const Error& error) {
      raise(error);
    }
  });
}

Log warnings_log() {
  return [](Severity severity, const std::string& message) {
    const Locked locked;
    // With the line of the caller, one frame up: insonify/_calls.py calls what the caller has called.
    if (severity == Severity::kWarning && PyErr_WarnEx(warning_class.ptr(), message.c_str(), 2) != 0) {
      throw py::error_already_set();  // If warnings are errors.
    }
  };
}

}  // namespace insonify::python

PYBIND11_MODULE(_insonify, module) {
  using namespace insonify::python;
  module.doc() = "Imaging-sonar simulator.";
  module.attr("__version__") = insonify::kVersion;
  bind_error(module);
  bind_geometry(module);
  bind_configs(module);
  bind_scene(module);
  bind_ping(module);
  bind_line(module);
  bind_simulator(module);
  bind_recording_writer(module);
  bind_recording(module);
  bind_pictures(module);
  bind_acoustics(module);
  bind_similarity(module);
  bind_survey(module);
  bind_export(module);
  bind_end();
  guard_classes(module);
  guard_classes(module.attr("acoustics"));
  guard_classes(module.attr("similarity"));
  guard_classes(module.attr("survey"));
}
