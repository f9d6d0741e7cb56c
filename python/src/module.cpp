// module.cpp -- the compiled part of the Python package insonify.

#include "bind.h"
#include "insonify/files.h"
#include "insonify/version.h"

namespace insonify::python {
namespace {

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
  bind_simulator(module);
  bind_recording_writer(module);
  bind_recording(module);
  bind_pictures(module);
  bind_acoustics(module);
  bind_similarity(module);
  bind_export(module);
  guard_classes(module);
  guard_classes(module.attr("acoustics"));
  guard_classes(module.attr("similarity"));
}
