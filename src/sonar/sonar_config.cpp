// sonar_config.cpp -- directions of a sonar's beams and head, and the checks of its configuration.

#include "insonify/sonar_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "insonify/error.h"

namespace insonify {
namespace {

constexpr double kFullCircle = 2 * std::numbers::pi;
// Tolerance for angles written in degrees, which conversion rounds.
constexpr double kAngleSlack = radians_from_degrees(1e-6);

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
  const std::vector<double> edges = sonar.beam_edges();
  if (edges.front() - edges.back() > kFullCircle + kAngleSlack) {
    fail(object, "beam_azimuths_deg",
         fmt::format(" make a fan of {}, must be at most 360 deg", degrees(edges.front() - edges.back())));
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
}

void check_head(std::string_view object, const SonarConfig& sonar) {
  if (sonar.type != SonarType::kMechanicallyScanned) {
    return;
  }
  if (sonar.beam_count != 1) {
    fail(object, "beam_count",
         fmt::format(" = {} must be 1 for type msis, whose head turns a single beam: say beam_count: 1",
                     sonar.beam_count),
         {"type"});
  }
  if (sonar.step == 0) {
    fail(object, "step_deg", " = 0 deg must not be 0 for type msis", {"type"});
  }
  if (sonar.sector_width < std::abs(sonar.step) - kAngleSlack) {
    fail(object, "sector_width_deg",
         fmt::format(" = {} must be at least one step_deg = {}", degrees(sonar.sector_width), degrees(sonar.step)),
         {"step_deg"});
  }
}

void check_transducers(std::string_view object, const SonarConfig& sonar) {
  if (sonar.elevation_pattern == BeamPattern::kInstrument) {
    fail(object, "elevation_pattern", " = instrument must be top_hat or a window: it is the instrument's");
  }
  if (sonar.type == SonarType::kMechanicallyScanned && (sonar.transmit_width || sonar.element_width)) {
    fail(object, sonar.transmit_width ? "transmit_width_deg" : "element_width_deg",
         " belongs to a fan; this one's type is msis, whose azimuth_pattern applies both ways", {"type"});
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

PulseSettings SonarConfig::transmitted(const ReceiverConfig& with) const {
  if (with.pulse == PulseKind::kInstrument) {
    return {.kind = pulse,
            .duration = pulse_duration,
            .bandwidth = pulse_bandwidth,
            .window = pulse_window,
            .side_lobe_db = with.pulse_side_lobe_db};
  }
  return {.kind = with.pulse,
          .duration = with.pulse_duration,
          .bandwidth = with.pulse_bandwidth,
          .window = with.pulse_window,
          .side_lobe_db = with.pulse_side_lobe_db};
}

double SonarConfig::beam_azimuth(int beam) const {
  if (!beam_azimuths.empty()) {
    return beam_azimuths[static_cast<std::size_t>(beam)];
  }
  return azimuth_aperture * (0.5 - (beam + 0.5) / beam_count);
}

Sampling SonarConfig::sampling_by_rule() const {
  constexpr double kColumn = radians_from_degrees(0.25);
  constexpr int kLeastColumns = 2, kMostColumns = 64;
  constexpr int kLeastRows = 128, kMostRows = 1024, kTogether = 16;  // Rows of a packet of rays.
  constexpr double kTallestRow = 2.0 / 70;  // Tangent from row to row, with which 170 degrees have some 800.
  const std::vector<double> edges = beam_edges();
  const double columns = std::ceil((edges.front() - edges.back()) / (beam_count * kColumn) - 1e-9);
  const double rows = std::max(0.5 * bin_count, 2 * std::tan(0.5 * elevation_aperture) / kTallestRow);
  const int packets = static_cast<int>(std::ceil(std::min<double>(rows, kMostRows) / kTogether));
  Sampling chosen = sampling;
  chosen.columns_per_beam =
      sampling.columns_per_beam.value_or(std::clamp(static_cast<int>(columns), kLeastColumns, kMostColumns));
  chosen.rows = sampling.rows.value_or(std::max(kLeastRows, packets * kTogether));
  return chosen;
}

std::vector<double> SonarConfig::beam_edges() const {
  std::vector<double> edges(static_cast<std::size_t>(beam_count) + 1);
  if (beam_azimuths.size() < 2) {
    const double middle = beam_azimuths.empty() ? 0 : beam_azimuths.front();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      edges[i] = middle + azimuth_aperture * (0.5 - static_cast<double>(i) / beam_count);
    }
    return edges;
  }
  for (std::size_t i = 1; i + 1 < edges.size(); ++i) {
    edges[i] = (beam_azimuths[i - 1] + beam_azimuths[i]) / 2;
  }
  edges.front() = 2 * beam_azimuths.front() - edges[1];
  edges.back() = 2 * beam_azimuths.back() - edges[edges.size() - 2];
  return edges;
}

Pose SonarConfig::vehicle_from_sonar() const {
  Pose pose{position, orientation_from_rpy(orientation.x(), orientation.y(), orientation.z())};
  if (mounting == Mounting::kVertical) {
    pose.orientation = pose.orientation * Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX());
  }
  return pose;
}

double SonarConfig::head_angle(std::uint64_t ping) const {
  if (type != SonarType::kMechanicallyScanned) {
    return 0;
  }
  if (sector_width > kFullCircle - kAngleSlack) {
    return sector_center + static_cast<double>(ping) * step;
  }
  // To and fro over `steps` steps: 0 1 2 .. steps .. 2 1 0 1 ..
  const auto steps = static_cast<std::uint64_t>((sector_width + kAngleSlack) / std::abs(step));
  const std::uint64_t phase = ping % (2 * steps);
  const std::uint64_t position_in_sector = std::min(phase, 2 * steps - phase);
  const double start = sector_center - std::copysign(sector_width / 2, step);
  return start + static_cast<double>(position_in_sector) * step;
}

std::uint64_t SonarConfig::pings_per_turn() const {
  if (type != SonarType::kMechanicallyScanned) {
    return 1;
  }
  if (sector_width > kFullCircle - kAngleSlack) {
    return static_cast<std::uint64_t>(std::ceil(kFullCircle / std::abs(step) - kAngleSlack));
  }
  return 1 + static_cast<std::uint64_t>((sector_width + kAngleSlack) / std::abs(step));
}

void SonarConfig::validate(std::string_view object) const {
  check_fields(object, *this);
  check_name(object, name);
  check_ranges(object, *this);
  check_cells(object, *this);
  check_channels(object, *this);
  check_beam_azimuths(object, *this);
  check_elevations(object, *this);
  check_head(object, *this);
  check_pulse(object, *this);
  check_transducers(object, *this);
}

}  // namespace insonify
