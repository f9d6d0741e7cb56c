// bind_acoustics.cpp -- insonify.acoustics: the formulas, for numbers and arrays.

#include <pybind11/complex.h>
#include <pybind11/numpy.h>

#include "bind.h"
#include "held.h"
#include "insonify/acoustics/absorption.h"
#include "insonify/acoustics/backscatter.h"
#include "insonify/acoustics/bottom_scattering.h"
#include "insonify/acoustics/reflection.h"
#include "insonify/acoustics/sediment.h"
#include "insonify/acoustics/sonar_equation.h"
#include "insonify/acoustics/sound_speed.h"
#include "insonify/acoustics/surface_scattering.h"
#include "insonify/acoustics/target_strength.h"

namespace insonify::python {
namespace {

using py::arg;

void add_water(py::module_& m) {
  m.def(
      "absorption_db_per_m",
      [](double frequency, const py::object& water) {
        return absorption_db_per_m(frequency, unwrap<Water>(water, "water"));
      },
      arg("frequency"), arg("water"),
      "Absorption one way [dB/m] at a frequency [Hz] in a Water. Ainslie and McColm, J. Acoust. Soc. Am. 103(3), 1671 "
      "(1998).");
  m.def(
      "francois_garrison_db_per_m",
      [](double frequency, const py::object& water) {
        return francois_garrison_db_per_m(frequency, unwrap<Water>(water, "water"));
      },
      arg("frequency"), arg("water"),
      "Absorption one way [dB/m] after Francois and Garrison, J. Acoust. Soc. Am. 72(3), 896 and 72(6), 1879 (1982).");
  constexpr double kLatitude = 0.7853981633974483;
  m.def("chen_millero_sound_speed", py::vectorize(chen_millero_sound_speed), arg("temperature_c"), arg("salinity"),
        arg("depth"), arg("latitude") = kLatitude,
        "Sound speed [m/s] after Chen and Millero (1977) with the coefficients of Wong and Zhu (1995): 0 to 40 degC, 0 "
        "to 40 PSU. "
        "depth [m], latitude [rad].");
  m.def("del_grosso_sound_speed", py::vectorize(del_grosso_sound_speed), arg("temperature_c"), arg("salinity"),
        arg("depth"), arg("latitude") = kLatitude,
        "Sound speed [m/s] after Del Grosso (1974): 0 to 30 degC, 30 to 40 PSU.");
  m.def("mackenzie_sound_speed", py::vectorize(mackenzie_sound_speed), arg("temperature_c"), arg("salinity"),
        arg("depth"), "Sound speed [m/s] after Mackenzie (1981): -2 to 30 degC, 25 to 40 PSU, to 8000 m.");
  m.def("medwin_sound_speed", py::vectorize(medwin_sound_speed), arg("temperature_c"), arg("salinity"), arg("depth"),
        "Sound speed [m/s] after Medwin (1975): 0 to 35 degC, 0 to 45 PSU, to 1000 m.");
  m.def("leroy_sound_speed", py::vectorize(leroy_sound_speed), arg("temperature_c"), arg("salinity"), arg("depth"),
        arg("latitude"),
        "Sound speed [m/s] after Leroy, Robinson and Goldsmith (2008): all oceans, +-0.2 m/s. latitude [rad].");
}

void add_levels(py::module_& m) {
  m.def(
      "transmission_loss_db", py::vectorize(transmission_loss_db), arg("range"), arg("absorption_db_per_m") = 0.0,
      "One way, 20 log10 r + alpha r [dB re 1 m]. range [m] > 0. Urick, Principles of Underwater Sound (1983), ch. 2.");
  m.def("echo_level_db", py::vectorize(echo_level_db), arg("source_level_db"), arg("one_way_loss_db"), arg("target_db"),
        "SL - 2 TL + TS [dB re 1 uPa].");
  m.def("thermal_noise_level_db", py::vectorize(thermal_noise_level_db), arg("frequency"),
        "-15 + 20 log10(f/kHz) [dB re 1 uPa^2/Hz]. Mellen, J. Acoust. Soc. Am. 24(5), 478 (1952).");
  m.def("sector_directivity_index_db", py::vectorize(sector_directivity_index_db), arg("azimuth_width"),
        arg("elevation_width"), "Of a top-hat beam [dB]; full angles [rad].");
  m.def("noise_level_db", py::vectorize(noise_level_db), arg("spectral_level_db"), arg("bandwidth"),
        arg("directivity_index_db"), "NL + 10 log10 B - DI [dB re 1 uPa]; bandwidth [Hz].");
}

void add_targets(py::module_& m) {
  m.def("target_strength_db", py::vectorize(target_strength_db), arg("cross_section"),
        "10 log10 of a backscattering cross section [m^2].");
  m.def("convex_cross_section", py::vectorize(convex_cross_section), arg("radius1"), arg("radius2"),
        arg("range") = kFarField, "Specular highlight of a smooth convex body [m^2]. Urick (1983), table 9.1.");
  m.def("sphere_cross_section", py::vectorize(sphere_cross_section), arg("radius"), arg("range") = kFarField,
        "Rigid sphere [m^2]: a^2/4 in the far field.");
  m.def("cylinder_cross_section", py::vectorize(cylinder_cross_section), arg("radius"), arg("length"),
        arg("wavelength"), arg("range") = kFarField, "Rigid cylinder at broadside [m^2].");
  m.def("plate_cross_section", py::vectorize(plate_cross_section), arg("width"), arg("height"), arg("wavelength"),
        arg("range") = kFarField, "Rigid rectangular plate at normal incidence [m^2].");
  m.def("lambert_sphere_cross_section", py::vectorize(lambert_sphere_cross_section), arg("mu"), arg("radius"),
        "Sphere that scatters by Lambert's law [m^2]: 2 pi mu a^2/3.");
  m.def("dihedral_cross_section", py::vectorize(dihedral_cross_section), arg("width"), arg("height"), arg("wavelength"),
        "Corner of two plates along its axis [m^2].");
  m.def("triangular_trihedral_cross_section", py::vectorize(triangular_trihedral_cross_section), arg("edge"),
        arg("wavelength"), "Corner of three right triangles along its axis [m^2].");
  m.def("square_trihedral_cross_section", py::vectorize(square_trihedral_cross_section), arg("edge"), arg("wavelength"),
        "Corner of three squares along its axis [m^2].");
}

void add_surfaces(py::module_& m) {
  m.def("lambert_backscatter", py::vectorize(lambert_backscatter), arg("mu"), arg("incidence"),
        "mu cos^2(incidence), per unit area; incidence from the normal [rad].");
  m.def("facet_backscatter", py::vectorize(facet_backscatter), arg("reflection"), arg("rms_slope"), arg("incidence"),
        "Echo of facets with normally distributed slopes, per unit area. Beckmann and Spizzichino (1963), ch. 5.");
  m.def("reflection_coefficient", py::vectorize(reflection_coefficient), arg("water_impedance"), arg("impedance"),
        "Pressure reflection of a half-space at normal incidence; impedances [kg/(m^2 s)].");
  m.def("plate_reflection", py::vectorize(plate_reflection), arg("water_impedance"), arg("density"), arg("sound_speed"),
        arg("thickness"), arg("frequency"), "|R| of a lossless plate in water at normal incidence.");
  m.def("bottom_reflection", &bottom_reflection, arg("density_ratio"), arg("sound_speed_ratio"), arg("loss"),
        arg("grazing"),
        "Complex R of an absorbing fluid bottom at a grazing angle [rad]. APL-UW TR 9407 (1994), section IV.");
  m.def(
      "bottom_backscatter",
      [](const std::string& name, double grazing, double frequency, double sound_speed) {
        const Sediment* sediment = find_sediment(name);
        if (sediment == nullptr) {
          throw Error("", "sediment", " = " + name + " is not in the table of sediments");
        }
        return bottom_backscatter(*sediment, grazing, frequency, sound_speed);
      },
      arg("sediment"), arg("grazing"), arg("frequency"), arg("sound_speed") = kReportSoundSpeed,
      "Backscattering cross section of the bottom per unit area, by the sediment's name; 10 to 100 kHz. APL-UW TR 9407 "
      "(1994).");
  m.def("sea_surface_backscatter", py::vectorize(sea_surface_backscatter), arg("grazing"), arg("frequency"),
        arg("wind_speed"), "Of the rough sea surface from below, per unit area. APL-UW TR 9407 (1994), II.B.");
  m.def("surface_bubble_loss_db", py::vectorize(surface_bubble_loss_db), arg("grazing"), arg("frequency"),
        arg("wind_speed"), "Loss in the bubble layer, to the surface and back [dB].");
  m.def("sea_surface_reflection", py::vectorize(sea_surface_reflection), arg("grazing"), arg("frequency"),
        arg("wind_speed"), "|R| of the rough surface for all energy about the specular direction.");
  m.def("coherent_reflection", py::vectorize(coherent_reflection), arg("rms_height"), arg("wavelength"), arg("grazing"),
        "Coherent reflection of a rough surface relative to a smooth one, exp(-2 k^2 h^2 sin^2).");
}

}  // namespace

void bind_acoustics(py::module_& module) {
  py::module_ acoustics = module.def_submodule("acoustics",
                                               "Formulas of underwater acoustics, for numbers and arrays. Angles in "
                                               "radians. Arguments out of their limits raise Error.");
  add_water(acoustics);
  add_levels(acoustics);
  add_targets(acoustics);
  add_surfaces(acoustics);
}

}  // namespace insonify::python
