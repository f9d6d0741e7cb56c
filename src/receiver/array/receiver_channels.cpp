// receiver_channels.cpp -- tabulates the gains of beams and couples beams.

#include "receiver/array/receiver_channels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace insonify {
namespace {

constexpr int kCoupledBins = 64;  // Bins of a task.

}  // namespace

ReceiverChannels::ReceiverChannels(const SonarConfig& sonar) : beams_(sonar.beam_count), bins_(sonar.bin_count) {
  const std::size_t groups = sonar.group_gains_db.size(), beams = static_cast<std::size_t>(beams_);
  if (groups > 0 || !sonar.missing_beams.empty()) {
    gains_.assign(beams, 1.0F);
  }
  for (std::size_t beam = 0; groups > 0 && beam < beams; ++beam) {
    gains_[beam] = static_cast<float>(std::pow(10.0, sonar.group_gains_db[beam * groups / beams] / 10));
  }
  for (const int beam : sonar.missing_beams) {
    gains_[static_cast<std::size_t>(beam)] = 0;
  }
  crosstalk_ = sonar.crosstalk_db ? static_cast<float>(std::pow(10.0, *sonar.crosstalk_db / 20)) : 0;
}

template <typename Value>
void ReceiverChannels::couple(std::span<Value> beams, float own, float share, Workers& workers) const {
  if (share == 0) {
    return;
  }
  workers.for_each((bins_ + kCoupledBins - 1) / kCoupledBins, [&](int task, int) {
    const int first = task * kCoupledBins, count = std::min(kCoupledBins, bins_ - first);
    std::array<Value, kCoupledBins> sums = {};
    for (int beam = 0; beam < beams_; ++beam) {
      const Value* const row = &beams[static_cast<std::size_t>(beam) * bins_ + first];
      for (int i = 0; i < count; ++i) {
        sums[i] += row[i];
      }
    }
    for (int beam = 0; beam < beams_; ++beam) {
      Value* const row = &beams[static_cast<std::size_t>(beam) * bins_ + first];
      for (int i = 0; i < count; ++i) {
        row[i] = own * row[i] + share * sums[i];
      }
    }
  });
}

void ReceiverChannels::couple_energy(std::span<float> beams, Workers& workers) const {
  couple(beams, 1 + 2 * crosstalk_, crosstalk_ * crosstalk_, workers);
}

void ReceiverChannels::couple_field(std::span<std::complex<float>> beams, Workers& workers) const {
  couple(beams, 1.0F, crosstalk_, workers);
}

void ReceiverChannels::receive_truth(Ping& ping) const {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t beam = 0; beam < gains_.size(); ++beam) {
    for (int bin = 0; bin < bins_; ++bin) {
      const std::size_t at = ping.index(bin, static_cast<int>(beam));
      if (!ping.direct_intensity.empty()) {
        ping.direct_intensity[at] *= gains_[beam];
      }
      if (gains_[beam] > 0 || ping.instance.empty()) {
        continue;
      }
      ping.instance[at] = ping.material[at] = kNoLabel;
      ping.elevation[at] = kNone;
      if (!ping.path_order.empty()) {
        std::fill_n(&ping.strongest_instance[kStrongestCount * at], kStrongestCount, kNoLabel);
        std::fill_n(&ping.strongest_share[kStrongestCount * at], kStrongestCount, 0.0F);
        ping.elevation_spread[at] = kNone;
        ping.path_order[at] = 0;
      }
    }
  }
}

}  // namespace insonify
