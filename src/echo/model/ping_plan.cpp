// ping_plan.cpp -- computes the constants of a plan from its settings.

#include "echo/model/ping_plan.h"

#include "base/philox.h"
#include "insonify/acoustics/absorption.h"

namespace insonify {
namespace {

// Least gain of a head that counts, one way: in a null, gains of cells and of echoes in them are not alike.
constexpr float kLeastHeadGain = 1e-3F;

std::optional<ElevationPattern> elevation_pattern_of(const PingPlanSettings& settings) {
  if (!settings.elevation_array) {
    return {};
  }
  return ElevationPattern(*settings.elevation_array, settings.sonar);
}

}  // namespace

PingPlan::PingPlan(const PingPlanSettings& settings)
    : sonar(settings.sonar),
      elevation_pattern(elevation_pattern_of(settings)),
      transmitter(settings.sonar.transmit_width),
      lattice(settings.sonar, settings.stagger_phase, settings.beam_shape,
              elevation_pattern ? &*elevation_pattern : nullptr),
      model(settings.model),
      shape(settings.paper),
      scatter(settings.materials, settings.sonar.frequency, settings.rough_mirrors),
      primary(settings.primary),
      secondary(settings.max_surfaces > 1 ? settings.secondary : SecondaryEchoes::kNone),
      max_surfaces(settings.max_surfaces),
      rough_mirrors(settings.rough_mirrors) {
  const double true_speed = settings.water.true_sound_speed();
  const double scale = sonar.assumed_sound_speed.value_or(true_speed) / true_speed;
  neper_per_metre = static_cast<float>(kNeperPerDecibel * settings.water.absorption_db_per_m_at(sonar.frequency));
  range_per_metre = static_cast<float>(scale);
  true_max_range = static_cast<float>(sonar.max_range / scale);
  bins_per_metre = static_cast<float>(scale / sonar.bin_length());
  first_bin_at = static_cast<float>(sonar.min_range / scale);
  turns_per_metre = 2 * sonar.frequency / true_speed;
  seed = settings.seed;
  middle_elevation = static_cast<float>(sonar.elevation_center);
  const auto purpose = static_cast<std::uint32_t>(RandomPurpose::kSecondarySelection);
  stagger = philox({0, 0, 0, purpose}, philox_key(settings.seed))[0];
  for (const double edge : sonar.beam_edges()) {
    beam_edges_.push_back(static_cast<float>(edge));
  }
  const double half = 0.5 * sonar.elevation_aperture;
  tan_low_ = static_cast<float>(std::tan(elevation_pattern ? elevation_pattern->low() : sonar.elevation_center - half));
  tan_high_ =
      static_cast<float>(std::tan(elevation_pattern ? elevation_pattern->high() : sonar.elevation_center + half));
  beams_per_radian_ = static_cast<float>(sonar.beam_count) / (beam_edges_.front() - beam_edges_.back());
  for (int column = 0; column < lattice.columns && !settings.head_gains.empty(); ++column) {
    const float gain = settings.head_gains[static_cast<std::size_t>(column / lattice.columns_per_beam)];
    lattice.transmitted[column] = std::max(gain, kLeastHeadGain);
  }
}

// What a head sends to a bearing is that of its cell's first column.
float PingPlan::sent_to(const Arrival& arrival) const {
  return is_head() ? lattice.transmitted[std::max(0, beam_of(arrival.bearing)) * lattice.columns_per_beam]
                   : arrival.transmitted;
}

float PingPlan::sent_beside(int column, const Arrival& arrival) const {
  return sent_to(arrival) / lattice.transmitted[column];
}

double PingPlan::sent_gain(const Arrival& leaves, const Arrival& arrives) const {
  return double{sent_to(leaves)} / (is_head() ? double{sent_to(arrives)} : 1.0);
}

std::shared_ptr<const PingPlan> make_ping_plan(const PingPlanSettings& settings) {
  return std::make_shared<const PingPlan>(settings);
}

}  // namespace insonify
