// bind_recording_writer.cpp -- insonify.Recording, which writes recordings.

#include <fmt/format.h>

#include "bind.h"
#include "insonify/files.h"
#include "python_simulator.h"
#include "python_types.h"

namespace insonify::python {
namespace {

// A recording that is being made, and what its pings must be of.
struct RecordingInPython {
  std::unique_ptr<Recording> file;
  std::shared_ptr<const SonarFacts> facts;
  bool replace = false;

  [[nodiscard]] Recording& open() const {
    if (file == nullptr) {
      throw Error("the recording is closed");
    }
    return *file;
  }

  void add(const PythonPing& ping) {
    if (ping.facts != facts) {
      const auto text = [](const SonarFacts& of) {
        Scenario one;
        one.model = of.model;
        one.receiver = of.receiver;
        one.sonars = {of.sonar};
        return to_yaml(one);
      };
      if (ping.facts == nullptr || text(*ping.facts) != text(*facts)) {
        throw Error(
            fmt::format("{}: ping {} was made with other settings than its own; they need a recording of their own",
                        open().place().string(), ping.number));
      }
    }
    open().add(ping);
  }

  // A file that was to replace another one stays beside it when its pings could not all be made.
  void end(bool failed) {
    if (file != nullptr && !(failed && replace)) {
      file->close();
    }
    file.reset();
  }
};

std::unique_ptr<RecordingInPython> start_recording(const py::object& given, PythonSimulator& simulator,
                                                   const py::object& sonar_, bool compress, bool replace) {
  const std::filesystem::path path = path_from(given, "path");
  if (path.extension() != ".h5" && path.extension() != ".hdf5") {
    throw Error(
        "", "path",
        fmt::format(" = {} must end in .h5 or .hdf5: a Recording is HDF5; insonify.export() writes other formats "
                    "of it",
                    path.string()));
  }
  const int sonar = simulator.sonar(sonar_);
  return std::make_unique<RecordingInPython>(
      RecordingInPython{simulator.recording(path, sonar, {.compress = compress, .replace = replace}),
                        simulator.known().facts[sonar], replace});
}

}  // namespace

void bind_recording_writer(py::module_& module) {
  py::class_<RecordingInPython>(
      module, "Recording",
      "Writes one sonar's pings to an HDF5 file, ping by ping; whole at any moment.\n\n"
      "path: the file. simulator, sonar: whose pings they are. compress: by HDF5's own filters. replace: whether "
      "it may take the place of a file that is there. Raises Error when it cannot be made. Use it in a `with`.")
      .def(py::init(&start_recording), py::arg("path"), py::arg("simulator"), py::arg("sonar") = 0, py::kw_only(),
           py::arg("compress") = false, py::arg("replace") = false)
      .def(
          "add", [](RecordingInPython& self, const py::object& ping) { self.add(ping_from(ping)); }, py::arg("ping"),
          "Raises Error for a ping made with other settings, and when the disk is full; what was written before stays "
          "readable.")
      .def(
          "close", [](RecordingInPython& self) { self.end(false); },
          "Puts everything on the disk, and the file in the place of an earlier one. At the end of a `with` that "
          "failed "
          "the earlier one stays, and the new one beside it.")
      .def_property_readonly(
          "place", [](const RecordingInPython& self) { return self.open().place().string(); },
          "Where the file is now: beside `path` until it replaces an earlier one.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](RecordingInPython& self, const py::object& type, const py::object&, const py::object&) {
        self.end(!type.is_none());
      });
}

}  // namespace insonify::python
