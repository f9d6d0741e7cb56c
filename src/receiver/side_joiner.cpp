// side_joiner.cpp -- interleaves the tables of two pings.

#include "receiver/side_joiner.h"

#include <cmath>
#include <complex>

#include "insonify/ground_truth.h"

namespace insonify {
namespace {

// Interleaves a table of `each` values per bin.
template <typename Value>
void interleave(std::vector<Value> Ping::*table, std::span<const Ping* const, 2> sides, std::size_t each, Ping& ping) {
  std::vector<Value>& joined = ping.*table;
  const std::vector<Value>& port = sides[0]->*table;
  joined.resize(2 * port.size());
  for (std::size_t side = 0; side < 2; ++side) {
    const std::vector<Value>& from = sides[side]->*table;
    for (std::size_t i = 0; i < from.size(); ++i) {
      joined[(2 * (i / each) + side) * each + i % each] = from[i];
    }
  }
}

}  // namespace

SideJoiner::SideJoiner(const SonarConfig& sonar, EchoModel model, const ReceiverConfig& receiver)
    : depression_(static_cast<float>(sonar.depression)),
      crosstalk_(model == EchoModel::kCalibrated && sonar.crosstalk_db
                     ? static_cast<float>(std::pow(10.0, *sonar.crosstalk_db / 20))
                     : 0),
      has_field_(receiver.field) {
  if (model == EchoModel::kCalibrated && receiver.counts) {
    digitizer_.emplace(sonar, receiver.full_scale_db.value_or(0), receiver.full_scale_share);
  }
}

void SideJoiner::add_crosstalk(const Ping& own, const Ping& other, int beam, Ping& ping) const {
  for (int bin = 0; bin < own.bin_count; ++bin) {
    const std::size_t at = ping.index(bin, beam);
    if (!own.field.empty()) {
      const std::complex<float> field = own.field[bin] + crosstalk_ * (own.field[bin] + other.field[bin]);
      ping.intensity[at] = std::norm(field);
      if (has_field_) {
        ping.field[at] = field;
      }
    } else {
      const float energy = crosstalk_ * crosstalk_;
      ping.intensity[at] =
          (1 + 2 * crosstalk_) * own.intensity[bin] + energy * (own.intensity[bin] + other.intensity[bin]);
    }
  }
}

void SideJoiner::join(std::span<const Ping* const, 2> sides, int covered_bins, Ping& ping) {
  ping.bin_count = sides[0]->bin_count;
  ping.beam_count = 2;
  interleave(&Ping::intensity, sides, 1, ping);
  ping.field.clear();
  ping.phase.clear();
  ping.soundings.clear();
  if (has_field_) {
    interleave(&Ping::field, sides, 1, ping);
  }
  interleave(&Ping::instance, sides, 1, ping);
  interleave(&Ping::material, sides, 1, ping);
  interleave(&Ping::elevation, sides, 1, ping);
  interleave(&Ping::strongest_instance, sides, kStrongestCount, ping);
  interleave(&Ping::strongest_share, sides, kStrongestCount, ping);
  interleave(&Ping::elevation_spread, sides, 1, ping);
  interleave(&Ping::path_order, sides, 1, ping);
  interleave(&Ping::shadow, sides, 1, ping);
  interleave(&Ping::direct_intensity, sides, 1, ping);
  for (float& elevation : ping.elevation) {
    elevation -= depression_;
  }
  if (crosstalk_ > 0) {
    add_crosstalk(*sides[0], *sides[1], 0, ping);
    add_crosstalk(*sides[1], *sides[0], 1, ping);
  }
  ping.counts.clear();
  if (digitizer_) {
    ping.counts.resize(ping.intensity.size());
    digitizer_->adapt(std::span(ping.intensity).subspan(2 * static_cast<std::size_t>(covered_bins)));
    digitizer_->digitize(ping.intensity, ping.counts);
  }
}

}  // namespace insonify
