// bind_recording.cpp -- insonify.Recording writes, insonify.RecordedPings reads.

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include "bind.h"
#include "held.h"
#include "insonify/files.h"
#include "insonify/recorded_pings.h"
#include "python_simulator.h"

namespace insonify::python {
namespace {

// A recording, and what is known of its sonar once a ping was asked for.
struct PythonRecording {
  RecordedPings pings;
  std::shared_ptr<const SonarFacts> facts = {};

  const std::shared_ptr<const SonarFacts>& known() {
    if (facts == nullptr) {
      const EchoModel model = pings.model() == "paper" ? EchoModel::kPaper : EchoModel::kCalibrated;
      facts = std::make_shared<SonarFacts>(SonarFacts{pings.sonar_config(), model, pings.receiver_config()});
    }
    return facts;
  }
};

std::uint64_t number_from(const RecordedPings& pings, py::ssize_t number) {
  const auto count = static_cast<py::ssize_t>(pings.ping_count());
  const py::ssize_t from_start = number < 0 ? number + count : number;
  if (from_start < 0 || from_start >= count) {
    throw py::index_error(fmt::format("there is no ping {}; the recording has {}", number, count));
  }
  return static_cast<std::uint64_t>(from_start);
}

std::shared_ptr<PythonPing> recorded_ping(PythonRecording& recording, py::ssize_t number) {
  auto ping = std::make_shared<PythonPing>();
  static_cast<Ping&>(*ping) = recording.pings.ping(number_from(recording.pings, number));
  ping->facts = recording.known();
  return ping;
}

void add_writer(py::module_& module) {
  py::class_<Recording>(
      module, "Recording",
      "Writes one sonar's pings to an HDF5 file, ping by ping; whole at any moment.\n\n"
      "path: the file. simulator, sonar: whose pings they are. compress: by HDF5's own filters. replace: whether "
      "it may take the place of a file that is there. Raises Error when it cannot be made. Use it in a `with`.")
      .def(py::init([](const py::object& path, PythonSimulator& simulator, const py::object& sonar, bool compress,
                       bool replace) {
             return simulator.recording(path_from(path, "path"), simulator.sonar(sonar),
                                        {.compress = compress, .replace = replace});
           }),
           py::arg("path"), py::arg("simulator"), py::arg("sonar") = 0, py::kw_only(), py::arg("compress") = false,
           py::arg("replace") = false)
      .def(
          "add", [](Recording& self, const PythonPing& ping) { self.add(ping); }, py::arg("ping"),
          "Raises Error when the disk is full; what was written before stays readable.")
      .def("close", &Recording::close, "Puts everything on the disk, and the file in the place of an earlier one.")
      .def_property_readonly(
          "place", [](const Recording& self) { return self.place().string(); },
          "Where the file is now: beside `path` until it replaces an earlier one.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](Recording& self, const py::args&) { self.close(); });
}

}  // namespace

void bind_recording(py::module_& module) {
  add_writer(module);
  py::class_<PythonRecording>(
      module, "RecordedPings",
      "A recording's pings, read when they are asked for: rec[3], len(rec), `for ping in rec`.\n\n"
      "path: an HDF5 file as `insonify run` writes, perhaps still growing: it has the pings that it had when it "
      "was opened. Raises Error for a file that is none.")
      .def(py::init([](const py::object& path) { return PythonRecording{RecordedPings(path_from(path, "path"))}; }),
           py::arg("path"))
      .def("__len__", [](const PythonRecording& self) { return self.pings.ping_count(); })
      .def("__getitem__", &recorded_ping, py::arg("number"))
      .def_property_readonly(
          "shape",
          [](const PythonRecording& self) {
            return py::make_tuple(self.pings.ping_count(), self.pings.bin_count(), self.pings.beam_count());
          },
          "(pings, bins, beams).")
      .def_property_readonly(
          "intensity",
          [](const PythonRecording& self) {
            const std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(self.pings.ping_count()),
                                                    self.pings.bin_count(), self.pings.beam_count()};
            py::array_t<float> all(shape);
            float* to = all.mutable_data();
            for (std::uint64_t ping = 0; ping < self.pings.ping_count(); ++ping) {
              for (const double value : self.pings.intensity(ping)) {
                *to++ = static_cast<float>(value);
              }
            }
            return all;
          },
          "All intensities, read now: float32 [pings, bins, beams].")
      .def_property_readonly(
          "sonar", [](PythonRecording& self) { return wrap(self.known()->sonar); }, "A SonarConfig.")
      .def_property_readonly(
          "model", [](const PythonRecording& self) { return self.pings.model(); },
          "calibrated or paper; \"\" where the file does not say.");
}

}  // namespace insonify::python
