// bind_configs.cpp -- the classes of a scenario and its parts.

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "arguments.h"
#include "bind.h"
#include "bind_config.h"
#include "insonify/acoustics/sound_speed_profile.h"
#include "insonify/describe.h"
#include "insonify/files.h"
#include "insonify/scenario.h"
#include "insonify/scene_files.h"

namespace insonify::python {
namespace {

// The text of `insonify describe` about a section.
std::string about(const std::string& section) {
  for (const SectionDescription& one : describe_scenario()) {
    if (one.name == section) {
      return one.help;
    }
  }
  return "";
}

template <typename ValueOf>
py::array_t<double> array_of(int count, const ValueOf& value_of) {
  py::array_t<double> values(count);
  for (int i = 0; i < count; ++i) {
    values.mutable_at(i) = value_of(i);
  }
  return values;
}

// The name of the preset has no keyword: `name` is a field of the sonar.
py::object preset(const py::args& given, const py::kwargs& keywords) {
  py::dict fields = keywords.attr("copy")();
  if (given.empty() || given.size() + fields.contains("mode") > 2) {
    throw py::type_error("preset() takes the name of a preset, a mode and fields by keyword");
  }
  fields["preset"] = given[0];
  if (given.size() == 2) {
    fields["mode"] = given[1];
  }
  return make_sonar(fields);
}

void add_receivers_and_sonars(py::module_& module) {
  ConfigClass<Sampling>(module, "Sampling", "How finely the insonified sector is sampled.");
  ConfigClass<ReceiverConfig>(module, "ReceiverConfig", about("receiver"));
  ConfigClass<SonarConfig> sonar(
      module, "SonarConfig",
      "An imaging sonar seen as a fan of beams cut into range bins.\n\n"
      "preset: name of an instrument to begin with, in its mode `mode`, as SonarConfig.preset(). When max_range, "
      "min_range or assumed_sound_speed changes, bin_count, ping_period, pulse_duration and sampling.rows that had "
      "followed from the range follow it: of a preset's sonar, and of Simulator.sonar().copy().");
  sonar->def_static("preset", &preset,
                    "preset(name, /, mode='', **fields)\n\nThe sonar of a shipped or own preset, over the instrument's "
                    "longest range. Keywords change fields; bin_count, ping_period and pulse_duration are those that "
                    "the instrument has over the range window, unless they are given, by assumed_sound_speed or else "
                    "that of Water(). insonify.presets() has them all. Raises Error for an unknown name or "
                    "mode, TypeError for an unknown field; warns of what the instrument cannot have.");
  sonar->def(
      "validate", [](const py::object& self) { unwrap<SonarConfig>(self, "sonar").validate(); },
      "Raises Error for the first field out of limits, or against a rule between fields.");
  sonar->def(
      "bin_ranges",
      [](const py::object& self) {
        const auto config = unwrap<SonarConfig>(self, "sonar");
        return array_of(config.bin_count, [&](int bin) { return config.bin_range(bin); });
      },
      "Range of the centre of every bin, an array [bins] in metres.");
  sonar->def(
      "azimuths",
      [](const py::object& self) {
        const auto config = unwrap<SonarConfig>(self, "sonar");
        return array_of(config.beam_count, [&](int beam) { return config.beam_azimuth(beam); });
      },
      "Azimuth of the centre of every beam, an array [beams] in radians, positive to port, falling.");
  sonar->def(
      "azimuth_edges",
      [](const py::object& self) {
        const std::vector<double> edges = unwrap<SonarConfig>(self, "sonar").bearings().edges();
        return py::array_t<double>(static_cast<py::ssize_t>(edges.size()), edges.data());
      },
      "Azimuths of the edges of the beams, an array [beams + 1] in radians, positive to port, falling; where there are "
      "gaps between beams, both edges of each in turn, [2 beams].");
}

void add_materials(py::module_& module) {
  ConfigClass<Material> material(module, "Material", "Acoustic properties of a surface.");
  material
      ->def_property_readonly(
          "name", [](const Held<Material>& self) { return self.value.name; }, "As written in scenes.")
      .def_property_readonly(
          "source", [](const Held<Material>& self) { return self.value.source; }, "Where the numbers come from.")
      .def(
          "reflection_at",
          [](const Held<Material>& self, double frequency) { return self.value.reflection_at(frequency); },
          py::arg("frequency"), "|R| in sea water at normal incidence, at a frequency [Hz] > 0 (calibrated model).")
      .def(
          "transmission_at",
          [](const Held<Material>& self, double frequency) { return self.value.transmission_at(frequency); },
          py::arg("frequency"), "|T| in sea water at normal incidence, at a frequency [Hz] > 0 (calibrated model).");
  module.def(
      "material_library", [] { return wrap_all(material_library()); },
      "Every material known by name, in alphabetical order: a list of Material. Typical values, +-5 %.");
}

}  // namespace

py::object make_sonar(const py::dict& given) {
  py::dict fields = given.attr("copy")();
  if (!fields.contains("preset")) {
    if (fields.contains("mode")) {
      throw Error("", "mode", " belongs to a preset, and none is named");
    }
    py::object made = wrap(SonarConfig());
    set_fields(made, fields);
    return made;
  }
  std::string name, mode;
  from_python(fields.attr("pop")("preset"), "preset", 1, name);
  if (fields.contains("mode")) {
    from_python(fields.attr("pop")("mode"), "mode", 1, mode);
  }
  const Preset known = load_preset(name, mode);
  py::object made = wrap(known.sonar);
  set_fields(made, fields);
  for (const Preset::Excess& excess : known.exceeded_by(unwrap<SonarConfig>(made, "sonar"))) {
    warnings_log()(Severity::kWarning, excess.field + excess.text);
  }
  return made;
}

void bind_configs(py::module_& module) {
  add_receivers_and_sonars(module);
  ConfigClass<ProfilePoint>(module, "ProfilePoint", "A point of a sound-speed profile.");
  ConfigClass<Water>(module, "Water", about("water"));
  ConfigClass<PaperModel>(module, "PaperModel", about("paper"));
  ConfigClass<MaterialOverride>(module, "MaterialOverride", about("materials"));
  add_materials(module);
  ConfigClass<PointTarget>(module, "PointTarget", about("points"));
  ConfigClass<Interferer>(module, "Interferer", about("interferers"));
  ConfigClass<Thruster>(module, "Thruster", about("thrusters"));
  ConfigClass<SeaSurface>(module, "SeaSurface", about("surface"));
  ConfigClass<Waypoint>(module, "Waypoint", about("trajectory"));
  ConfigClass<SurveyLines>(module, "SurveyLines", about("lines"));
  ConfigClass<MotionNoise>(module, "MotionNoise", about("motion_noise"));
  ConfigClass<SurveyPattern>(module, "SurveyPattern", about("pattern"));
  ConfigClass<PingSpan>(module, "PingSpan", about("ping_spans"));
  ConfigClass<Motion>(module, "Motion", about("motions"));
  ConfigClass<ViewConfig>(module, "ViewConfig", about("view"));
  ConfigClass<Scenario> scenario(module, "Scenario", about("scenario"));
  scenario->def_static("load", &load_wrapped, py::arg("path"), py::arg("settings") = py::tuple(),
                       "Reads a scenario from a YAML file, or the shipped scene of that name (scene_names()).\n\n"
                       "settings: texts \"key=value\" as of `insonify run --set`, or a dict of keys and values: "
                       "{\"sonars[0].max_range\": 30}; `max_range` alone is for all sonars.\n"
                       "Raises Error with file and line for whatever is wrong.");
  scenario->def_static("from_text", &parse_wrapped, py::arg("text"), py::arg("folder") = "",
                       py::arg("settings") = py::tuple(),
                       "Reads a scenario from YAML text. Relative paths are from `folder`, else from the current one.");
  scenario->def_static(
      "from_dict", &scenario_from_dict, py::arg("dict"), py::arg("folder") = "",
      "Reads a scenario from nested dicts and lists, with the keys of files. Values may be NumPy's scalars and arrays, "
      "tuples and paths (pathlib). Raises Error with the key of a value that is something else.");
  module.def("scene_names", &scene_names,
             "Names of the scenes that come with insonify: Scenario.load() takes them as it takes files.");
  module.def("preset_names", &preset_names, "Names of all presets, those of INSONIFY_PRESETS included.");
  module.def(
      "load_trajectory",
      [](const py::object& path) { return wrap_all(load_trajectory(path_from(path, "path")).waypoints); },
      py::arg("path"), "Reads waypoints from a CSV or TUM file: a list of Waypoint.");
  scenario->def(
      "to_yaml", [](const py::object& self) { return to_yaml(unwrap<Scenario>(self, "")); },
      "The text of a scenario file that load() reads back as the same.");
  scenario->def(
      "validate", [](const py::object& self) { unwrap<Scenario>(self, "").validate(); },
      "Raises Error for the first fault.");
}

}  // namespace insonify::python
