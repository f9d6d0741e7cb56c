// calibrated_receiver.cpp -- sums of intensity.

#include "receiver/calibrated_receiver.h"

namespace insonify {

CalibratedReceiver::CalibratedReceiver(const EchoGrid& grid, const SonarConfig& sonar, Ping& ping)
    : grid_(grid), sonar_(sonar), ping_(ping) {
  size_tables(grid, ping);
}

void CalibratedReceiver::take(int first_beam, int last_beam) {
  for_each_tile(first_beam, last_beam, grid_.bin_count(), [&](const TilePlace& place) { hear_tile(place); });
}

void CalibratedReceiver::hear_tile(const TilePlace& place) {
  HeardTile tile = {};
  for (int b = 0; b < place.beam_count; ++b) {
    fetch_rows(place, b, ping_);
    for (int order = 1; order <= grid_.order_count(); ++order) {
      const std::span<const float> energy = grid_.energy(order, place.first_beam + b);
      for (int i = 0; i < place.bin_count; ++i) {
        tile.intensity[b][i] += energy[place.first_bin + i];
      }
    }
    for (int i = 0; i < place.bin_count; ++i) {
      const float ramp = near_field(sonar_, place.first_bin + i);
      tile.intensity[b][i] *= ramp * ramp;
    }
    take_labels(grid_, place, b, tile);
  }
  write_tile(tile, place, ping_);
}

}  // namespace insonify
