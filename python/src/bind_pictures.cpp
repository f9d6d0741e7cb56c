// bind_pictures.cpp -- pictures of pings as arrays.

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include <cmath>

#include "arguments.h"
#include "bind.h"
#include "convert.h"
#include "insonify/files.h"
#include "insonify/picture.h"
#include "insonify/printable.h"
#include "insonify/waterfall.h"

namespace insonify::python {
namespace {

py::array_t<std::uint8_t> array_of(const Picture& picture) {
  py::array_t<std::uint8_t> array({picture.height, picture.width, 3});
  std::copy(picture.rgb.begin(), picture.rgb.end(), array.mutable_data());
  return array;
}

struct Looks {
  py::object levels;
  std::string colour_map, scale = {};
  int height = 720;
  bool annotations = true, counts = false;
};

// The counts of a ping, as `insonify run --counts` draws them.
Picture drawn_counts(const py::object& given, const Looks& looks,
                     Picture (*draw)(const Ping&, const SonarConfig&, const Display&)) {
  if (!looks.levels.is_none() || !looks.scale.empty()) {
    throw Error(
        "", "counts",
        fmt::format(" are drawn as they are, linear, without {}", looks.levels.is_none() ? "a scale" : "levels"));
  }
  const PythonPing& ping = ping_from(given);
  Display display = counts_display(ping.facts->sonar);
  display.colour_map = colour_map_from_name(looks.colour_map);
  display.height = looks.height;
  display.annotations = looks.annotations;
  Ping counted = ping;
  if (const py::object counts = given.attr("counts"); !counts.is_none()) {  // Read now for a recorded ping.
    const auto array = py::array_t<std::uint16_t, py::array::c_style>::ensure(counts);
    counted.counts.assign(array.data(), array.data() + array.size());
  }
  return draw(counts_as_intensities(std::move(counted)), ping.facts->sonar, display);
}

// The display with which `insonify run` draws pings, but for levels that are fitted.
Display display_of(const SonarFacts& facts, const Looks& looks) {
  Display display = usual_display(facts.model, facts.receiver);
  display.colour_map = colour_map_from_name(looks.colour_map);
  display.height = looks.height;
  display.annotations = looks.annotations;
  if (looks.scale == "linear" || looks.scale == "db") {
    display.scale = looks.scale == "db" ? Scale::kDecibel : Scale::kLinear;
  } else if (!looks.scale.empty()) {
    throw Error("", "scale", fmt::format(" = {} must be linear or db", looks.scale));
  }
  if (!looks.levels.is_none()) {
    const auto [low, high] = levels_from(looks.levels);
    display.scale = Scale::kDecibel;
    display.of_one = facts.model == EchoModel::kPaper;
    display.full_scale = std::pow(10, high / 10);
    display.floor_db = low - high;
  }
  return display;
}

// The intensities that are drawn of a ping.
Ping shown_by(const PythonPing& ping, const Display& display) {
  const SonarFacts& facts = *ping.facts;
  return facts.model == EchoModel::kPaper ? static_cast<const Ping&>(ping)
                                          : raised_by_range(ping, facts.sonar, display.raised_per_decade);
}

Picture drawn(const PythonPing& ping, const Looks& looks,
              Picture (*draw)(const Ping&, const SonarConfig&, const Display&)) {
  const SonarFacts& facts = *ping.facts;
  Display display = display_of(facts, looks);
  const Ping shown = shown_by(ping, display);
  if (looks.levels.is_none() && facts.model == EchoModel::kCalibrated) {
    display.full_scale = fitting_full_scale(intensities_to_fit(shown, facts.sonar));
  }
  return draw(shown, facts.sonar, display);
}

// Pings of one sonar as rows.
Picture drawn_waterfall(const py::iterable& pings, const Looks& looks, const WaterfallOptions& options) {
  std::optional<Waterfall> waterfall;
  std::shared_ptr<const SonarFacts> facts;
  Display display;
  for (const py::handle item : pings) {
    const PythonPing& ping = ping_from(py::reinterpret_borrow<py::object>(item));
    if (!waterfall) {
      facts = ping.facts;
      display = display_of(*facts, looks);
      waterfall.emplace(facts->sonar, options);
    }
    waterfall->add(shown_by(ping, display));
  }
  if (!waterfall) {
    throw Error("", "pings", " must hold at least one ping");
  }
  if (looks.levels.is_none() && facts->model == EchoModel::kCalibrated) {
    display.full_scale = waterfall->fitting_full_scale();
  }
  return waterfall->draw(display);
}

Looks looks_from(const py::object& levels, const py::object& colour_map, const py::object& scale,
                 const py::object& height, const py::object& annotations, const py::object& color_map) {
  Looks looks{.levels = levels, .colour_map = colour_map_name(colour_map, color_map)};
  if (!scale.is_none()) {
    from_python(scale, "scale", 1, looks.scale);
  }
  from_python(height, "height", 1, looks.height);
  from_python(annotations, "annotations", 1, looks.annotations);
  return looks;
}

// The defaults of draw_fan(), for Ping.plot(): intensities [bins, beams], their gain in dB per decade of range, the
// fitted full scale, and the darkest level below that [dB].
py::tuple usually_shown(const PythonPing& ping) {
  const SonarFacts& facts = *ping.facts;
  const Display display = usual_display(facts.model, facts.receiver);
  const Ping shown = raised_by_range(ping, facts.sonar, display.raised_per_decade);
  const double full_scale =
      facts.model == EchoModel::kPaper ? 1 : fitting_full_scale(intensities_to_fit(shown, facts.sonar));
  py::array_t<float> intensity({shown.bin_count, shown.beam_count});
  std::copy(shown.intensity.begin(), shown.intensity.end(), intensity.mutable_data());
  return py::make_tuple(intensity, display.raised_per_decade, full_scale, display.floor_db);
}

void add_drawing(py::module_& module, const char* name,
                 Picture (*draw)(const Ping&, const SonarConfig&, const Display&), const char* what) {
  const std::string help =
      std::string(what) +
      "\n\nReturns an array uint8 [height, width, 3]. levels: colour range (low, high) in dB as on the colour bar, "
      "None for what fits this ping; for a film give the same to all. colour_map, or color_map: inferno (which None "
      "stands for), copper, grey or blue. scale: linear or db; None: db in the calibrated model, in which intensities "
      "are raised by 30 dB per decade of range. counts: draw the counts instead, from 0 to the greatest, where the "
      "ping has any (receiver.counts).";
  module.def(
      name,
      [draw](const py::object& ping, const py::object& levels, const py::object& colour_map, const py::object& scale,
             const py::object& height, const py::object& annotations, const py::object& color_map,
             const py::object& counts) {
        Looks looks = looks_from(levels, colour_map, scale, height, annotations, color_map);
        from_python(counts, "counts", 1, looks.counts);
        return array_of(looks.counts ? drawn_counts(ping, looks, draw) : drawn(ping_from(ping), looks, draw));
      },
      py::arg("ping"), py::arg("levels") = py::none(), py::arg("colour_map") = py::none(),
      py::arg("scale") = py::none(), py::arg("height") = 720, py::arg("annotations") = true, py::kw_only(),
      py::arg("color_map") = py::none(), py::arg("counts") = false, help.c_str());
}

void add_waterfall(py::module_& module) {
  module.def(
      "draw_waterfall",
      [](const py::iterable& pings, const py::object& levels, const py::object& colour_map, const py::object& scale,
         const py::object& height, const py::object& annotations, const py::object& corrected,
         const py::object& normalised, const py::object& to_scale, const py::object& along,
         const py::object& altitude_line, const py::object& color_map) {
        WaterfallOptions options;
        from_python(corrected, "corrected", 1, options.corrected);
        from_python(normalised, "normalised", 1, options.normalised);
        from_python(to_scale, "to_scale", 1, options.to_scale);
        from_python(altitude_line, "altitude_line", 1, options.altitude_line);
        std::string word;
        from_python(along, "along", 1, word);
        options.along = word_from<AlongTrack>(word, "along");
        return array_of(
            drawn_waterfall(pings, looks_from(levels, colour_map, scale, height, annotations, color_map), options));
      },
      py::arg("pings"), py::arg("levels") = py::none(), py::arg("colour_map") = py::none(),
      py::arg("scale") = py::none(), py::arg("height") = 720, py::arg("annotations") = true, py::kw_only(),
      py::arg("corrected") = false, py::arg("normalised") = false, py::arg("to_scale") = false,
      py::arg("along") = "ping", py::arg("altitude_line") = true, py::arg("color_map") = py::none(),
      "The pings of a side-scan sonar as rows, the newest at the top, port to the left, as `insonify run` draws "
      "them.\n\n"
      "Returns an array uint8 [height, width, 3]. pings: an iterable of Pings of one sonar, such as a Line or an open "
      "recording. levels, colour_map, scale: as of draw_fan(). corrected: on ground ranges of a level bed instead of "
      "slant ranges. normalised: the mean level at each angle taken out. to_scale: as many metres a pixel along the "
      "track as across; the height follows. along: what rows are labelled by, ping, time or distance. altitude_line: "
      "draw the tracked first return, on slant ranges.");
}

}  // namespace

void bind_pictures(py::module_& module) {
  add_waterfall(module);
  add_drawing(module, "draw_fan", &draw_fan, "The fan as seen from above, acoustic axis up, port to the left.");
  add_drawing(module, "draw_polar", &draw_polar, "The table of beams x bins: beams across, range upwards.");
  module.def("_usually_shown", &usually_shown, py::arg("ping"));
  module.def(
      "write_png",
      [](const py::object& path, const py::object& given) {
        constexpr const char* kExpected = "an array uint8 [height, width, 3] or, for grey, [height, width]";
        if (!py::isinstance<py::array>(given)) {
          throw Error("", "picture", fmt::format(" = {} must be {}", shown(given), kExpected));
        }
        const auto pixels = py::array_t<std::uint8_t, py::array::c_style>::ensure(given);
        const bool is_grey = pixels && pixels.ndim() == 2;
        if (!py::isinstance<py::array_t<std::uint8_t>>(given) ||
            !(is_grey || (pixels.ndim() == 3 && pixels.shape(2) == 3))) {
          throw Error("", "picture",
                      fmt::format(" must be {}, not {} {}", kExpected, py::str(given.attr("dtype")).cast<std::string>(),
                                  shown(py::list(given.attr("shape")))));
        }
        const std::filesystem::path file = path_from(path, "path");
        std::string ending = file.extension().string();
        std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
        if (ending != ".png") {
          throw Error("", "path", fmt::format(" = {} must end in .png", printable(file.string())));
        }
        Picture picture{static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)), {}};
        picture.rgb.reserve(static_cast<std::size_t>(pixels.size()) * (is_grey ? 3 : 1));
        for (py::ssize_t i = 0; i < pixels.size(); ++i) {
          picture.rgb.insert(picture.rgb.end(), is_grey ? 3 : 1, pixels.data()[i]);
        }
        write_png(file, picture);
      },
      py::arg("path"), py::arg("picture"),
      "Writes a picture, an array uint8 [height, width, 3] or, for grey, [height, width], to a file whose name ends in "
      ".png.");
}

}  // namespace insonify::python
