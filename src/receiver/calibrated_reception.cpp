// calibrated_reception.cpp -- the steps of a CalibratedReceiver that engines can do where the echoes are, as tables.

#include <cmath>

#include "receiver/calibrated_receiver.h"

namespace insonify {

bool CalibratedReceiver::is_flat() const {
  constexpr int kMostBins = 65535;  // Numbers of bins have 16 bits.
  return speckle_ && !clutter_->any() && !sparse_->any() && !shift_ && !keeps_looks_ && !phase_ && bins_ <= kMostBins &&
         (!bearing_ || bearing_->keeps_all());
}

FlatReceiver CalibratedReceiver::flattened() const {
  FlatReceiver flat;
  flat.cells = cells_;
  flat.bins = bins_;
  flat.beams = beams_;
  flat.cells_per_beam = cells_per_beam_;
  flat.first_cells = first_cells_;
  flat.volume = volume_;
  flat.cell_angle = cell_angle_;
  flat.ranges = lattice_->ranges();
  flat.lattice = lattice_->shape();
  flat.speckle = speckle_->shape();
  flat.seed = philox_key(seed_);
  if (range_) {
    flat.has_pulse = true;
    flat.look_share = coarse_->share();
    flat.look_pairs = coarse_->pairs();
    flat.first_tap = range_->first_tap();
    flat.taps.assign(range_->amplitudes().begin(), range_->amplitudes().end());
  }
  if (bearing_) {
    flat.zones = bearing_->zones();
  }
  if (noise_ && !channels_ && !thrusters_) {
    flat.noise_rows = noise_->rows();
    flat.noise_taps = noise_->taps();
    flat.noise_gains = noise_->gains();
  }
  return flat;
}

// Sets each beam's noise level; the surface's noise depends on the beam's direction.
void CalibratedReceiver::set_noise_levels(const Pose& world_from_sonar, std::vector<float>& deviations) {
  deviations.assign(static_cast<std::size_t>(beams_), std::sqrt(0.5F * isotropic_noise_));
  if (!surface_noise_) {
    return;
  }
  surface_noise_->receive(world_from_sonar.orientation, surface_shares_);
  for (std::size_t beam = 0; beam < deviations.size(); ++beam) {
    const double intensity = double{isotropic_noise_} + surface_noise_level_ * surface_shares_[beam];
    deviations[beam] = static_cast<float>(std::sqrt(0.5 * intensity));
  }
}

void CalibratedReceiver::aim(std::span<const DisplacedInstance> displaced, const Pose& world_from_sonar,
                             Reception& reception) {
  reception.receiver = flat_;
  reception.axes.clear();
  reception.instances.clear();
  views_.set(world_from_sonar, displaced);
  const auto add_axes = [&](const SpeckleView& view) {
    for (int cell = 0; cell < cells_; ++cell) {
      reception.axes.push_back(lattice_->axes_of(cell, view));
    }
  };
  add_axes(views_.world);
  for (const SpeckleViews::OfObject& object : views_.objects) {
    add_axes(object.view);
    reception.instances.push_back(object.instance);
  }
  set_noise_levels(world_from_sonar, reception.noise_deviation);
}

}  // namespace insonify
