// bind_recording.cpp -- insonify.RecordedPings, which reads recordings.

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <span>

#include "bind.h"
#include "held.h"
#include "insonify/files.h"
#include "insonify/printable.h"
#include "items.h"
#include "ping_tables.h"
#include "python_recording.h"
#include "python_simulator.h"
#include "python_types.h"

namespace insonify::python {
namespace {

std::shared_ptr<PythonPing> recorded_ping(const std::shared_ptr<PythonRecording>& recording, py::ssize_t number) {
  auto ping = std::make_shared<PythonPing>();
  static_cast<Ping&>(*ping) = recording->pings.ping(static_cast<std::uint64_t>(number));
  ping->facts = recording->known();
  ping->source = recording;
  return ping;
}

// rec[3] is a ping, rec[1:9:2] a list of pings.
py::object recorded_item(const std::shared_ptr<PythonRecording>& recording, const py::object& number) {
  return items_of(number, static_cast<py::ssize_t>(recording->ping_count()), "the recording",
                  [&](py::ssize_t index) { return recorded_ping(recording, index); });
}

py::dtype dtype_of(NumberType type) {
  switch (type) {
    case NumberType::kFloat32:
      return py::dtype::of<float>();
    case NumberType::kFloat64:
      return py::dtype::of<double>();
    case NumberType::kUint8:
      return py::dtype::of<std::uint8_t>();
    case NumberType::kUint16:
      return py::dtype::of<std::uint16_t>();
    case NumberType::kInt64:
      return py::dtype::of<std::int64_t>();
  }
  return py::dtype::of<double>();
}

const StoredTable& find_table(const PythonRecording& self, const std::string& name) {
  const StoredTable* table = self.tables.find(name);
  if (table == nullptr) {
    throw Error("", "", fmt::format("the recording has no table {}", name));
  }
  return *table;
}

// (dtype, shape, unit, description).
py::tuple table_facts(const PythonRecording& self, const std::string& name) {
  const StoredTable& table = find_table(self, name);
  py::tuple shape(table.shape.size());
  for (std::size_t axis = 0; axis < table.shape.size(); ++axis) {
    shape[axis] = py::int_(axis == 0 && table.by_ping ? self.ping_count() : table.shape[axis]);
  }
  return py::make_tuple(dtype_of(table.type), shape, table.unit, table.description);
}

// A block of a table; slices are (start, count, step), one for each axis.
py::array read_block(const PythonRecording& self, const std::string& name,
                     const std::vector<std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>>& slices) {
  const StoredTable& table = find_table(self, name);
  std::vector<TableSlice> wanted;
  std::vector<py::ssize_t> shape;
  for (const auto& [start, count, step] : slices) {
    wanted.push_back({start, count, step});
    shape.push_back(static_cast<py::ssize_t>(count));
  }
  py::array block(dtype_of(table.type), shape);
  self.tables.read(table, wanted,
                   std::span(static_cast<std::byte*>(block.mutable_data()), static_cast<std::size_t>(block.nbytes())));
  return block;
}

// A whole table of an axis; None if the file does not have it.
py::object whole_table(const PythonRecording& self, const std::string& name) {
  const StoredTable* table = self.tables.find(name);
  if (table == nullptr) {
    return py::none();
  }
  std::vector<std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>> slices;
  for (std::size_t axis = 0; axis < table->shape.size(); ++axis) {
    slices.emplace_back(0, axis == 0 && table->by_ping ? self.ping_count() : table->shape[axis], 1);
  }
  return read_block(self, name, slices);
}

// All soundings, [pings, beams]; None without any.
py::object all_soundings(const PythonRecording& self) {
  if (!self.pings.has_soundings()) {
    return py::none();
  }
  py::array_t<Sounding> soundings(
      {static_cast<py::ssize_t>(self.ping_count()), static_cast<py::ssize_t>(self.pings.beam_count())});
  Sounding* to = soundings.mutable_data();
  for (std::uint64_t ping = 0; ping < self.ping_count(); ++ping) {
    to = std::ranges::copy(self.pings.soundings(ping), to).out;
  }
  return soundings;
}

using RecordedClass = py::class_<PythonRecording, std::shared_ptr<PythonRecording>>;

// Tables of pings, of which only the indexed part is read, and the names of those in the file.
void add_layers(py::module_& module, RecordedClass& recorded) {
  std::vector<std::string> names;
  visit_tables([&](const char* name, auto member, const char* help) {
    names.emplace_back(name);
    recorded.def_property_readonly(
        name,
        [name](const py::object& self) -> py::object {
          if (self.cast<const PythonRecording&>().tables.find(name) == nullptr) {
            return py::none();
          }
          return py::module_::import("insonify._layers").attr("RecordedLayer")(self, name);
        },
        (std::string(help) + " A RecordedLayer [pings, bins, beams ...]; None if it was not recorded.").c_str());
    describe(module, "RecordedPings", name, {number_name<ValueOf<decltype(member)>>(), ""});
  });
  recorded.def_property_readonly(
      "layers",
      [names](const PythonRecording& self) {
        py::list there;
        for (const std::string& name : names) {
          if (self.tables.find(name) != nullptr) {
            there.append(name);
          }
        }
        return there;
      },
      "Names of the layers that the recording has: \"intensity\", \"instance\" ...");
  recorded.def("_facts", &table_facts, py::arg("name"));
  recorded.def("_read", &read_block, py::arg("name"), py::arg("slices"));
}

void add_axes(RecordedClass& recorded) {
  const auto add = [&](const char* name, const char* help) {
    recorded.def_property_readonly(
        name, [name](const PythonRecording& self) { return whole_table(self, name); }, help);
  };
  add("time", "Times of transmission, float64 [pings], in seconds.");
  add("world_from_sonar", "Poses of the housing, float64 [pings, 7]: x y z in metres, then the quaternion w x y z.");
  add("head_angle", "Angles of a scanning head, float64 [pings], in radians, positive to port; else None.");
  add("altitude",
      "Heights above the bed that a side-scan file stores, float64 [pings], in metres, 0 where unknown; else None.");
  add("sound_speed",
      "Sound speeds that a side-scan file stores, float64 [pings], in m/s, NaN where unknown; else None.");
  recorded.def_property_readonly(
      "soundings", &all_soundings,
      "Soundings of all pings of a multibeam, a structured array [pings, beams] as Ping.soundings; else None.");
  add("range", "Centre of each bin, float64 [bins], in metres.");
  add("azimuth", "Centre of each beam, float64 [beams], in radians, positive to port, falling.");
  recorded
      .def_property_readonly(
          "origin",
          [](const PythonRecording& self) {
            const std::optional<GeographicPoint> origin = self.pings.origin();
            return origin ? std::optional(std::pair(origin->latitude, origin->longitude)) : std::nullopt;
          },
          "Latitude and longitude of the world's origin in degrees, where a survey file says them; else None.")
      .def_property_readonly(
          "instance_names", [](const PythonRecording& self) { return self.tables.texts("instance_names"); },
          "Names by index in `instance`.")
      .def_property_readonly(
          "material_names", [](const PythonRecording& self) { return self.tables.texts("material_names"); },
          "Names by index in `material`.")
      .def_property_readonly(
          "markers",
          [](const PythonRecording& self) {
            std::vector<std::map<std::string, py::object>> markers;
            for (const Marker& marker : recording_info(self.path).markers) {
              const Vec3& at = marker.position;
              markers.push_back({{"name", py::str(marker.name)},
                                 {"position", py::make_tuple(at.x(), at.y(), at.z())},
                                 {"time", py::float_(marker.time)},
                                 {"sonar", py::str(marker.sonar)},
                                 {"ping", py::int_(marker.ping)}});
              if (marker.range) {
                markers.back()["range"] = py::float_(*marker.range);
              }
              if (!marker.side.empty()) {
                markers.back()["side"] = py::str(marker.side);
              }
            }
            return markers;
          },
          "What an operator has marked in the viewer, a list of dicts: name; position, x, y and z in the world in "
          "metres; and time in seconds, name of the sonar and number of the ping on which it was marked; "
          "where they are known, range, its slant range on that ping in metres, and side, port or starboard.");
}

}  // namespace

void bind_recording(py::module_& module) {
  RecordedClass recorded(
      module, "RecordedPings",
      "A recording's pings, read on demand: rec[3], len(rec), `for ping in rec`.\n\n"
      "path: an HDF5 or MCAP file as `insonify run` writes, perhaps still growing: it has the pings that it had when "
      "it was opened; or a foreign file: see insonify.open(). sonar: which one of a file that holds several. Raises "
      "Error for a file that is none, and "
      "for a sonar that it does not have, naming those that it has.\n\n"
      "MCAP has no ground truth, and intensities as levels: rec.intensity.description says their steps, 0.0009 dB by "
      "default; 0 below the lowest level, clipped at the highest.\n\n"
      "Layers such as rec.intensity and rec.instance are RecordedLayers: rec.instance[3, 100:200] reads that much and "
      "no more, np.asarray(rec.instance) reads all.");
  recorded
      .def(py::init([](const py::object& path, const std::optional<std::string>& sonar) {
             return std::make_shared<PythonRecording>(path_from(path, "path"), sonar.value_or(""));
           }),
           py::arg("path"), py::arg("sonar") = py::none())
      .def("__len__", [](const PythonRecording& self) { return self.ping_count(); })
      .def("__getitem__", &recorded_item, py::arg("number"),
           "The ping of that number from 0, from the end where negative; of a slice a list of pings. Their tables are "
           "read when they are asked for. Raises IndexError.")
      .def("__iter__",
           [](const py::object& self) { return py::reinterpret_steal<py::object>(PySeqIter_New(self.ptr())); })
      .def_property_readonly(
          "shape",
          [](const PythonRecording& self) {
            return py::make_tuple(self.ping_count(), self.pings.bin_count(), self.pings.beam_count());
          },
          "(pings, bins, beams).")
      .def_property_readonly(
          "sonar", [](PythonRecording& self) { return wrap(self.known()->sonar, kPingsSonar); },
          "Settings of its sonar, a read-only SonarConfig; its copy() can be changed.")
      .def_property_readonly(
          "model", [](const PythonRecording& self) { return self.pings.model(); },
          "calibrated or paper; \"\" if unknown.")
      .def_property_readonly(
          "full_scale", [](const PythonRecording& self) { return self.pings.full_scale(); },
          "The greatest count where intensities are integers: 255 for 8 bits; else 1.")
      .def_property_readonly(
          "notes",
          [](const PythonRecording& self) {
            std::vector<std::string> notes = self.pings.notes();
            for (std::string& text : self.pings.assumed()) {
              notes.push_back(std::move(text));
            }
            return notes;
          },
          "Of a foreign file: what was chosen of it or left out, and what it does not say and its settings assume.")
      .def_property_readonly(
          "state", [](const PythonRecording& self) { return state_word(self.state); },
          "How it ended, as it was when it was opened: \"whole\"; \"growing\" while a run writes it; \"unfinished\" "
          "where that run was killed; \"disk_full\" where it ends early because the disk was full.")
      .def("_unfinished_text",
           [](const PythonRecording& self) {
             const bool ends_early =
                 self.state == RecordingState::kUnfinished || self.state == RecordingState::kDiskFull;
             return ends_early ? unfinished_text(self.path, recording_info(self.path)) : std::string();
           })
      .def(py::pickle(
          [](const PythonRecording& self) {
            return py::make_tuple(std::filesystem::absolute(self.path).string(), self.pings.sonar());
          },
          [](const py::tuple& state) {
            return std::make_shared<PythonRecording>(path_from(state[0], "path"), state[1].cast<std::string>());
          }))
      .def("__repr__", [](const PythonRecording& self) {
        return fmt::format("<RecordedPings of {}: {} of {} x {}>", self.pings.sonar(),
                           counted(self.ping_count(), "ping"), counted(self.pings.bin_count(), "bin"),
                           counted(self.pings.beam_count(), "beam"));
      });
  add_layers(module, recorded);
  add_axes(recorded);
}

}  // namespace insonify::python
