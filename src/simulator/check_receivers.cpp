// check_receivers.cpp -- rules between a sonar's beams, pulse and gains, and the receiver that processes its echoes.

#include <fmt/format.h>

#include <numbers>

#include "insonify/array_pattern.h"
#include "insonify/error.h"
#include "receiver/array/line_array.h"
#include "simulator/checks.h"

namespace insonify {
namespace {

// Checks that an array of this pattern and width exists.
template <typename MakeArray>
void check_array(const std::string& object, std::string_view key, BeamPattern pattern, const MakeArray& make_array) {
  if (pattern == BeamPattern::kTopHat) {
    return;
  }
  ArraySettings array;
  try {
    array = make_array();
  } catch (const Error& error) {
    throw Error(object, key, fmt::format(" = {}", error.what()));
  }
  array.validate(object);
}

// Arrays measure the sine of the bearing, which is ambiguous beyond 90 degrees.
void check_fan(const std::string& object, std::string_view key, std::string_view only, std::size_t index,
               const SonarConfig& sonar) {
  if (sonar.azimuth_aperture > std::numbers::pi) {
    throw Error(object, key,
                fmt::format(" must be {} for fans of more than 180 deg; sonars[{}] has {:.4g}", only, index,
                            degrees_from_radians(sonar.azimuth_aperture)),
                {fmt::format("sonars[{}].azimuth_aperture_deg", index)});
  }
}

void check_beams(const std::string& object, const ReceiverConfig& receiver, std::size_t index,
                 const SonarConfig& sonar) {
  if (receiver.azimuth_pattern != BeamPattern::kTopHat) {
    check_fan(object, "azimuth_pattern", "top_hat", index, sonar);
  }
  if (receiver.beam_shape == BeamShape::kCone) {
    check_fan(object, "beam_shape", "wedge", index, sonar);
  }
  check_array(object, "azimuth_pattern", receiver.azimuth_pattern, [&] { return azimuth_array(receiver, sonar); });
  const BeamPattern elevation = sonar.elevation_pattern_beside(receiver);
  check_array(object, "elevation_pattern", elevation,
              [&] { return line_array(elevation, receiver.side_lobe_db, sonar.elevation_aperture); });
  if (sonar.transmit_elevation_pattern != BeamPattern::kInstrument || sonar.transmit_elevation_aperture) {
    const BeamPattern sent = sonar.sent_elevation_pattern(receiver);
    check_array(fmt::format("sonars[{}]", index), "transmit_elevation_pattern", sent,
                [&] { return line_array(sent, receiver.side_lobe_db, sonar.sent_elevation_aperture()); });
  }
  if (sonar.transmit_width || sonar.element_width) {
    check_fan(fmt::format("sonars[{}]", index), sonar.transmit_width ? "transmit_width_deg" : "element_width_deg",
              "absent", index, sonar);
  }
}

// Gains are applied in single precision, which overflows at 385 dB.
void check_gain(const std::string& object, const ReceiverConfig& receiver, std::size_t index, const SonarConfig& sonar,
                const Water& water) {
  constexpr double kMost = 300;
  const double range = sonar.bin_range(sonar.bin_count - 1);
  const double gain = receiver.gain_db(range, water.absorption_db_per_m_at(sonar.frequency));
  if (gain > kMost) {
    throw Error(
        object, receiver.time_varied_gain ? "time_varied_gain" : "gains_db",
        fmt::format(" comes to {:.4g} dB at {:.4g} m, the far end of sonars[{}]; must be at most {} dB: nothing "
                    "is left to raise there",
                    gain, range, index, kMost));
  }
}

// Fresnel's approximation, on which ArrayPattern::defocused() rests, fails nearer than about the array's length.
void check_focus(const ReceiverConfig& receiver, std::size_t index, const SonarConfig& sonar, const Water& water) {
  if (!sonar.focus_range || receiver.azimuth_pattern == BeamPattern::kTopHat) {
    return;
  }
  const double wavelength = water.true_sound_speed() / sonar.frequency;
  const double length = ArrayPattern(azimuth_array(receiver, sonar)).length(wavelength, beam_width(sonar));
  if (*sonar.focus_range < length) {
    const std::string object = fmt::format("sonars[{}]", index);
    throw Error(object, "focus_range",
                fmt::format(" = {:.4g} m must be at least {:.4g} m, the length of the array that makes beams of {:.4g} "
                            "deg",
                            *sonar.focus_range, rounded_up(length), degrees_from_radians(beam_width(sonar))),
                {object + ".azimuth_resolution_deg", object + ".frequency"});
  }
}

// SonarConfig::validate() checks the band of the instrument's own pulse.
void check_pulse_band(const std::string& object, const ReceiverConfig& receiver, std::size_t index,
                      const SonarConfig& sonar) {
  const double limit = 2 * sonar.frequency;
  if (receiver.pulse == PulseKind::kLfm && receiver.pulse_bandwidth >= limit) {
    throw Error(object, "pulse_bandwidth",
                fmt::format(" = {:.10g} Hz must be less than {:.10g} Hz, twice the frequency of sonars[{}]",
                            receiver.pulse_bandwidth, limit, index),
                {object + ".pulse", fmt::format("sonars[{}].frequency", index)});
  }
}

}  // namespace

void check_receivers(const Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const SonarConfig sonar = scenario.sonars[i].aperture(0);
    const ReceiverConfig& receiver = scenario.receiver_of(sonar);
    const std::string object = sonar.receiver ? fmt::format("sonars[{}].receiver", i) : "receiver";
    check_beams(object, receiver, i, sonar);
    check_focus(receiver, i, sonar, scenario.water_at(sonar));
    check_pulse_band(object, receiver, i, sonar);
    if (scenario.primary == PrimaryEchoes::kRaster && scenario.sonars[i].has_cones()) {
      throw Error("", "primary",
                  fmt::format(" = raster does not draw the cones of sonars[{}], of type {}; auto or rays takes any", i,
                              word_of(scenario.sonars[i].type)));
    }
    if (scenario.primary == PrimaryEchoes::kRaster && !scenario.has_even_rows(scenario.sonars[i])) {
      throw Error(
          "", "primary",
          fmt::format(" = raster needs {0}.beam_shape = wedge and {0}.elevation_pattern = top_hat; auto or rays "
                      "takes any",
                      object));
    }
    check_gain(object, receiver, i, sonar, scenario.water_at(sonar));
  }
}

}  // namespace insonify
