// bind_survey.cpp -- insonify.survey: what is made of lines of pings of side-scan sonars and multibeams, as arrays.

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>

#include "bind.h"
#include "convert.h"
#include "insonify/bed_heights.h"
#include "insonify/picture.h"
#include "insonify/sounding_grid_files.h"
#include "insonify/survey/bottom_track.h"
#include "insonify/survey/mosaic.h"
#include "insonify/survey/shadow_height.h"
#include "insonify/survey/slant_range.h"
#include "insonify/survey/sounding_grid.h"
#include "insonify/waterfall.h"

namespace insonify::python {
namespace {

// Pings of one sonar, with the labels and elevations that recorded ones read when asked.
struct PingLine {
  SonarConfig sonar;
  std::vector<Ping> pings;
};

template <typename Value>
void read_table(const py::object& ping, const char* name, std::vector<Value>& table) {
  const py::object given = ping.attr(name);
  if (table.empty() && !given.is_none()) {
    const auto array = py::array_t<Value, py::array::c_style | py::array::forcecast>::ensure(given);
    table.assign(array.data(), array.data() + array.size());
  }
}

PingLine line_from(const py::object& given, bool with_labels = false) {
  PingLine line;
  for (const py::handle item : given) {
    const auto object = py::reinterpret_borrow<py::object>(item);
    const PythonPing& ping = ping_from(object);
    line.sonar = ping.facts->sonar;
    line.pings.push_back(ping);
    if (with_labels) {
      read_table(object, "instance", line.pings.back().instance);
    }
  }
  if (line.pings.empty()) {
    throw Error("", "pings", " must hold at least one ping");
  }
  return line;
}

template <typename Value>
py::array_t<Value> table_of_rows(const std::vector<Value>& values, std::size_t columns) {
  py::array_t<Value> array({values.size() / columns, columns});
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}

BottomTrackOptions bottom_from(double first_return_angle, double least_range, double greatest_range) {
  return {.least_range = least_range, .greatest_range = greatest_range, .first_return_angle = first_return_angle};
}

// None, a number or one for each ping.
std::vector<double> altitudes_from(const py::object& given) {
  if (given.is_none()) {
    return {};
  }
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!array) {
    PyErr_Clear();
    throw Error("", "altitude", fmt::format(" = {} must be metres, one for each ping, or None", shown(given)));
  }
  return {array.data(), array.data() + array.size()};
}

void bind_track(py::module_& m) {
  py::class_<BottomTrack>(m, "BottomTrack", "The bottom under each ping of a line.")
      .def_property_readonly(
          "range", [](const BottomTrack& self) { return py::array_t<double>(py::cast(self.range)); },
          "First return of the bottom, mean of the sides [m], array [pings].")
      .def_property_readonly(
          "side_range",
          [](const BottomTrack& self) {
            return table_of_rows(self.side_range, self.side_range.size() / self.range.size());
          },
          "The same of each side [m], array [pings, sides].")
      .def_property_readonly(
          "altitude", [](const BottomTrack& self) { return py::array_t<double>(py::cast(self.altitude)); },
          "Height above the bottom [m], array [pings].")
      .def_property_readonly(
          "quality", [](const BottomTrack& self) { return py::array_t<double>(py::cast(self.quality)); },
          "How clearly a dark water column ends there, 0 to 1, array [pings]; below 0.3 the range is a guess.");
  m.def(
      "track_bottom",
      [](const py::object& pings, double first_return_angle, double least_range, double greatest_range) {
        const PingLine line = line_from(pings);
        return track_bottom(line.pings, line.sonar, bottom_from(first_return_angle, least_range, greatest_range));
      },
      py::arg("pings"), py::arg("first_return_angle") = std::numbers::pi / 2, py::arg("least_range") = 0.0,
      py::arg("greatest_range") = 1e5,
      "The first return of the bottom in every ping of a line: a BottomTrack. pings: any iterable, such as a "
      "recording. "
      "first_return_angle: angle below the horizontal at which it comes [rad], less than pi / 2 where beams do not "
      "reach straight down.");
  m.def(
      "true_altitude",
      [](const py::object& given) {
        Ping ping = ping_from(given);
        read_table(given, "elevation", ping.elevation);
        return true_altitude(ping, ping_from(given).facts->sonar);
      },
      py::arg("ping"), "The altitude by ground truth [m]. Raises Error for a ping without elevations.");
}

void bind_ranges(py::module_& m) {
  m.def(
      "slant_to_ground",
      [](const py::object& given, double altitude, double cell) {
        const PythonPing& ping = ping_from(given);
        const SonarConfig& sonar = ping.facts->sonar;
        GroundGrid grid = ground_grid_of(sonar);
        if (cell != 0) {
          grid = {cell, cell > 0 ? static_cast<int>(std::ceil(sonar.max_range / cell)) : 1};
        }
        return table_of_rows(slant_to_ground(ping, sonar, altitude, grid), static_cast<std::size_t>(ping.beam_count));
      },
      py::arg("ping"), py::arg("altitude"), py::arg("cell") = 0.0,
      "A ping on a level bed: mean intensities of cells of equal length, array [cells, sides], the first from below "
      "the "
      "sonar on; NaN where no bin lies. cell: their length [m], 0: that of the bins.");
  m.def("ground_range", py::vectorize(&ground_range), py::arg("slant_range"), py::arg("altitude"),
        "Range on a level bed of what is at a slant range: sqrt(r^2 - h^2) [m]; numbers or arrays.");
  m.def("height_from_shadow", py::vectorize(&height_from_shadow), py::arg("altitude"), py::arg("begin"), py::arg("end"),
        "Height of an object whose shadow begins at its foot, by slant ranges of its beginning and its end [m].");
  m.def("height_from_highlight", py::vectorize(&height_from_highlight), py::arg("altitude"), py::arg("top"),
        py::arg("end"), "The same by the slant range of the top that casts the shadow [m].");
  m.def("shadow_length", py::vectorize(&shadow_length), py::arg("altitude"), py::arg("height"), py::arg("ground_range"),
        "Length on a level bed of the shadow of an object [m].");
}

void bind_mosaic(py::module_& m) {
  py::class_<Mosaic> mosaic(m, "Mosaic", "The bed seen from above: arrays [rows, columns], rows from the north.");
  mosaic.def_readonly("west", &Mosaic::west, "x of the upper left corner [m].")
      .def_readonly("north", &Mosaic::north, "y of the upper left corner [m].")
      .def_readonly("cell", &Mosaic::cell, "Side of a cell [m].")
      .def_readonly("line_count", &Mosaic::line_count,
                    "Lines laid: those given, and one more for each of their pauses.");
  const auto add = [&](const char* name, auto member, const char* help) {
    mosaic.def_property_readonly(
        name,
        [member](const Mosaic& self) -> py::object {
          const auto& values = self.*member;
          return values.empty() ? py::object(py::none())
                                : table_of_rows(values, static_cast<std::size_t>(self.columns));
        },
        help);
  };
  add("intensity", &Mosaic::intensity, "Echo intensity, float32; NaN: not seen.");
  add("angle", &Mosaic::angle, "Angle below the horizontal at which a cell was seen [rad], float32; NaN: not seen.");
  add("line", &Mosaic::line, "Line that is shown, below line_count, uint16; NO_LABEL: none.");
  add("instance", &Mosaic::instance, "Ground truth, uint16; NO_LABEL: none. None without.");
  m.def(
      "make_mosaic",
      [](const py::object& lines, double cell, const std::string& rule, bool normalised, const py::object& altitudes,
         double first_return_angle) {
        std::vector<PingLine> held;
        for (const py::handle line : lines) {
          held.push_back(line_from(py::reinterpret_borrow<py::object>(line), true));
        }
        const py::list each = altitudes.is_none() ? py::list() : py::list(altitudes);
        if (!altitudes.is_none() && each.size() != held.size()) {
          throw Error("", "altitudes", fmt::format(" has {} entries for {} lines", each.size(), held.size()));
        }
        std::vector<MosaicLine> given;
        for (std::size_t i = 0; i < held.size(); ++i) {
          const PingLine& line = held[i];
          given.push_back({line.sonar, line.pings.size(), [&line](std::uint64_t ping) { return line.pings[ping]; },
                           altitudes_from(each.empty() ? py::object(py::none()) : py::object(each[i]))});
        }
        return make_mosaic(given, {.cell = cell,
                                   .rule = word_from<MosaicRule>(rule, "rule"),
                                   .normalised = normalised,
                                   .bottom = {.first_return_angle = first_return_angle}});
      },
      py::arg("lines"), py::arg("cell") = 0.0, py::arg("rule") = "best", py::arg("normalised") = false,
      py::arg("altitudes") = py::none(), py::arg("first_return_angle") = std::numbers::pi / 2,
      "Lays lines, each an iterable of pings, onto a grid of the bed: a Mosaic. cell: its side [m], 0: two bins. rule: "
      "which of several lines a cell shows, best (angle to the bed nearest to 30 degrees), latest or mean. normalised: "
      "the mean level at each angle taken out. altitudes: for each line metres, one for each ping, or None, which "
      "tracks "
      "them.");
}

// Soundings of lines of pings.
std::vector<PlacedSounding> soundings_from(const py::object& lines) {
  std::vector<PlacedSounding> placed;
  for (const py::handle line : lines) {
    for (const py::handle item : line) {
      const PythonPing& ping = ping_from(py::reinterpret_borrow<py::object>(item));
      if (ping.soundings.empty()) {
        throw Error("", "lines", fmt::format(": a ping of {} has no soundings", ping.facts->sonar.name));
      }
      place_soundings(ping.soundings, ping.world_from_sonar, placed);
    }
  }
  return placed;
}

std::optional<Detection> detection_from(const std::string& text) {
  return text == "both" ? std::nullopt : std::optional(word_from<Detection>(text, "detection"));
}

void bind_grid_errors(py::module_& m) {
  py::class_<GridErrors>(m, "GridErrors", "How the heights of a grid differ from its truth.")
      .def_readonly("cells", &GridErrors::cells, "Cells that have both.")
      .def_readonly("mean", &GridErrors::mean, "Mean of height - truth [m].")
      .def_readonly("deviation", &GridErrors::deviation, "Standard deviation of the difference [m].")
      .def_readonly("within_95", &GridErrors::within_95, "Difference that 95 % of the cells do not exceed [m].")
      .def_readonly("exclusive", &GridErrors::exclusive, "Share of cells within S-44's exclusive order, 0 to 1.")
      .def_readonly("special", &GridErrors::special, "Share within special order.")
      .def_readonly("order_1a", &GridErrors::order_1a, "Share within order 1a.");
}

void bind_sounding_grid(py::module_& m) {
  bind_grid_errors(m);
  py::class_<SoundingGrid> grid(m, "SoundingGrid", "Heights of the bed: arrays [rows, columns], rows from the north.");
  grid.def_readonly("west", &SoundingGrid::west, "x of the upper left corner [m].")
      .def_readonly("north", &SoundingGrid::north, "y of the upper left corner [m].")
      .def_readonly("cell", &SoundingGrid::cell, "Side of a cell [m].")
      .def_readonly("given", &SoundingGrid::given, "Soundings.")
      .def_readonly("left_out", &SoundingGrid::left_out, "Soundings left out by quality or detection.")
      .def_readonly("refused", &SoundingGrid::refused, "Outliers.")
      .def_readonly("filled", &SoundingGrid::filled, "Cells that were interpolated.");
  const auto add = [&](const char* name, auto member, const char* help) {
    grid.def_property_readonly(
        name,
        [member](const SoundingGrid& self) -> py::object {
          const auto& values = self.*member;
          return values.empty() ? py::object(py::none())
                                : table_of_rows(values, static_cast<std::size_t>(self.columns));
        },
        help);
  };
  add("height", &SoundingGrid::height, "z [m], float32; NaN: none.");
  add("uncertainty", &SoundingGrid::uncertainty, "Standard deviation of the height [m], float32; NaN.");
  add("count", &SoundingGrid::count, "Soundings that the height follows from, uint32.");
  add("truth", &SoundingGrid::truth, "Height of the scene [m], float32; NaN: none. None without.");
  grid.def("errors", &errors_of, py::arg("datum") = 0.0,
           "Compares heights with the truth: GridErrors, or None without. datum: height from which depths count [m].");
  grid.def(
      "write",
      [](const SoundingGrid& self, const py::object& path, const std::optional<std::pair<double, double>>& origin,
         double datum) {
        write_sounding_grid(
            self, path_from(path, "path"),
            {.origin = origin ? std::optional(GeographicPoint{origin->first, origin->second}) : std::nullopt,
             .datum = datum});
      },
      py::arg("path"), py::arg("origin") = py::none(), py::arg("datum") = 0.0,
      "Writes the cells in the format of the path's ending: .bag, .tif, .asc or .npz. origin: latitude and longitude "
      "of "
      "the world's origin [deg]. datum: height in the world from which heights in the file count [m].");
}

void bind_make_grid(py::module_& m) {
  m.def(
      "make_sounding_grid",
      [](const py::object& lines, double cell, const std::string& method, double outliers, int fill,
         double least_quality, const std::string& detection, const Scene* scene) {
        SoundingGrid made =
            make_sounding_grid(soundings_from(lines), {.cell = cell,
                                                       .method = word_from<GridMethod>(method, "method"),
                                                       .outliers = outliers,
                                                       .fill = fill,
                                                       .least_quality = least_quality,
                                                       .only = detection_from(detection)});
        if (scene != nullptr) {
          made.truth = true_heights(made, *scene);
        }
        return made;
      },
      py::arg("lines"), py::arg("cell") = 0.0, py::arg("method") = "mean", py::arg("outliers") = 4.0,
      py::arg("fill") = 0, py::arg("least_quality") = 0.0, py::arg("detection") = "both", py::arg("scene") = py::none(),
      "Grids the soundings of lines, each an iterable of a multibeam's pings: a SoundingGrid. cell: its side [m], 0: "
      "by "
      "the density of soundings. method: height of a cell, mean (weighted by uncertainties), median or shoal (the "
      "highest). outliers: soundings are refused that differ by more than so many standard deviations from their "
      "cell's "
      "median, 0: none. fill: widest gap that is interpolated [cells]. least_quality, detection (both, amplitude, "
      "phase): soundings that are used. scene: for `truth`.");
}

}  // namespace

void bind_survey(py::module_& module) {
  py::module_ m =
      module.def_submodule("survey",
                           "What is made of lines of side-scan pings: bottom, ranges on the bed, heights by "
                           "shadows, mosaics; and of a multibeam's: charts. docs/concepts/side-scan-products.md");
  bind_track(m);
  bind_ranges(m);
  bind_mosaic(m);
  bind_sounding_grid(m);
  bind_make_grid(m);
}

}  // namespace insonify::python
