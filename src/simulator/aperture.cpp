// aperture.cpp -- makes plan and receivers of an aperture from a sonar's settings.

#include "simulator/aperture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/names.h"
#include "receiver/array/line_array.h"
#include "receiver/array/steering.h"

namespace insonify {
namespace {

// The paper model has top-hat beams and no speckle.
ReceiverConfig receiver_of(const Scenario& scenario, const SonarConfig& sonar) {
  ReceiverConfig receiver = scenario.receiver_of(sonar);
  if (scenario.model == EchoModel::kPaper) {
    receiver.azimuth_pattern = receiver.elevation_pattern = BeamPattern::kTopHat;
    receiver.beam_shape = BeamShape::kWedge;
    receiver.speckle = false;
  }
  return receiver;
}

// The sonar with the bearings that its beams really have.
SonarConfig steered_by_water(const Scenario& scenario, const SonarConfig& sonar) {
  if (scenario.model == EchoModel::kCalibrated) {
    return steered_by_assumed_speed(sonar, scenario.water_at(sonar).true_sound_speed());
  }
  SonarConfig steered = sonar;
  steered.transmit_width.reset();
  steered.element_width.reset();
  steered.transmit_elevation_pattern = BeamPattern::kInstrument;
  steered.transmit_elevation_aperture.reset();
  return steered;
}

// The transmitter across elevations; none where it is as the receiver.
std::optional<ElevationWay> sent_across(const ReceiverConfig& receiver, const SonarConfig& sonar) {
  const BeamPattern pattern = sonar.sent_elevation_pattern(receiver);
  const double aperture = sonar.sent_elevation_aperture();
  if (pattern == sonar.elevation_pattern_beside(receiver) && aperture == sonar.elevation_aperture) {
    return {};
  }
  return ElevationWay{elevation_array(pattern, aperture, receiver, sonar), aperture};
}

// One-way gains of a two-way array in its cells, as BearingResponse has them both ways.
std::vector<float> array_gains(const ReceiverConfig& receiver, const SonarConfig& sonar, const BearingCells& cells) {
  std::vector<float> gains;
  if (!sonar.is_two_way() || receiver.azimuth_pattern == BeamPattern::kTopHat) {
    return gains;
  }
  const ArrayPattern array(receiving_array(receiver, sonar));
  const double length = array.length(1, beam_width(sonar)), middle = std::sin(sonar.beam_azimuth(0));
  for (const double sine : cells.grid.sines()) {
    gains.push_back(static_cast<float>(array.intensity(length * (sine - middle))));
  }
  return gains;
}

std::vector<float> cell_angles(const FlatPlan& plan) {
  std::vector<float> angles;
  angles.reserve(plan.beam_count);
  for (int cell = 0; cell < plan.beam_count; ++cell) {
    angles.push_back(static_cast<float>(plan.lattice.beam_angle(cell)));
  }
  return angles;
}

// Path orders of the grid: the largest number of surfaces on a path.
int order_count(const Scenario& scenario) {
  const int most = scenario.model == EchoModel::kPaper ? 2 : kPathOrders;
  return scenario.secondary == SecondaryEchoes::kNone ? 1 : std::min(most, scenario.max_surfaces);
}

std::vector<int> own_cells(const BearingCells& cells) {
  std::vector<int> own;
  for (const int first : cells.firsts) {
    for (int cell = first; cell < first + cells.per_beam; ++cell) {
      own.push_back(cell);
    }
  }
  return own;
}

// Walks start in the sonar's own beams: on either side of a scanning head's beam there are cells that only receive.
RandomWalks::Settings walk_settings(const Scenario& scenario, const SonarConfig& sonar, const BearingCells& cells,
                                    std::uint64_t seed) {
  return {.count = scenario.random_walks,
          .beams = own_cells(cells),
          .seed = seed ^ (std::uint64_t{name_hash(sonar.name)} << 32)};
}

// What a sonar's housing does after its apertures have received, they need not do: SideJoiner.
SonarConfig config_of(const Scenario& scenario, const SonarConfig& sonar, int index) {
  SonarConfig config = sonar.aperture(index);
  if (sonar.has_cones()) {
    config.receiver = scenario.receiver_of(sonar);
    config.receiver->beam_shape = BeamShape::kCone;  // A line along the track has it; it passes through straight down.
  }
  if (sonar.is_side_scan()) {
    config.receiver->counts = false;
    config.receiver->field = config.receiver->field || (sonar.crosstalk_db && config.receiver->speckle);
  }
  return config;
}

// Random numbers of one side are not those of the other.
std::uint64_t seed_of(std::uint64_t seed, int index) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;
  return seed ^ (kOdd * static_cast<std::uint64_t>(index));
}

}  // namespace

Aperture::Aperture(const Scenario& scenario, const SonarConfig& sonar, int index, std::span<const Material> materials)
    : config(config_of(scenario, sonar, index)),
      housing_from_aperture(sonar.housing_from_aperture(index)),
      seed(seed_of(scenario.seed, index)),
      steered(steered_by_water(scenario, config)),
      cells(steered, receiver_of(scenario, config),
            sonar.is_side_scan() ? BearingCells::kPerSide : BearingCells::kPerTwoWayBeam) {
  const ReceiverConfig beams = receiver_of(scenario, config);
  const bool calibrated = scenario.model == EchoModel::kCalibrated;
  plan = make_flat_plan({.sonar = steered,
                         .cells = cells.grid,
                         .columns_per_cell = cells.columns,
                         .water = scenario.water_at(config),
                         .model = scenario.model,
                         .paper = scenario.paper,
                         .materials = materials,
                         .elevation_array = elevation_array(steered.elevation_pattern_beside(beams),
                                                            steered.elevation_aperture, beams, steered),
                         .sent_across = sent_across(beams, steered),
                         .array_gains = calibrated ? array_gains(beams, steered, cells) : std::vector<float>{},
                         .primary = scenario.primary,
                         .secondary = scenario.secondary,
                         .max_surfaces = scenario.max_surfaces,
                         .rough_mirrors = scenario.rough_mirrors,
                         .seed = seed});
  layers = {.orders = order_count(scenario), .ground_truth = scenario.ground_truth, .labelled = beams.speckle};
  if (scenario.random_walks > 0) {
    walks = walk_settings(scenario, config, cells, seed);
  }
  add_receivers(scenario, materials, 1);
}

void Aperture::add_receivers(const Scenario& scenario, std::span<const Material> materials, std::size_t threads) {
  const std::vector<float> angles = cell_angles(*plan);
  while (scenario.model == EchoModel::kCalibrated && receivers.size() < threads) {
    receivers.push_back(std::make_unique<CalibratedReceiver>(
        CalibratedReceiver::Settings{.sonar = steered,
                                     .cells = cells,
                                     .cell_angles = angles,
                                     .water = scenario.water_at(config),
                                     .receiver = scenario.receiver_of(config),
                                     .materials = materials,
                                     .thrusters = scenario.thrusters,
                                     .moves = scenario.motion_in_ping,
                                     .seed = seed,
                                     .like = receivers.empty() ? nullptr : receivers.front().get()}));
  }
}

}  // namespace insonify
