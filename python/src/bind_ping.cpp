// bind_ping.cpp -- insonify.Ping: tables as arrays that share the ping's memory.

#include <fmt/format.h>
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>

#include "bind.h"
#include "held.h"
#include "insonify/printable.h"
#include "insonify/survey/bottom_detection.h"
#include "ping_tables.h"
#include "python_recording.h"
#include "python_types.h"

namespace insonify::python {
namespace {

using PingClass = py::class_<PythonPing, std::shared_ptr<PythonPing>>;

// A table [bins, beams] or [bins, beams, depth] as an array that keeps the ping alive; None if it is empty.
template <typename Value>
py::object table(const py::object& owner, const Ping& ping, const std::vector<Value>& values) {
  const std::size_t cells = static_cast<std::size_t>(ping.bin_count) * ping.beam_count;
  if (values.empty() || cells == 0) {
    return py::none();
  }
  std::vector<py::ssize_t> shape = {ping.bin_count, ping.beam_count};
  if (const std::size_t depth = values.size() / cells; depth > 1) {
    shape.push_back(static_cast<py::ssize_t>(depth));
  }
  return py::array_t<Value>(shape, values.data(), owner);
}

template <typename Value>
void add_table(PingClass& ping, const char* name, std::vector<Value> Ping::*member, const char* help) {
  ping.def_property_readonly(
      name,
      [name, member](const py::object& self) {
        auto& ping = self.cast<PythonPing&>();
        if ((ping.*member).empty() && ping.source != nullptr) {
          read_table(*ping.source, ping.number, name, ping.*member);
        }
        return table(self, ping, ping.*member);
      },
      help);
}

using Soundings = py::array_t<Sounding, py::array::c_style>;

// [beams], sharing the ping's memory; None without soundings.
py::object soundings_of(const py::object& self) {
  const auto& ping = self.cast<const PythonPing&>();
  return ping.soundings.empty()
             ? py::object(py::none())
             : Soundings(static_cast<py::ssize_t>(ping.soundings.size()), ping.soundings.data(), self);
}

py::array_t<double> sounding_positions(const PythonPing& ping, double range_scale, const SoundSpeedProfile* profile,
                                       double surface) {
  if (profile != nullptr && range_scale != 1) {
    throw Error("", "range_scale", " has no effect with a profile");
  }
  py::array_t<double> positions({static_cast<py::ssize_t>(ping.soundings.size()), py::ssize_t{3}});
  double* to = positions.mutable_data();
  for (const Sounding& sounding : ping.soundings) {
    const Vec3 position = profile == nullptr ? position_of(sounding, ping.world_from_sonar, range_scale)
                                             : position_of(sounding, ping.world_from_sonar, *profile, surface,
                                                           ping.facts->sonar.assumed_sound_speed.value());
    to = std::copy(position.begin(), position.end(), to);
  }
  return positions;
}

void add_soundings(PingClass& ping) {
  PYBIND11_NUMPY_DTYPE(Sounding, azimuth, range, uncertainty, quality, intensity, snippet_begin, snippet_end,
                       detection);
  ping.def_property_readonly(
          "soundings", &soundings_of,
          "The bottom in each beam of a multibeam, a structured array [beams]; None for other sonars. azimuth: of the "
          "beam [rad], positive to port. range: slant range, as the sonar shows ranges [m]; NaN: no bottom found. "
          "uncertainty: standard deviation of the range [m]. quality: log10(range / uncertainty). intensity: mean of "
          "the bins from snippet_begin to before snippet_end. detection: 0 none, 1 by amplitude, 2 by phase.")
      .def(
          "sounding_positions", &sounding_positions, py::arg("range_scale") = 1.0, py::arg("profile") = py::none(),
          py::arg("surface") = 0.0,
          "Positions of the soundings in the world, float64 [beams, 3] in metres; NaN where no bottom was found. Along "
          "straight rays, or those of a profile, which need not be that of the water.\n\n"
          "range_scale: true range / range shown, the true sound speed / sonar.assumed_sound_speed. profile: an "
          "acoustics.SoundSpeedProfile. surface: height of the water's surface, the profile's depth 0 [m].");
}

// For pickle and copy: all of the ping's data, including a recorded one's tables that were not read yet.
py::tuple pickled_ping(const py::object& self) {
  const auto& ping = self.cast<const PythonPing&>();
  py::dict tables;
  visit_tables([&](const char* name, auto, const char*) {
    if (const py::object values = self.attr(name); !values.is_none()) {
      tables[name] = values;
    }
  });
  return py::make_tuple(ping.number, ping.time, ping.world_from_sonar, ping.head_angle, ping.bin_count, ping.beam_count,
                        tables, wrap(ping.facts->sonar), std::string(word_of(ping.facts->model)),
                        wrap(ping.facts->receiver), ping.facts->names->instances, ping.facts->names->materials,
                        soundings_of(self));
}

std::shared_ptr<PythonPing> unpickled_ping(const py::tuple& state) {
  auto ping = std::make_shared<PythonPing>();
  ping->number = state[0].cast<std::uint64_t>();
  ping->time = state[1].cast<double>();
  ping->world_from_sonar = state[2].cast<Pose>();
  ping->head_angle = state[3].cast<double>();
  ping->bin_count = state[4].cast<int>();
  ping->beam_count = state[5].cast<int>();
  const py::dict tables = state[6];
  visit_tables([&](const char* name, auto member, const char*) {
    using Value = ValueOf<decltype(member)>;
    if (tables.contains(name)) {
      const py::array_t<Value, py::array::c_style> values(tables[name]);
      ((*ping).*member).assign(values.data(), values.data() + values.size());
    }
  });
  if (!state[12].is_none()) {
    const auto soundings = state[12].cast<Soundings>();
    ping->soundings.assign(soundings.data(), soundings.data() + soundings.size());
  }
  const LabelNames names{state[10].cast<std::vector<std::string>>(), state[11].cast<std::vector<std::string>>()};
  SonarFacts facts{.sonar = unwrap<SonarConfig>(state[7], "sonar"),
                   .receiver = unwrap<ReceiverConfig>(state[9], "receiver"),
                   .names = std::make_shared<LabelNames>(names)};
  EnumWord model{detail::word_list<EchoModel>(), 0};
  from_python(state[8], "model", 1, model);
  facts.model = words_of<EchoModel>()[model.index].second;
  ping->facts = std::make_shared<SonarFacts>(std::move(facts));
  return ping;
}

}  // namespace

const PythonPing& ping_from(const py::object& given) {
  if (!py::isinstance<PythonPing>(given)) {
    throw Error("", "ping", fmt::format(" = {} must be a Ping", shown(given)));
  }
  return given.cast<const PythonPing&>();
}

void bind_ping(py::module_& module) {
  PingClass ping(module, "Ping",
                 "One ping. Tables are arrays [bins, beams] that share the ping's memory and keep it alive: beam 0 is "
                 "the one furthest to port, bin 0 the nearest. Tables that were not requested are None.");
  ping.def_readonly("number", &PythonPing::number, "From 0.")
      .def_readonly("time", &PythonPing::time, "Time of transmission [s].")
      .def_readonly("pose", &PythonPing::world_from_sonar, "Pose of the sonar's housing in the world.")
      .def_readonly("head_angle", &PythonPing::head_angle,
                    "Angle of a scanning head in the housing, positive to port [rad]; else 0.")
      .def_property_readonly(
          "shape", [](const PythonPing& self) { return py::make_tuple(self.bin_count, self.beam_count); },
          "(bins, beams).")
      .def_property_readonly(
          "sonar", [](const PythonPing& self) { return wrap(self.facts->sonar, kPingsSonar); },
          "Settings of its sonar, a read-only SonarConfig; its copy() can be changed.")
      .def_property_readonly(
          "model", [](const PythonPing& self) { return std::string(word_of(self.facts->model)); },
          "Model of the echo: calibrated or paper.")
      .def_property_readonly(
          "instance_names", [](const PythonPing& self) { return self.facts->names->instances; },
          "Names of the scene's objects by index in `instance`, when the ping was made.")
      .def_property_readonly(
          "material_names", [](const PythonPing& self) { return self.facts->names->materials; },
          "Names of materials by index in `material`, when the ping was made.");
  visit_tables([&](const char* name, auto member, const char* help) {
    add_table(ping, name, member, help);
    const std::string type = number_name<ValueOf<decltype(member)>>();
    describe(module, "Ping", name, {type, ""});
  });
  add_soundings(ping);
  ping.def(
      "plot",
      [](const py::object& self, const py::args& args, const py::kwargs& options) {
        return py::module_::import("insonify._plot").attr("plot")(self, *args, **options);
      },
      "plot(kind='fan', levels=None, ax=None, colour_map=None, *, color_map=None, counts=False)\n\n"
      "Draws the ping with matplotlib. Returns the axes.\n\n"
      "kind: \"fan\", in metres, or \"polar\", azimuth [deg] and range [m]. levels: colour range (low, high) in dB as "
      "on the colour bar; None: fitted to this ping, as in insonify.fan(). ax: axes to draw in; None: a new figure. "
      "colour_map, or color_map: a name that matplotlib knows; None for inferno. counts: draw the counts instead, from "
      "0 to the greatest, where the ping has any (receiver.counts).\n\n"
      "Raises Error if there are none, ImportError without matplotlib.");
  ping.def(py::pickle(&pickled_ping, &unpickled_ping));
  ping.def("__repr__", [](const PythonPing& self) {
    return fmt::format("<Ping {} at {:.6g} s, {} x {}>", self.number, self.time, counted(self.bin_count, "bin"),
                       counted(self.beam_count, "beam"));
  });
  module.attr("NO_LABEL") = kNoLabel;
}

}  // namespace insonify::python
