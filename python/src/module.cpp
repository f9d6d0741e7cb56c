// module.cpp -- the compiled part of the Python package insonify.

#include "bind.h"
#include "insonify/files.h"
#include "insonify/version.h"

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
  bind_recording(module);
  bind_pictures(module);
  bind_acoustics(module);
  bind_similarity(module);
  bind_export(module);
}
