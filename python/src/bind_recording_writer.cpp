// bind_recording_writer.cpp -- insonify.Recording, which writes recordings.

#include <fmt/format.h>

#include "bind.h"
#include "insonify/files.h"
#include "python_simulator.h"
#include "python_types.h"

namespace insonify::python {
namespace {

// A recording being written, and the settings that its pings must have.
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

  // After a failure, a file that was to replace another one stays beside it.
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
        fmt::format(" = {} must end in .h5 or .hdf5: a Recording is HDF5; insonify.export() writes other formats of it",
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
      "Writes one sonar's pings to an HDF5 file, ping by ping; the file is complete at any moment.\n\n"
      "path: the file. simulator, sonar: source of the pings. compress: by HDF5's own filters. replace: whether to "
      "replace an existing file. Raises Error if it cannot be made. Use it in a `with`.")
      .def(py::init(&start_recording), py::arg("path"), py::arg("simulator"), py::arg("sonar") = 0, py::kw_only(),
           py::arg("compress") = false, py::arg("replace") = false)
      .def(
          "add", [](RecordingInPython& self, const py::object& ping) { self.add(ping_from(ping)); }, py::arg("ping"),
          "Raises Error for a ping made with other settings, and if the disk is full; earlier pings stay readable.")
      .def(
          "close", [](RecordingInPython& self) { self.end(false); },
          "Flushes everything to disk and replaces an existing file. After a `with` that failed, the existing file "
          "stays, with the new one beside it.")
      .def_property_readonly(
          "place", [](const RecordingInPython& self) { return self.open().place().string(); },
          "Current path of the file: beside `path` until it replaces an existing one.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](RecordingInPython& self, const py::object& type, const py::object&, const py::object&) {
        self.end(!type.is_none());
      });
}

}  // namespace insonify::python
