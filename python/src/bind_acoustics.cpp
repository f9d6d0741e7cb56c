// bind_acoustics.cpp -- insonify.acoustics: the formulas, for numbers and arrays.

#include <fmt/format.h>
#include <pybind11/complex.h>
#include <pybind11/numpy.h>

#include "bind.h"
#include "formula.h"
#include "held.h"
#include "insonify/acoustics/absorption.h"
#include "insonify/acoustics/backscatter.h"
#include "insonify/acoustics/bottom_scattering.h"
#include "insonify/acoustics/reflection.h"
#include "insonify/acoustics/sediment.h"
#include "insonify/acoustics/sonar_equation.h"
#include "insonify/acoustics/sound_speed.h"
#include "insonify/acoustics/sound_speed_profile.h"
#include "insonify/acoustics/surface_scattering.h"
#include "insonify/acoustics/target_strength.h"
#include "insonify/sound_speed_files.h"

namespace insonify::python {
namespace {

using py::arg;

void add_water(py::module_& m) {
  m.def(
      "absorption_db_per_m",
      [](const Numbers& frequency, const py::object& water) {
        const auto in = unwrap<Water>(water, "water");
        return py::vectorize([&in](double f) { return absorption_db_per_m(f, in); })(
            array_from(frequency, "frequency"));
      },
      arg("frequency"), arg("water"),
      "Absorption one way [dB/m] at a frequency [Hz], >= 0, in a Water. Ainslie and McColm, J. Acoust. Soc. Am. "
      "103(3), 1671 (1998): within 10 % of Francois and Garrison from 100 Hz to 1 MHz.");
  m.def(
      "francois_garrison_db_per_m",
      [](const Numbers& frequency, const py::object& water) {
        const auto in = unwrap<Water>(water, "water");
        return py::vectorize([&in](double f) { return francois_garrison_db_per_m(f, in); })(
            array_from(frequency, "frequency"));
      },
      arg("frequency"), arg("water"),
      "Absorption one way [dB/m] after Francois and Garrison, J. Acoust. Soc. Am. 72(3), 896 and 72(6), 1879 (1982): "
      "200 Hz to 1 MHz, +-5 %.");
  m.attr("NEPER_PER_DECIBEL") = kNeperPerDecibel;
  add_formula(m, "pressure_mpa", &pressure_mpa, arg("depth"), arg("latitude"),
              "Gauge pressure [MPa] at a depth [m], 0 to 12000, at a latitude [rad]. Leroy and Parthiot, J. Acoust. "
              "Soc. Am. 103(3), 1346 (1998), common oceans.");
  constexpr double kLatitude = 0.7853981633974483;
  add_formula(m, "chen_millero_sound_speed", &chen_millero_sound_speed, arg("temperature_c"), arg("salinity"),
              arg("depth"), arg("latitude") = kLatitude,
              "Sound speed [m/s] after Chen and Millero (1977) with the coefficients of Wong and Zhu (1995): 0 to 40 "
              "degC, 0 to 40 PSU. depth [m], latitude [rad].");
  add_formula(m, "del_grosso_sound_speed", &del_grosso_sound_speed, arg("temperature_c"), arg("salinity"), arg("depth"),
              arg("latitude") = kLatitude, "Sound speed [m/s] after Del Grosso (1974): 0 to 30 degC, 30 to 40 PSU.");
  add_formula(m, "mackenzie_sound_speed", &mackenzie_sound_speed, arg("temperature_c"), arg("salinity"), arg("depth"),
              "Sound speed [m/s] after Mackenzie (1981): -2 to 30 degC, 25 to 40 PSU, to 8000 m.");
  add_formula(m, "medwin_sound_speed", &medwin_sound_speed, arg("temperature_c"), arg("salinity"), arg("depth"),
              "Sound speed [m/s] after Medwin (1975): 0 to 35 degC, 0 to 45 PSU, to 1000 m.");
  add_formula(m, "leroy_sound_speed", &leroy_sound_speed, arg("temperature_c"), arg("salinity"), arg("depth"),
              arg("latitude"),
              "Sound speed [m/s] after Leroy, Robinson and Goldsmith (2008): all oceans, +-0.2 m/s. latitude [rad].");
  py::class_<BentPath>(m, "BentPath", "A sound path in a constant sound-speed gradient, an arc of a circle.")
      .def_readonly("radius", &BentPath::radius, "Of the circle [m], with the sign of c0/(g cos(launch angle)).")
      .def_readonly("drop", &BentPath::drop, "Depth gained, positive down [m].")
      .def_readonly("angle", &BentPath::angle, "On arrival, from the horizontal, positive down [rad].")
      .def_readonly("time", &BentPath::time, "Travel time [s].");
  m.def("bent_path", &bent_path, arg("sound_speed"), arg("gradient"), arg("launch_angle"), arg("distance"),
        "Refraction in a constant gradient: a BentPath. sound_speed at launch [m/s] > 0; gradient with depth [1/s], "
        "not 0; launch_angle positive down [rad], within +-pi/2; horizontal distance [m] >= 0. Raises Error where the "
        "path turns back before. Medwin and Clay, Fundamentals of Acoustical Oceanography (1998), ch. 3.");
}

void add_profiles(py::module_& m) {
  m.attr("STEEPEST_PROFILE") = kSteepestProfile;
  py::class_<RayPoint>(m, "RayPoint", "A point of a ray; distance and time are those from the source.")
      .def_readonly("distance", &RayPoint::distance, "Horizontal distance [m].")
      .def_readonly("depth", &RayPoint::depth, "[m]; negative above the surface.")
      .def_readonly("angle", &RayPoint::angle, "From the horizontal, positive down [rad].")
      .def_readonly("time", &RayPoint::time, "One-way travel time [s].");
  py::class_<Eigenray>(m, "Eigenray", "The ray that connects two points.")
      .def_readonly("launch_angle", &Eigenray::launch_angle, "At the source, positive down [rad].")
      .def_readonly("arrival_angle", &Eigenray::arrival_angle, "At the target, positive down [rad].")
      .def_readonly("time", &Eigenray::time, "One-way travel time [s].");
  py::class_<SoundSpeedProfile>(m, "SoundSpeedProfile",
                                "Sound speed by depth: linear between points, constant beyond. Rays are exact in it. "
                                "points: a list of ProfilePoint or of pairs, depth [m] and sound speed [m/s].")
      .def(py::init([](const py::iterable& points) {
             return SoundSpeedProfile(profile_points(points, "points"), "points");
           }),
           arg("points"))
      .def("speed_at", &SoundSpeedProfile::speed_at, arg("depth"), "Sound speed [m/s] at a depth [m].")
      .def(
          "after_time", &SoundSpeedProfile::after_time, arg("depth"), arg("launch_angle"), arg("time"),
          "Where the ray from a depth [m] and a launch angle, positive down [rad], is after a one-way travel time [s]: "
          "a RayPoint.")
      .def("at_distance", &SoundSpeedProfile::at_distance, arg("depth"), arg("launch_angle"), arg("distance"),
           "Where it is after a horizontal distance [m]: a RayPoint.")
      .def(
          "eigenray",
          [](const SoundSpeedProfile& self, double depth, double to_depth, double distance) -> py::object {
            const std::optional<Eigenray> ray = self.eigenray(depth, to_depth, distance);
            return ray ? py::cast(*ray) : py::none();
          },
          arg("depth"), arg("to_depth"), arg("distance"),
          "The earliest ray between two depths [m] at a horizontal distance [m]: an Eigenray; None in a shadow zone.");
  m.def(
      "load_sound_speed_profile",
      [](const py::object& path) {
        return wrap_all(load_sound_speed_profile(path_from(path, "path"), warnings_log()));
      },
      arg("path"), "Reads a cast, .csv, CARIS .svp or Kongsberg .asvp: a list of ProfilePoint.");
}

void add_levels(py::module_& m) {
  add_formula(
      m, "transmission_loss_db", &transmission_loss_db, arg("range"), arg("absorption_db_per_m") = 0.0,
      "One way, 20 log10 r + alpha r [dB re 1 m]. range [m] > 0. Urick, Principles of Underwater Sound (1983), ch. 2.");
  add_formula(m, "echo_level_db", &echo_level_db, arg("source_level_db"), arg("one_way_loss_db"), arg("target_db"),
              "SL - 2 TL + TS [dB re 1 uPa].");
  add_formula(m, "thermal_noise_level_db", &thermal_noise_level_db, arg("frequency"),
              "-15 + 20 log10(f/kHz) [dB re 1 uPa^2/Hz]. Mellen, J. Acoust. Soc. Am. 24(5), 478 (1952).");
  add_formula(m, "wind_noise_level_db", &wind_noise_level_db, arg("frequency"), arg("wind_speed"),
              "Spectral level of the noise of the sea in wind [dB re 1 uPa^2/Hz].");
  add_formula(m, "ship_noise_level_db", &ship_noise_level_db, arg("frequency"), arg("shipping"),
              "Spectral level of the noise of distant ships, shipping from 0 to 1 [dB re 1 uPa^2/Hz].");
  add_formula(m, "rain_noise_level_db", &rain_noise_level_db, arg("frequency"), arg("rain"),
              "Spectral level of the noise of rain, in mm/h [dB re 1 uPa^2/Hz].");
  add_formula(m, "sector_directivity_index_db", &sector_directivity_index_db, arg("azimuth_width"),
              arg("elevation_width"), "Of a top-hat beam [dB]; full angles [rad].");
  add_formula(m, "noise_level_db", &noise_level_db, arg("spectral_level_db"), arg("bandwidth"),
              arg("directivity_index_db"), "NL + 10 log10 B - DI [dB re 1 uPa]; bandwidth [Hz].");
  // Closed forms of simple scenes.
  add_formula(m, "lambert_floor_intensity", &lambert_floor_intensity, arg("mu"), arg("altitude"), arg("azimuth_width"),
              arg("bin_start"), arg("bin_end"), arg("absorption_db_per_m") = 0.0,
              "Echo intensity, re the source's at 1 m, of a flat Lambert floor in one bin [m] of a beam [rad]: mu h^2 "
              "width (r1^-4 - r2^-4)/4 without absorption [dB/m]. altitude h [m] > 0; nothing echoes from nearer.");
  add_formula(m, "lambert_wall_intensity", &lambert_wall_intensity, arg("mu"), arg("distance"), arg("azimuth"),
              arg("azimuth_width"), arg("elevation_width"),
              "The same of a plane Lambert wall across the acoustic axis at a distance [m], summed over all bins, "
              "without absorption. Full angles [rad]; azimuth of the beam's middle within +-pi/2.");
  add_formula(m, "volume_reverberation_intensity", &volume_reverberation_intensity, arg("volume_backscatter"),
              arg("azimuth_width"), arg("elevation_width"), arg("bin_start"), arg("bin_end"),
              arg("absorption_db_per_m") = 0.0,
              "Volume reverberation in one bin: s_v width 2 sin(height/2) (1/r1 - 1/r2) without absorption. "
              "volume_backscatter s_v [1/m], linear, >= 0.");
}

void add_targets(py::module_& m) {
  m.attr("FAR_FIELD") = kFarField;
  add_formula(m, "target_strength_db", &target_strength_db, arg("cross_section"),
              "10 log10 of a backscattering cross section [m^2].");
  add_formula(m, "convex_cross_section", &convex_cross_section, arg("radius1"), arg("radius2"),
              arg("range") = kFarField, "Specular highlight of a smooth convex body [m^2]. Urick (1983), table 9.1.");
  add_formula(m, "sphere_cross_section", &sphere_cross_section, arg("radius"), arg("range") = kFarField,
              "Rigid sphere [m^2]: a^2/4 in the far field.");
  add_formula(m, "cylinder_cross_section", &cylinder_cross_section, arg("radius"), arg("length"), arg("wavelength"),
              arg("range") = kFarField, "Rigid cylinder at broadside [m^2].");
  add_formula(m, "plate_cross_section", &plate_cross_section, arg("width"), arg("height"), arg("wavelength"),
              arg("range") = kFarField, "Rigid rectangular plate at normal incidence [m^2].");
  add_formula(m, "lambert_sphere_cross_section", &lambert_sphere_cross_section, arg("mu"), arg("radius"),
              "Sphere that scatters by Lambert's law [m^2]: 2 pi mu a^2/3.");
  add_formula(m, "dihedral_cross_section", &dihedral_cross_section, arg("width"), arg("height"), arg("wavelength"),
              "Corner of two plates along its axis [m^2].");
  add_formula(m, "triangular_trihedral_cross_section", &triangular_trihedral_cross_section, arg("edge"),
              arg("wavelength"), "Corner of three right triangles along its axis [m^2].");
  add_formula(m, "square_trihedral_cross_section", &square_trihedral_cross_section, arg("edge"), arg("wavelength"),
              "Corner of three squares along its axis [m^2].");
}

// A Sediment, or the name of one.
const Sediment& sediment_from(const py::object& given) {
  if (py::isinstance<Sediment>(given)) {
    return given.cast<const Sediment&>();
  }
  std::string name;
  from_python(given, "sediment", 1, name);
  const Sediment* sediment = find_sediment(name);
  if (sediment == nullptr) {
    throw Error("", "sediment", " = " + name + " is not in the table of sediments");
  }
  return *sediment;
}

void add_sediments(py::module_& m) {
  py::class_<Sediment>(m, "Sediment",
                       "A sea floor as a fluid with a rough surface, for 10 to 100 kHz: APL-UW TR 9407 (1994), section "
                       "IV. Ratios are to the water above.")
      .def_readonly("name", &Sediment::name, "Lower case, words joined by '_'.")
      .def_property_readonly(
          "grain_size", [](const Sediment& self) { return to_python(self.grain_size, 1); },
          "Mean grain size [phi], -1 to 9; None for stones and rock.")
      .def_readonly("density_ratio", &Sediment::density_ratio, "Density, to the water's.")
      .def_readonly("sound_speed_ratio", &Sediment::sound_speed_ratio, "Compressional sound speed, to the water's.")
      .def_readonly("loss", &Sediment::loss, "Imaginary over real part of the wavenumber.")
      .def_readonly("volume_parameter", &Sediment::volume_parameter,
                    "Volume scattering cross section over absorption coefficient.")
      .def_readonly("spectral_strength", &Sediment::spectral_strength,
                    "Roughness spectrum at a wavenumber of 1/cm [cm^4].")
      .def_readonly("spectral_exponent", &Sediment::spectral_exponent, "Exponent of that spectrum.")
      .def_readonly("lambert_mu_db", &Sediment::lambert_mu_db,
                    "Lambert parameter fitted to the report's backscatter at 100 kHz [dB].")
      .def_property_readonly(
          "rms_slope", [](const Sediment& self) { return to_python(self.rms_slope, 1); },
          "Fitted rms slope of the facet lobe; None where only Lambert's law fits.")
      .def_property_readonly(
          "confidence",
          [](const Sediment& self) {
            return self.confidence == Confidence::kHigh     ? "high"
                   : self.confidence == Confidence::kMedium ? "medium"
                                                            : "low";
          },
          "How reliable its values are below 100 kHz: high, medium or low.")
      .def("reflection", &Sediment::reflection, arg("grazing"),
           "bottom_reflection() with these properties, complex; grazing [rad], 0 to pi/2.")
      .def("__repr__", [](const Sediment& self) { return "<Sediment " + self.name + ">"; });
  m.def("sediment_of_grain_size", &sediment_of_grain_size, arg("grain_size"),
        "The report's properties as functions of mean grain size [phi], -1 to 9; without name and fitted values.");
  m.def(
      "sediment_table",
      [] {
        py::list all;
        for (const Sediment& sediment : sediment_table()) {
          all.append(sediment);
        }
        return all;
      },
      "All sediments known by name, from coarse to fine: a list of Sediment.");
  m.def(
      "find_sediment",
      [](const std::string& name) {
        const Sediment* sediment = find_sediment(name);
        return sediment == nullptr ? py::object(py::none()) : py::cast(*sediment);
      },
      arg("name"), "The table's Sediment of that name, or None; case, '_', '-' and ' ' do not matter.");
}

void add_surfaces(py::module_& m) {
  m.attr("GREATEST_LAMBERT_PARAMETER") = kGreatestLambertParameter;
  m.attr("REPORT_SOUND_SPEED") = kReportSoundSpeed;
  add_formula(
      m, "lambert_scatter", &lambert_scatter, arg("mu"), arg("incidence_in"), arg("incidence_out"),
      "Lambert's law between two directions, mu cos(in) cos(out), per unit area; angles from the normal [rad].");
  add_formula(m, "facet_scatter", &facet_scatter, arg("reflection"), arg("rms_slope"), arg("half_tilt"),
              "facet_backscatter() between two directions on the side of the normal, by the angle between the normal "
              "and the vector halfway between them [rad], 0 to pi/2.");
  m.def(
      "half_vector_tilt",
      [](const py::object& normal, const py::object& towards_source, const py::object& towards_receiver) {
        Vec3 n, source, receiver;
        from_python(normal, "normal", 1, n);
        from_python(towards_source, "towards_source", 1, source);
        from_python(towards_receiver, "towards_receiver", 1, receiver);
        return half_vector_tilt(n, source, receiver);
      },
      arg("normal"), arg("towards_source"), arg("towards_receiver"),
      "Angle between a surface's normal and the vector halfway between two directions away from it [rad]. Unit vectors "
      "of three numbers, not opposite to each other.");
  add_formula(m, "lambert_backscatter", &lambert_backscatter, arg("mu"), arg("incidence"),
              "mu cos^2(incidence), per unit area; incidence from the normal [rad].");
  add_formula(
      m, "facet_backscatter", &facet_backscatter, arg("reflection"), arg("rms_slope"), arg("incidence"),
      "Echo of facets with normally distributed slopes, per unit area. Beckmann and Spizzichino (1963), ch. 5.");
  add_formula(m, "reflection_coefficient", &reflection_coefficient, arg("water_impedance"), arg("impedance"),
              "Pressure reflection of a half-space at normal incidence; impedances [kg/(m^2 s)].");
  add_formula(m, "plate_reflection", &plate_reflection, arg("water_impedance"), arg("density"), arg("sound_speed"),
              arg("thickness"), arg("frequency"), "|R| of a lossless plate in water at normal incidence.");
  add_formula(m, "bottom_reflection", &bottom_reflection, arg("density_ratio"), arg("sound_speed_ratio"), arg("loss"),
              arg("grazing"),
              "Complex R of an absorbing fluid bottom at a grazing angle [rad]. APL-UW TR 9407 (1994), section IV.");
  m.def(
      "bottom_backscatter",
      [](const py::object& given, const Numbers& grazing, const Numbers& frequency, const Numbers& sound_speed) {
        const Sediment& sediment = sediment_from(given);
        const std::array<std::string, 3> names = {"grazing", "frequency", "sound_speed"};
        const std::array<py::array_t<double>, 3> arrays = {
            array_from(grazing, names[0]), array_from(frequency, names[1]), array_from(sound_speed, names[2])};
        check_shapes(arrays.data(), names.data(), arrays.size());
        return py::vectorize([&sediment](double angle, double f, double speed) {
          return bottom_backscatter(sediment, angle, f, speed);
        })(arrays[0], arrays[1], arrays[2]);
      },
      arg("sediment"), arg("grazing"), arg("frequency"), arg("sound_speed") = kReportSoundSpeed,
      "Backscattering cross section of the bottom per unit area, of a Sediment or the name of one. grazing [rad] to "
      "pi/2; frequency [Hz], 10e3 to 100e3; sound_speed of the water above [m/s], 1400 to 1600. APL-UW TR 9407 (1994), "
      "IV.C: accurate to 3 dB on sand and silt that were measured, to 10 dB on rock.");
  add_formula(m, "sea_surface_backscatter", &sea_surface_backscatter, arg("grazing"), arg("frequency"),
              arg("wind_speed"), "Of the rough sea surface from below, per unit area. APL-UW TR 9407 (1994), II.B.");
  add_formula(
      m, "sea_surface_diffuse_backscatter", &sea_surface_diffuse_backscatter, arg("grazing"), arg("frequency"),
      arg("wind_speed"),
      "The part of sea_surface_backscatter() that is not the lobe of facets: small-scale roughness and bubbles.");
  add_formula(m, "surface_bubble_loss_db", &surface_bubble_loss_db, arg("grazing"), arg("frequency"), arg("wind_speed"),
              "Loss in the bubble layer, to the surface and back [dB].");
  add_formula(m, "sea_surface_reflection", &sea_surface_reflection, arg("grazing"), arg("frequency"), arg("wind_speed"),
              "|R| of the rough surface for all energy about the specular direction.");
  add_formula(m, "coherent_reflection", &coherent_reflection, arg("rms_height"), arg("wavelength"), arg("grazing"),
              "Coherent reflection of a rough surface relative to a smooth one, exp(-2 k^2 h^2 sin^2).");
  add_formula(m, "chapman_harris_db", &chapman_harris_db, arg("grazing"), arg("frequency"), arg("wind_speed"),
              "Surface scattering strength [dB] of Chapman and Harris (1962), 400 to 6400 Hz; for comparison only. "
              "wind_speed [m/s] > 0.");
}

}  // namespace

std::vector<ProfilePoint> profile_points(const py::iterable& given, const std::string& name) {
  std::vector<ProfilePoint> points;
  for (const py::handle item : given) {
    const std::string of_item = fmt::format("{}[{}]", name, points.size());
    if (py::isinstance<Held<ProfilePoint>>(item)) {
      points.push_back(unwrap<ProfilePoint>(item, of_item));
      continue;
    }
    std::vector<double> pair;
    from_python(item, of_item, 1, pair);
    if (pair.size() != 2) {
      throw Error("", of_item, " must be a ProfilePoint, or a depth and a sound speed");
    }
    points.push_back({.depth = pair[0], .sound_speed = pair[1]});
  }
  return points;
}

void bind_acoustics(py::module_& module) {
  py::module_ acoustics = module.def_submodule("acoustics",
                                               "Formulas of underwater acoustics, for numbers and arrays. Angles in "
                                               "radians. Arguments out of their limits raise Error.");
  add_water(acoustics);
  acoustics.attr("ProfilePoint") = module.attr("ProfilePoint");
  add_profiles(acoustics);
  add_levels(acoustics);
  add_targets(acoustics);
  add_sediments(acoustics);
  add_surfaces(acoustics);
}

}  // namespace insonify::python
