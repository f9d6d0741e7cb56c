// sonar_config.cpp -- directions of a sonar's beams, apertures and head, and its pulse.

#include "insonify/sonar_config.h"

#include <algorithm>
#include <cmath>

#include "sonar/angle_slack.h"

namespace insonify {
namespace {

constexpr double kAbeam = 0.5 * std::numbers::pi;  // Azimuth of a side-scan sonar's port beam.

}  // namespace

std::optional<SonarType> SonarConfig::only_type(std::string_view field) {
  if (field == "step" || field == "sector_center" || field == "sector_width" || field == "mounting") {
    return SonarType::kMechanicallyScanned;
  }
  if (field == "beam_spacing" || field.ends_with("_stabilised")) {
    return SonarType::kMultibeam;
  }
  return field == "depression" ? std::optional(SonarType::kSideScan) : std::nullopt;
}

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

SonarConfig SonarConfig::aperture(int index) const {
  SonarConfig side = *this;
  if (!is_side_scan()) {
    return side;
  }
  side.type = SonarType::kForwardLooking;
  side.beam_count = 1;
  side.two_way_array = true;
  side.crosstalk_db.reset();  // Between sides.
  if (!group_gains_db.empty()) {
    side.group_gains_db = {index == 0 ? group_gains_db.front() : group_gains_db.back()};
  }
  side.missing_beams.clear();
  if (std::ranges::find(missing_beams, index) != missing_beams.end()) {
    side.missing_beams.push_back(0);
  }
  return side;
}

Pose SonarConfig::housing_from_aperture(int index) const {
  return is_side_scan() ? Pose{Vec3::Zero(), orientation_from_rpy(0, depression, index == 0 ? kAbeam : -kAbeam)}
                        : Pose{};
}

double SonarConfig::beam_azimuth(int beam) const {
  if (is_side_scan()) {
    return beam == 0 ? kAbeam : -kAbeam;
  }
  if (!beam_azimuths.empty()) {
    return beam_azimuths[static_cast<std::size_t>(beam)];
  }
  const double place = 0.5 - (beam + 0.5) / beam_count;
  return beam_spacing == BeamSpacing::kEquidistant ? std::atan(2 * place * std::tan(0.5 * azimuth_aperture))
                                                   : azimuth_aperture * place;
}

Sampling SonarConfig::sampling_by_rule() const {
  constexpr double kColumn = radians_from_degrees(0.25);
  constexpr int kLeastColumns = 2, kMostColumns = 64;
  constexpr int kLeastRows = 128, kMostRows = 1024, kTogether = 16;  // Rows of a packet of rays.
  constexpr double kTallestRow = 2.0 / 70;  // Tangent from row to row, with which 170 degrees have some 800.
  const double columns = std::ceil(bearings().covered() / (beam_count * kColumn) - 1e-9);
  // The bins of a multibeam are crossed from column to column; its rows sample the lobes along the track. A side-scan
  // sonar looks along the bed, where a row covers many bins.
  const double rows_per_bin = is_multibeam() ? 0 : is_side_scan() ? 2 : 0.5;
  const double rows =
      std::max(rows_per_bin * bin_count, is_multibeam() ? 0 : 2 * std::tan(0.5 * elevation_aperture) / kTallestRow);
  const int packets = static_cast<int>(std::ceil(std::min<double>(rows, kMostRows) / kTogether));
  Sampling chosen = sampling;
  chosen.columns_per_beam =
      sampling.columns_per_beam.value_or(std::clamp(static_cast<int>(columns), kLeastColumns, kMostColumns));
  chosen.rows = sampling.rows.value_or(std::max(kLeastRows, packets * kTogether));
  return chosen;
}

BearingGrid SonarConfig::bearings() const {
  if (is_side_scan()) {
    BearingGrid sides = BearingGrid::even(kAbeam, azimuth_aperture, 1);
    sides.add(BearingGrid::even(-kAbeam, azimuth_aperture, 1));
    return sides;
  }
  BearingGrid grid;
  if (beam_azimuths.size() > 1) {
    grid = BearingGrid::touching(beam_azimuths);
  } else if (beam_spacing == BeamSpacing::kEquidistant && beam_count > 1) {
    std::vector<double> centres;
    for (int beam = 0; beam < beam_count; ++beam) {
      centres.push_back(beam_azimuth(beam));
    }
    grid = BearingGrid::touching(centres);
  } else {
    grid = BearingGrid::even(beam_azimuths.empty() ? 0 : beam_azimuths.front(), azimuth_aperture, beam_count);
  }
  for (int beam = 0; beam < grid.count() && !beam_widths.empty(); ++beam) {
    const double width = beam_widths[std::min<std::size_t>(beam, beam_widths.size() - 1)];
    grid.port[beam] = grid.centres[beam] + 0.5 * width;
    grid.starboard[beam] = grid.centres[beam] - 0.5 * width;
    if (beam > 0 && std::abs(grid.starboard[beam - 1] - grid.port[beam]) < kAngleSlack) {
      grid.port[beam] = grid.starboard[beam - 1];  // They touch, but for rounding.
    }
  }
  return grid;
}

void SonarConfig::set_bearings(const BearingGrid& grid) {
  beam_count = grid.count();
  beam_azimuths = grid.centres;
  beam_widths.clear();
  for (int beam = 0; beam < grid.count(); ++beam) {
    beam_widths.push_back(grid.width(beam));
  }
  azimuth_aperture = grid.extent();
}

Pose SonarConfig::vehicle_from_sonar() const {
  Pose pose{position, orientation_from_rpy(orientation.x(), orientation.y(), orientation.z())};
  if (head.mounting == Mounting::kVertical) {
    pose.orientation = pose.orientation * Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX());
  }
  if (is_multibeam()) {
    pose.orientation = pose.orientation * Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY());
  }
  return pose;
}

}  // namespace insonify
