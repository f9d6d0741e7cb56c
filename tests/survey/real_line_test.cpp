// real_line_test.cpp -- the bottom of a real line against the altitude that its vehicle has stored.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "insonify/recorded_pings.h"
#include "insonify/survey/bottom_track.h"
#include "support/test_files.h"

namespace insonify::real_line_test {
namespace {

struct Errors {
  double median = 0, least_of_95 = 0;  // Of the errors, and of their magnitudes [m].
};

Errors errors_of(const std::vector<double>& differences) {
  std::vector<double> sorted = differences, magnitudes = differences;
  std::ranges::sort(sorted);
  std::ranges::for_each(magnitudes, [](double& value) { value = std::abs(value); });
  std::ranges::sort(magnitudes);
  return {sorted[sorted.size() / 2], magnitudes[magnitudes.size() * 95 / 100]};
}

// 460 pings of an AUV that dives from 11.4 to 2.6 m above the bed, most of the way with its nose 22 degrees down. Both
// sides find the same range. Ranges alone are too long: taking out the pitch leaves a share that fits beams which end
// 65 degrees below the horizontal, an angle that the file does not say and that is fitted here.
TEST(RealLineTest, TheBottomIsAtTheStoredAltitude) {
  INSONIFY_REAL_DATA(xtf, "opensidescan_xtf_wreck/scotsman-iver2.xtf");
  const RecordedPings pings(xtf);
  const SonarConfig sonar = pings.sonar_config();
  BottomTracker tracker(sonar), steep(sonar, {.first_return_angle = radians_from_degrees(65)});
  for (std::uint64_t ping = 0; ping < pings.ping_count(); ++ping) {
    tracker.add(pings.ping(ping));
    steep.add(pings.ping(ping));
  }
  const BottomTrack track = tracker.finish(), fitted = steep.finish();
  std::vector<double> ranges, levels, fits, sides;
  for (std::uint64_t ping = 0; ping < pings.ping_count(); ++ping) {
    if (const std::optional<double> stored = pings.altitude(ping)) {
      ranges.push_back(track.range[ping] - *stored);
      levels.push_back(track.altitude[ping] - *stored);
      fits.push_back(fitted.altitude[ping] - *stored);
      sides.push_back(track.side_range[2 * ping] - track.side_range[2 * ping + 1]);
      EXPECT_GT(track.quality[ping], BottomTrack::kNoBottom) << ping;
    }
  }
  ASSERT_EQ(ranges.size(), 460);
  const Errors range = errors_of(ranges), level = errors_of(levels), fit = errors_of(fits), side = errors_of(sides);
  const auto record = [](const char* name, const Errors& errors) {
    testing::Test::RecordProperty(name, std::to_string(errors.median) + " " + std::to_string(errors.least_of_95));
  };
  record("range - altitude", range);
  record("with pitch", level);
  record("beams to 65 degrees", fit);
  record("port - starboard", side);
  EXPECT_LT(std::abs(side.median), 0.06);  // Two bins.
  EXPECT_LT(side.least_of_95, 0.15);
  EXPECT_LT(level.least_of_95, 1.2);
  EXPECT_LT(std::abs(fit.median), 0.1);
  EXPECT_LT(fit.least_of_95, 0.5);
}

}  // namespace
}  // namespace insonify::real_line_test
