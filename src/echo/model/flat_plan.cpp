// flat_plan.cpp -- computes the constants of a plan from its settings.

#include "echo/model/flat_plan.h"

#include "base/philox.h"
#include "insonify/acoustics/absorption.h"

namespace insonify {
namespace {

// Least gain of a two-way array that counts, one way: in a null, gains of cells and of echoes in them are not alike.
constexpr float kLeastArrayGain = 1e-3F;

BearingGrid cells_of(const FlatPlanSettings& settings) {
  if (settings.cells.count() > 0) {
    return settings.cells;
  }
  BearingGrid beams = settings.sonar.bearings();
  beams.shape = settings.beam_shape;
  return beams;
}

int columns_of(const FlatPlanSettings& settings) {
  return settings.columns_per_cell > 0 ? settings.columns_per_cell
                                       : settings.sonar.sampling.columns_per_beam.value_or(Sampling::kColumns);
}

std::vector<float> to_floats(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

FlatPlan::FlatPlan(const FlatPlanSettings& settings)
    : scatter(settings.materials, settings.sonar.frequency, settings.rough_mirrors) {
  const SonarConfig& sonar = settings.sonar;
  const BearingGrid cells = cells_of(settings);
  const ElevationPatterns patterns({settings.elevation_array, sonar.elevation_aperture}, settings.sent_across,
                                   sonar.elevation_center);
  lattice = Lattice(cells, columns_of(settings), sonar, patterns, settings.stagger_phase);
  set_sonar(sonar, settings.water);
  set_bearings(cells, settings);
  set_elevations(patterns);
  model = settings.model;
  shape = PaperShape(settings.paper);
  primary = settings.primary;
  secondary = settings.max_surfaces > 1 ? settings.secondary : SecondaryEchoes::kNone;
  max_surfaces = settings.max_surfaces;
  rough_mirrors = settings.rough_mirrors;
  seed = settings.seed;
  const auto purpose = static_cast<std::uint32_t>(RandomPurpose::kSecondarySelection);
  stagger = philox({0, 0, 0, purpose}, philox_key(settings.seed))[0];
}

void FlatPlan::set_sonar(const SonarConfig& sonar, const Water& water) {
  const double true_speed = water.true_sound_speed();
  const double scale = sonar.assumed_sound_speed.value_or(true_speed) / true_speed;
  bin_count = sonar.bin_count;
  frequency = sonar.frequency;
  source_level_db = sonar.source_level_db;
  elevation_center = sonar.elevation_center;
  elevation_aperture = sonar.elevation_aperture;
  transmitter = FanPattern(sonar.transmit_width);
  neper_per_metre = static_cast<float>(kNeperPerDecibel * water.absorption_db_per_m_at(sonar.frequency));
  range_per_metre = static_cast<float>(scale);
  true_max_range = static_cast<float>(sonar.max_range / scale);
  bins_per_metre = static_cast<float>(scale / sonar.bin_length());
  first_bin_at = static_cast<float>(sonar.min_range / scale);
  turns_per_metre = 2 * sonar.frequency / true_speed;
  middle_elevation = static_cast<float>(sonar.elevation_center);
}

void FlatPlan::set_bearings(const BearingGrid& cells, const FlatPlanSettings& settings) {
  beam_count = cells.count();
  port_edges = to_floats(cells.port);
  starboard_edges = to_floats(cells.starboard);
  beams_per_radian = static_cast<float>(beam_count) / (port_edges.front() - starboard_edges.back());
  // Guard cells of a table of beams do not count.
  azimuth_aperture = settings.sonar.beam_azimuths.size() > 1 ? settings.sonar.azimuth_aperture : cells.extent();
  two_way = !settings.array_gains.empty();
  for (int column = 0; column < lattice.columns && two_way; ++column) {
    const float gain = settings.array_gains[static_cast<std::size_t>(column / lattice.columns_per_beam)];
    lattice.transmitted[column] = std::max(gain, kLeastArrayGain);
  }
}

void FlatPlan::set_elevations(const ElevationPatterns& patterns) {
  const auto take = [](const ElevationPattern* pattern, PatternAxis& axis, std::vector<float>& table) {
    if (pattern != nullptr) {
      axis = pattern->axis();
      table = pattern->table();
    }
  };
  sends_apart = patterns.differ();
  take(patterns.sent(), sent_axis, sent_across);
  take(patterns.received(), received_axis, received_across);
  tan_low = static_cast<float>(std::tan(patterns.low()));
  tan_high = static_cast<float>(std::tan(patterns.high()));
}

// What a two-way array sends to a bearing is that of its cell's first column.
float FlatPlan::sent_to(const Arrival& arrival) const {
  return two_way ? lattice.transmitted[static_cast<std::size_t>(std::max(0, beam_of(arrival.bearing))) *
                                       lattice.columns_per_beam]
                 : arrival.transmitted;
}

float FlatPlan::sent_beside(int column, const Arrival& arrival) const {
  return sent_to(arrival) / lattice.transmitted[column];
}

double FlatPlan::sent_gain(const Arrival& leaves, const Arrival& arrives) const {
  const double across = leaves.sent == leaves.received ? 1.0
                        : leaves.received > 0          ? double{leaves.sent} / double{leaves.received}
                                                       : 0.0;
  return across * double{sent_to(leaves)} / (two_way ? double{sent_to(arrives)} : 1.0);
}

std::shared_ptr<const FlatPlan> make_flat_plan(const FlatPlanSettings& settings) {
  return std::make_shared<const FlatPlan>(settings);
}

}  // namespace insonify
