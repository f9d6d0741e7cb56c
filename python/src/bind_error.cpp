// bind_error.cpp -- insonify.Error and insonify.Warning.

#include "bind.h"
#include "insonify/error.h"
#include "insonify/interrupted.h"

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
    const py::gil_scoped_acquire held;
    if (severity == Severity::kWarning && PyErr_WarnEx(warning_class.ptr(), message.c_str(), 1) != 0) {
      throw py::error_already_set();  // If warnings are errors.
    }
  };
}

}  // namespace insonify::python
