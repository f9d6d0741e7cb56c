// reception_shift_test.cpp -- where echoes of a moving sonar come from, cell by cell, against the equations themselves.

#include "receiver/reception_shift.h"

#include <gtest/gtest.h>

#include <cmath>

namespace insonify::reception_shift_test {
namespace {

constexpr double kSoundSpeed = 1500, kBias = 2e-4;

SonarConfig fan() {
  SonarConfig sonar;
  sonar.beam_count = 90;
  sonar.azimuth_aperture = radians_from_degrees(90);
  sonar.min_range = 1;
  sonar.max_range = 81;
  sonar.bin_count = 400;
  sonar.sampling = {2, 16};
  return sonar;
}

// The source of a bin by the equations of ReceptionShift, at this bin alone.
// @param share  Share of the shift of the bearing.
int source_of(const BearingGrid& cells, const SonarConfig& sonar, const PingMotion& motion, int cell, int bin,
              double share) {
  const double received = sonar.bin_range(bin), time = 2 * received / kSoundSpeed;
  const Vec3& v = motion.velocity;
  const double shown = cells.centres[cell] + share * motion.turn_rate * time;
  const double azimuth = shown + share * 2 * (v.y() * std::cos(shown) - v.x() * std::sin(shown)) / kSoundSpeed;
  const double speed = v.x() * std::cos(azimuth) + v.y() * std::sin(azimuth);
  const double range = (received + kBias * speed) / (1 - speed / kSoundSpeed);
  const double position = (range - sonar.min_range) / sonar.bin_length();
  const int from = cells.last_before(azimuth, 0);
  const bool inside = cells.has(from, azimuth) && position >= 0 && position < sonar.bin_count;
  return inside ? from * sonar.bin_count + static_cast<int>(position) : -1;
}

// Bins of all cells whose source differs, other than by rounding at an edge: by one bin or one cell.
int differing(const SonarConfig& sonar, const PingMotion& motion, double share) {
  ReceiverConfig receiver;
  receiver.azimuth_pattern = BeamPattern::kTopHat;
  const BearingCells cells(sonar, receiver);
  ReceptionShift shift(cells, sonar, 1, kSoundSpeed, kBias, false);
  Workers workers(1);
  shift.prepare(motion, workers);
  int different = 0;
  for (int cell = 0; cell < cells.grid.count(); ++cell) {
    for (int bin = 0; bin < sonar.bin_count; ++bin) {
      different += shift.sources(cell)[bin] != source_of(cells.grid, sonar, motion, cell, bin, share) ? 1 : 0;
    }
  }
  return different;
}

// A turn of 80 degrees while 81 m are listened to, at 30 m/s: speed of approach and bearing change all the while.
TEST(ReceptionShiftTest, PiecesFollowTheEquationsWhileTheSonarTurnsFar) {
  const double listening = 2 * 81 / kSoundSpeed;
  for (const double turn : {-80.0, 7.0, 80.0}) {
    const PingMotion motion{.velocity = {21, -22, 0}, .turn_rate = radians_from_degrees(turn) / listening};
    // 36 000 cells: some have an edge where the pieces' 50 um matter.
    EXPECT_LT(differing(fan(), motion, 1), 40) << turn;
  }
}

// A single beam as wide as the fan, by an array that transmits too.
TEST(ReceptionShiftTest, ArraysThatTransmitTooReceiveMidway) {
  SonarConfig sonar = fan();
  sonar.beam_count = 1;
  sonar.two_way_array = true;
  const PingMotion motion{.velocity = {0, 12, 0}, .turn_rate = 3};
  EXPECT_LT(differing(sonar, motion, 0.5), 2);
  EXPECT_GT(differing(sonar, motion, 1), 10);
}

}  // namespace
}  // namespace insonify::reception_shift_test
