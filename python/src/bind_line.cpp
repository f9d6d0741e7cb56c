// bind_line.cpp -- insonify.Line: what Simulator.line() returns.

#include <fmt/format.h>

#include "bind.h"
#include "flown_line.h"
#include "held.h"
#include "insonify/printable.h"
#include "items.h"

namespace insonify::python {
namespace {

using LineClass = py::class_<FlownLine, std::shared_ptr<FlownLine>>;

py::array_t<double> doubles_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array_t<double> poses_of(const FlownLine& line) {
  py::array_t<double> poses({static_cast<py::ssize_t>(line.poses.size()), py::ssize_t{7}});
  auto to = poses.mutable_unchecked<2>();
  for (std::size_t i = 0; i < line.poses.size(); ++i) {
    const Vec3& place = line.poses[i].position;
    const Eigen::Quaterniond& turn = line.poses[i].orientation;
    const std::array<double, 7> values = {place.x(), place.y(), place.z(), turn.w(), turn.x(), turn.y(), turn.z()};
    for (std::size_t k = 0; k < values.size(); ++k) {
      to(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k)) = values[k];
    }
  }
  return poses;
}

// One side of all pings: a view.
py::object side_of(const FlownLine& line, int side) {
  if (!line.facts->sonar.is_side_scan()) {
    throw py::attribute_error(fmt::format("{} has no sides; intensity holds its beams", line.facts->sonar.name));
  }
  return line.intensity[py::make_tuple(py::ellipsis(), side)];
}

std::shared_ptr<PythonPing> ping_of(const FlownLine& line, py::ssize_t number) {
  const auto index = static_cast<std::size_t>(number);
  auto ping = std::make_shared<PythonPing>();
  ping->number = line.first_number + index;
  ping->time = line.time[index];
  ping->world_from_sonar = line.poses[index];
  ping->bin_count = static_cast<int>(line.intensity.shape(1));
  ping->beam_count = static_cast<int>(line.intensity.shape(2));
  const float* values = line.intensity.data(number);
  ping->intensity.assign(values, values + line.intensity.shape(1) * line.intensity.shape(2));
  if (!line.soundings.empty()) {
    const auto first = line.soundings.begin() + number * ping->beam_count;
    ping->soundings.assign(first, first + ping->beam_count);
  }
  ping->facts = line.facts;
  return ping;
}

// [pings, beams]; None without soundings.
py::object soundings_of_line(const FlownLine& line) {
  if (line.soundings.empty()) {
    return py::none();
  }
  return py::array_t<Sounding>({line.intensity.shape(0), line.intensity.shape(2)}, line.soundings.data());
}

py::object item_of(const FlownLine& line, const py::object& number) {
  return items_of(number, line.intensity.shape(0), "the line", [&](py::ssize_t index) { return ping_of(line, index); });
}

void add_arrays(LineClass& line) {
  line.def_readonly("intensity", &FlownLine::intensity,
                    "Echo intensities, float32 [pings, bins, beams]; of a side-scan "
                    "sonar port and starboard.")
      .def_property_readonly(
          "port", [](const FlownLine& self) { return side_of(self, 0); }, "Those of the port side, [pings, bins].")
      .def_property_readonly(
          "starboard", [](const FlownLine& self) { return side_of(self, 1); },
          "Those of the starboard side, [pings, bins].")
      .def_property_readonly(
          "time", [](const FlownLine& self) { return doubles_of(self.time); },
          "Times of transmission, float64 [pings], in seconds.")
      .def_property_readonly("world_from_sonar", &poses_of,
                             "Poses of the housing, float64 [pings, 7]: x y z in metres, then the quaternion w x y z.")
      .def_property_readonly(
          "altitude", [](const FlownLine& self) { return doubles_of(self.altitude); },
          "Heights of the sonar above the nearest echo from below, by ground truth, float64 [pings], in metres; NaN "
          "without such an echo or without ground truth.")
      .def_property_readonly(
          "soundings", &soundings_of_line,
          "Soundings of a multibeam, a structured array [pings, beams] as Ping.soundings; else None.");
}

}  // namespace

void bind_line(py::module_& module) {
  LineClass line(module, "Line",
                 "A line of pings of a side-scan sonar or a multibeam: arrays, and a sequence of Pings without labels, "
                 "as functions of "
                 "lines take it: line[3], len(line), `for ping in line`.");
  add_arrays(line);
  line.def("__len__", [](const FlownLine& self) { return self.time.size(); })
      .def("__getitem__", &item_of, py::arg("number"),
           "The ping of that index from 0, from the end where negative; of a slice a list of pings. Raises IndexError.")
      .def("__iter__",
           [](const py::object& self) { return py::reinterpret_steal<py::object>(PySeqIter_New(self.ptr())); })
      .def_property_readonly(
          "sonar", [](const FlownLine& self) { return wrap(self.facts->sonar, kPingsSonar); },
          "Settings of its sonar, a read-only SonarConfig; its copy() can be changed.")
      .def("__repr__", [](const FlownLine& self) {
        const SonarConfig& sonar = self.facts->sonar;
        return fmt::format("<Line of {}: {} of {} x {}>", sonar.name, counted(self.time.size(), "ping"),
                           counted(self.intensity.shape(1), "bin"),
                           sonar.is_side_scan() ? "2 sides" : counted(self.intensity.shape(2), "beam"));
      });
}

}  // namespace insonify::python
