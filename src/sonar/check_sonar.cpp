// check_sonar.cpp -- the checks of a sonar's configuration.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "insonify/error.h"
#include "insonify/sonar_config.h"
#include "sonar/angle_slack.h"

namespace insonify {
namespace {

constexpr double kFullCircle = 2 * std::numbers::pi;

// @param related  Other fields of the same sonar.
[[noreturn]] void fail(std::string_view object, std::string_view field, std::string_view rest,
                       std::initializer_list<std::string_view> related = {}) {
  std::vector<std::string> names;
  for (const std::string_view name : related) {
    names.push_back(member_name(object, name));
  }
  throw Error(object, field, rest, std::move(names));
}

std::string degrees(double radians) {
  return fmt::format("{:.10g} deg", degrees_from_radians(radians));
}

// Checks the name, which becomes part of file names.
void check_name(std::string_view object, const std::string& name) {
  const bool is_plain = std::ranges::none_of(name, [](char letter) {
    return letter == '/' || letter == '\\' || std::iscntrl(static_cast<unsigned char>(letter)) != 0;
  });
  if (name.empty() || name.front() == '.' || !is_plain) {
    fail(object, "name", " must not be empty, start with '.' or hold a slash, a backslash or a control character");
  }
  constexpr std::size_t kLongest = 200;  // File systems take 255 bytes, pictures add to the name.
  if (name.size() > kLongest) {
    fail(object, "name", fmt::format(" has {} bytes; must have at most {}", name.size(), kLongest));
  }
  if (name.find_first_not_of(' ') == std::string::npos) {
    fail(object, "name", " must not be blank");
  }
}

void check_ranges(std::string_view object, const SonarConfig& sonar) {
  if (!(sonar.max_range > sonar.min_range)) {
    fail(object, "max_range",
         fmt::format(" = {:.10g} m must be greater than min_range = {:.10g} m", sonar.max_range, sonar.min_range),
         {"min_range"});
  }
  if (sonar.blanking_range > sonar.max_range) {
    fail(object, "blanking_range",
         fmt::format(" = {:.10g} m must be at most max_range = {:.10g} m", sonar.blanking_range, sonar.max_range),
         {"max_range"});
  }
  if (sonar.dead_range > sonar.max_range) {
    fail(object, "dead_range",
         fmt::format(" = {:.10g} m must be at most max_range = {:.10g} m", sonar.dead_range, sonar.max_range),
         {"max_range"});
  }
}

// Limits the number of cells (beams x bins): a ping takes some twenty bytes per cell, in memory and in the recording.
void check_cells(std::string_view object, const SonarConfig& sonar) {
  constexpr std::int64_t kMost = 1 << 25;
  const std::int64_t cells = std::int64_t{sonar.beam_count} * sonar.bin_count;
  if (cells > kMost) {
    fail(object, "bin_count",
         fmt::format(" = {} makes {} cells with beam_count = {}, must be at most {}", sonar.bin_count, cells,
                     sonar.beam_count, kMost),
         {"beam_count"});
  }
}

void check_beam_azimuths(std::string_view object, const SonarConfig& sonar) {
  const std::vector<double>& azimuths = sonar.beam_azimuths;
  if (azimuths.empty()) {
    return;
  }
  if (azimuths.size() != static_cast<std::size_t>(sonar.beam_count)) {
    fail(object, "beam_azimuths_deg",
         fmt::format(" has {} angles, must have one for each of beam_count = {}", azimuths.size(), sonar.beam_count),
         {"beam_count"});
  }
  for (std::size_t beam = 1; beam < azimuths.size(); ++beam) {
    if (!(azimuths[beam] < azimuths[beam - 1])) {
      fail(object, fmt::format("beam_azimuths_deg[{}]", beam),
           fmt::format(" = {} must be less than beam_azimuths_deg[{}] = {}: beams run from "
                       "port to starboard",
                       degrees(azimuths[beam]), beam - 1, degrees(azimuths[beam - 1])));
    }
  }
  const double extent = sonar.bearings().extent();
  if (extent > kFullCircle + kAngleSlack) {
    fail(object, "beam_azimuths_deg", fmt::format(" make a fan of {}, must be at most 360 deg", degrees(extent)));
  }
}

void check_beam_widths(std::string_view object, const SonarConfig& sonar) {
  const std::size_t widths = sonar.beam_widths.size();
  if (widths == 0) {
    return;
  }
  if (sonar.scans()) {
    fail(object, "beam_widths_deg", " belongs to a fan; the beam of a msis is as wide as azimuth_aperture_deg",
         {"type"});
  }
  if (widths != 1 && widths != static_cast<std::size_t>(sonar.beam_count)) {
    fail(object, "beam_widths_deg",
         fmt::format(" has {} widths, must have one for all or one for each of beam_count = {}", widths,
                     sonar.beam_count),
         {"beam_count"});
  }
  const BearingGrid beams = sonar.bearings();
  for (int beam = 0; beam + 1 < sonar.beam_count; ++beam) {
    if (beams.port[beam + 1] > beams.starboard[beam]) {
      fail(object, "beam_widths_deg",
           fmt::format(" must not make beams overlap: beam {} ends at {}, beam {} begins at {}", beam,
                       degrees(beams.starboard[beam]), beam + 1, degrees(beams.port[beam + 1])));
    }
  }
}

void check_channels(std::string_view object, const SonarConfig& sonar) {
  if (sonar.group_gains_db.size() > static_cast<std::size_t>(sonar.beam_count)) {
    fail(object, "group_gains_db",
         fmt::format(" has {} gains, must have at most one for each of beam_count = {}", sonar.group_gains_db.size(),
                     sonar.beam_count),
         {"beam_count"});
  }
  for (std::size_t i = 0; i < sonar.missing_beams.size(); ++i) {
    const int beam = sonar.missing_beams[i];
    if (beam >= sonar.beam_count) {
      fail(object, fmt::format("missing_beams[{}]", i),
           fmt::format(" = {} must be less than beam_count = {}", beam, sonar.beam_count), {"beam_count"});
    }
  }
}

// Straight up every azimuth is the same direction.
void check_elevations(std::string_view object, const SonarConfig& sonar) {
  const double steepest = std::abs(sonar.elevation_center) + sonar.elevation_aperture / 2;
  if (steepest > kSteepestElevation + kAngleSlack) {
    fail(object, "elevation_center_deg",
         fmt::format(" = {} with elevation_aperture_deg = {} reaches {}, must stay within "
                     "89 deg of level",
                     degrees(sonar.elevation_center), degrees(sonar.elevation_aperture), degrees(steepest)),
         {"elevation_aperture_deg"});
  }
  const double sent = std::abs(sonar.elevation_center) + sonar.sent_elevation_aperture() / 2;
  if (sent > kSteepestElevation + kAngleSlack) {
    fail(object, "transmit_elevation_aperture_deg",
         fmt::format(" = {} with elevation_center_deg = {} reaches {}, must stay within 89 deg of level",
                     degrees(sonar.sent_elevation_aperture()), degrees(sonar.elevation_center), degrees(sent)),
         {"elevation_center_deg"});
  }
}

void check_head(std::string_view object, const SonarConfig& sonar) {
  if (!sonar.scans()) {
    return;
  }
  if (sonar.beam_count != 1) {
    fail(object, "beam_count",
         fmt::format(" = {} must be 1 for type msis, whose head turns a single beam: say beam_count: 1",
                     sonar.beam_count),
         {"type"});
  }
  if (sonar.head.step == 0) {
    fail(object, "step_deg", " = 0 deg must not be 0 for type msis", {"type"});
  }
  if (sonar.head.sector_width < std::abs(sonar.head.step) - kAngleSlack) {
    fail(object, "sector_width_deg",
         fmt::format(" = {} must be at least one step_deg = {}", degrees(sonar.head.sector_width),
                     degrees(sonar.head.step)),
         {"step_deg"});
  }
}

// The settings of fans that a side-scan sonar does not have.
void check_sides(std::string_view object, const SonarConfig& sonar) {
  if (!sonar.is_side_scan()) {
    return;
  }
  const auto refuse = [&](bool given, std::string_view field, std::string_view instead) {
    if (given) {
      fail(object, field, fmt::format(" belongs to a fan; this one's type is sss{}", instead), {"type"});
    }
  };
  if (sonar.beam_count != 2) {
    fail(object, "beam_count",
         fmt::format(" = {} must be 2 for type sss, one beam to port and one to starboard", sonar.beam_count),
         {"type"});
  }
  constexpr double kWidestSide = radians_from_degrees(60);
  if (sonar.azimuth_aperture > kWidestSide + kAngleSlack) {
    fail(object, "azimuth_aperture_deg",
         fmt::format(" = {} must be at most 60 deg for type sss, whose beams are narrow along the track",
                     degrees(sonar.azimuth_aperture)),
         {"type"});
  }
  refuse(!sonar.beam_azimuths.empty(), "beam_azimuths_deg", ", whose beams look abeam");
  refuse(!sonar.beam_widths.empty(), "beam_widths_deg", ", whose beams are as wide as azimuth_aperture_deg");
  refuse(sonar.elevation_center != 0, "elevation_center_deg", ": say depression_deg");
  refuse(sonar.steering != Steering::kElectronic, "steering", ", whose beams are not steered");
}

// The fan of a multibeam looks down and reaches to both sides, but not to the horizontal.
void check_swath(std::string_view object, const SonarConfig& sonar) {
  if (!sonar.is_multibeam()) {
    return;
  }
  constexpr double kWidest = radians_from_degrees(170);
  if (sonar.azimuth_aperture > kWidest + kAngleSlack) {
    fail(object, "azimuth_aperture_deg",
         fmt::format(" = {} must be at most 170 deg for type mbes, whose swath is below it",
                     degrees(sonar.azimuth_aperture)),
         {"type"});
  }
  if (sonar.two_way_array) {
    fail(object, "two_way_array", " = true makes one beam; this one's type is mbes, a cross of two arrays", {"type"});
  }
  if (sonar.beam_spacing == BeamSpacing::kEquidistant && !sonar.beam_azimuths.empty()) {
    fail(object, "beam_spacing", " = equidistant has no effect beside beam_azimuths_deg", {"beam_azimuths_deg"});
  }
}

void check_transducers(std::string_view object, const SonarConfig& sonar) {
  if (sonar.elevation_pattern == BeamPattern::kInstrument) {
    fail(object, "elevation_pattern", " = instrument must be top_hat or a window: it is the instrument's");
  }
  const bool has_width = sonar.transmit_width || sonar.element_width;
  const char* const width = sonar.transmit_width ? "transmit_width_deg" : "element_width_deg";
  if ((sonar.scans() || sonar.is_side_scan()) && has_width) {
    fail(object, width,
         fmt::format(" belongs to a fan; this one's type is {}, whose azimuth_pattern applies both ways",
                     word_of(sonar.type)),
         {"type"});
  }
  if (sonar.two_way_array && has_width) {
    fail(object, width, " belongs to a transmitter of its own; with two_way_array the array transmits",
         {"two_way_array"});
  }
  if (sonar.two_way_array && sonar.beam_count != 1 && !sonar.is_side_scan()) {
    fail(object, "two_way_array",
         fmt::format(" = true transmits one beam, must be false with beam_count = {}", sonar.beam_count),
         {"beam_count"});
  }
}

void check_pulse(std::string_view object, const SonarConfig& sonar) {
  if (sonar.pulse == PulseKind::kInstrument) {
    fail(object, "pulse", " = instrument must be none, cw or lfm: it is the instrument's");
  }
  if (sonar.pulse == PulseKind::kLfm && sonar.pulse_duration * sonar.pulse_bandwidth < kLeastCompression) {
    fail(object, "pulse_bandwidth",
         fmt::format(" = {:.4g} Hz times {}.pulse_duration = {:.4g} s is {:.3g}, must be at least {} for a chirp",
                     sonar.pulse_bandwidth, object, sonar.pulse_duration, sonar.pulse_duration * sonar.pulse_bandwidth,
                     kLeastCompression),
         {"pulse_duration", "pulse"});
  }
  if (sonar.pulse == PulseKind::kLfm && sonar.pulse_bandwidth >= 2 * sonar.frequency) {
    fail(object, "pulse_bandwidth",
         fmt::format(" = {:.10g} Hz must be less than {:.10g} Hz, twice {}.frequency", sonar.pulse_bandwidth,
                     2 * sonar.frequency, object),
         {"frequency", "pulse"});
  }
}

}  // namespace

void SonarConfig::validate(std::string_view object) const {
  check_fields(object, *this);
  check_name(object, name);
  check_ranges(object, *this);
  check_cells(object, *this);
  check_channels(object, *this);
  check_beam_azimuths(object, *this);
  check_beam_widths(object, *this);
  check_elevations(object, *this);
  check_head(object, *this);
  check_sides(object, *this);
  check_swath(object, *this);
  check_pulse(object, *this);
  check_transducers(object, *this);
}

}  // namespace insonify
