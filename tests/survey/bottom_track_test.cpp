// bottom_track_test.cpp -- first returns of beds at known altitudes, with noise, fish, gains and inclined beams, and a
// real line.

#include "insonify/survey/bottom_track.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/message_of.h"
#include "survey/line.h"

namespace insonify::bottom_track_test {
namespace {

// The running median of 7 bins of 5 cm, and speckle that may be weak in the first bins.
constexpr double kWithin = 0.25;  // [m]

double altitude_at(int ping) {
  return 8 + 3 * std::sin(ping / 20.0);
}

std::vector<Ping> line_of(const SonarConfig& sonar, int count, double noise_db) {
  std::mt19937 random(7);
  std::vector<Ping> pings;
  for (int ping = 0; ping < count; ++ping) {
    pings.push_back(bed_ping(sonar, altitude_at(ping), noise_db, random, static_cast<std::uint64_t>(ping)));
  }
  return pings;
}

void expect_altitudes(const BottomTrack& track, double within = kWithin) {
  for (std::size_t ping = 0; ping < track.altitude.size(); ++ping) {
    EXPECT_NEAR(track.altitude[ping], altitude_at(static_cast<int>(ping)), within) << ping;
    EXPECT_GT(track.quality[ping], BottomTrack::kNoBottom) << ping;
  }
}

TEST(BottomTrackTest, FollowsTheAltitude) {
  const SonarConfig sonar = side_scan_sonar();
  const BottomTrack track = track_bottom(line_of(sonar, 120, 30), sonar);
  ASSERT_EQ(track.altitude.size(), 120);
  ASSERT_EQ(track.side_range.size(), 240);
  expect_altitudes(track);
}

TEST(BottomTrackTest, FollowsItThroughNoiseOfATenthOfTheBed) {
  const SonarConfig sonar = side_scan_sonar();
  expect_altitudes(track_bottom(line_of(sonar, 120, 10), sonar), 2 * kWithin);
}

// A water column 80 dB below the bed's first return, and before this the flank of a pulse 60, 50 and 40 dB below it.
TEST(BottomTrackTest, FlanksOfThePulseAreNotTheBottom) {
  const SonarConfig sonar = side_scan_sonar();
  std::mt19937 random(3);
  std::vector<Ping> pings;
  for (int number = 0; number < 20; ++number) {
    Ping& ping = pings.emplace_back(bed_ping(sonar, 8, 80, random, static_cast<std::uint64_t>(number)));
    for (int bin = 157; bin < 160; ++bin) {
      ping.intensity[ping.index(bin, 0)] = ping.intensity[ping.index(bin, 1)] =
          static_cast<float>(std::pow(10, bin - 163));
    }
  }
  for (const double altitude : track_bottom(pings, sonar).altitude) {
    EXPECT_NEAR(altitude, 8, 0.025);  // Half a bin.
  }
}

// A receiver that is silent for up to 0.5 m, then a water column that rises by 30 log r to 40 dB below the bed: the end
// of the silence is the sharper edge, and the rise is steep at first.
TEST(BottomTrackTest, BlankingAndTimeVariedGainAreNotTheBottom) {
  const SonarConfig sonar = side_scan_sonar();
  for (const int silent : {0, 4, 10}) {
    std::vector<Ping> pings = line_of(sonar, 120, 40);
    for (Ping& ping : pings) {
      for (int bin = 0; bin < sonar.bin_count; ++bin) {
        const double gain = bin < silent ? 0 : std::pow(sonar.bin_range(bin), 3);
        ping.intensity[ping.index(bin, 0)] *= static_cast<float>(gain);
        ping.intensity[ping.index(bin, 1)] *= static_cast<float>(gain);
      }
    }
    expect_altitudes(track_bottom(pings, sonar));
  }
}

TEST(BottomTrackTest, OneSideIsEnough) {
  SonarConfig sonar = side_scan_sonar();
  sonar.beam_count = 1;
  sonar.type = SonarType::kForwardLooking;
  sonar.beam_azimuths = {-std::numbers::pi / 2};
  expect_altitudes(track_bottom(line_of(sonar, 60, 30), sonar));
}

// Decisions wait for 512 pings: a line of 1200 is decided in three parts.
TEST(BottomTrackTest, ALongLineIsTrackedInParts) {
  SonarConfig sonar = side_scan_sonar();
  sonar.bin_count = 200;
  const BottomTrack track = track_bottom(line_of(sonar, 1200, 30), sonar);
  ASSERT_EQ(track.altitude.size(), 1200);
  expect_altitudes(track, 3 * 0.2);  // Three bins, the reach of the median.
}

// A school of fish 1 m deep at 4 m, as bright as the bed, over 30 pings; and a strong single echo in every ping.
TEST(BottomTrackTest, FishDoNotCatchIt) {
  const SonarConfig sonar = side_scan_sonar();
  std::vector<Ping> pings = line_of(sonar, 120, 30);
  for (int ping = 0; ping < 120; ++ping) {
    for (int bin = 0; bin < sonar.bin_count; ++bin) {
      const bool school = ping >= 40 && ping < 70 && std::abs(sonar.bin_range(bin) - 4) < 0.5;
      const bool fish = bin == 20 + 7 * ping % 60;
      if (school || fish) {
        pings[ping].intensity[pings[ping].index(bin, 0)] = fish ? 10 : 1;
        pings[ping].intensity[pings[ping].index(bin, 1)] = fish ? 10 : 1;
      }
    }
  }
  expect_altitudes(track_bottom(pings, sonar));
}

// Behind a wall at 15 m the bed is dark up to 25 m, over 60 pings: its far edge is sharper than the bed's first return.
TEST(BottomTrackTest, TheEndOfAShadowIsNotTheBottom) {
  const SonarConfig sonar = side_scan_sonar();
  std::vector<Ping> pings = line_of(sonar, 120, 30);
  for (int ping = 30; ping < 90; ++ping) {
    for (int bin = 300; bin < 500; ++bin) {
      pings[ping].intensity[pings[ping].index(bin, 0)] = 1e-4F;
      pings[ping].intensity[pings[ping].index(bin, 1)] = 1e-4F;
    }
  }
  expect_altitudes(track_bottom(pings, sonar));
}

// Levels against range over the bed's first return, r / h, in a silent column; both sides have speckle of their own.
template <typename LevelDb>
std::vector<Ping> line_of_levels(const SonarConfig& sonar, const LevelDb& level_db) {
  std::mt19937 random(5);
  std::exponential_distribution<double> speckle(1);
  std::vector<Ping> pings;
  for (int number = 0; number < 120; ++number) {
    Ping& ping = pings.emplace_back(dark_ping(sonar, static_cast<std::uint64_t>(number)));
    for (int bin = 0; bin < sonar.bin_count; ++bin) {
      const double level = std::pow(10, level_db(sonar.bin_range(bin) / altitude_at(number)) / 10);
      for (const int beam : {0, 1}) {
        ping.intensity[ping.index(bin, beam)] = static_cast<float>(level * speckle(random));
      }
    }
  }
  return pings;
}

// The sea surface is heard from half of the bed's range on, 45 to 32 dB below the bed, which rises by 22 dB from nadir
// to the main lobe: the surface is the sharper edge.
TEST(BottomTrackTest, AFaintEchoOfTheSurfaceIsNotTheBottom) {
  const SonarConfig sonar = side_scan_sonar();
  const auto level_db = [](double ratio) {
    return ratio < 0.5 ? -90 : ratio < 1 ? -45 + 13 * (ratio - 0.5) / 0.5 : -22 + 22 * std::min(1.0, (ratio - 1) / 0.8);
  };
  expect_altitudes(track_bottom(line_of_levels(sonar, level_db), sonar), 1);
}

// A bed that is 30 dB fainter at nadir than in the main lobe, in noise that rises by 30 log r: its first return is
// still the bottom.
TEST(BottomTrackTest, ABedBelowTheMainLobeIsTheBottom) {
  const SonarConfig sonar = side_scan_sonar();
  const auto level_db = [](double ratio) {
    const double noise = -45 + 30 * std::log10(std::min(ratio, 1.0));
    return ratio < 1 ? noise : -30 + 30 * std::min(1.0, (ratio - 1) / 0.4);
  };
  expect_altitudes(track_bottom(line_of_levels(sonar, level_db), sonar), 1);
}

// Ten pings of noise alone: the track goes on between those around them, and says that it guesses.
TEST(BottomTrackTest, LostPingsAreBridged) {
  const SonarConfig sonar = side_scan_sonar();
  std::vector<Ping> pings = line_of(sonar, 60, 30);
  std::mt19937 random(8);
  for (int ping = 25; ping < 35; ++ping) {
    pings[ping] = bed_ping(sonar, 1e6, 30, random);
  }
  const BottomTrack track = track_bottom(pings, sonar);
  for (int ping = 25; ping < 35; ++ping) {
    EXPECT_LT(track.quality[ping], BottomTrack::kNoBottom) << ping;
  }
  EXPECT_NEAR(track.altitude[24], altitude_at(24), kWithin);
  EXPECT_NEAR(track.altitude[35], altitude_at(35), kWithin);
}

// Levels matter only in comparison: a gain, other for each ping, and a square root, as of recorded amplitudes.
TEST(BottomTrackTest, GainAndCompressionDoNotMatter) {
  const SonarConfig sonar = side_scan_sonar();
  std::vector<Ping> pings = line_of(sonar, 60, 30);
  for (Ping& ping : pings) {
    const float gain = std::pow(10.0F, static_cast<float>(ping.number % 5) * 2 - 12);
    for (float& intensity : ping.intensity) {
      intensity = gain * std::sqrt(intensity);
    }
  }
  expect_altitudes(track_bottom(pings, sonar));
}

// With a pitch of 20 degrees the nearest bed in the plane of the beams is h / cos(20 deg) away.
TEST(BottomTrackTest, PitchIsTakenOut) {
  const SonarConfig sonar = side_scan_sonar();
  const double pitch = radians_from_degrees(20);
  std::mt19937 random(9);
  std::vector<Ping> pings;
  for (int ping = 0; ping < 20; ++ping) {
    pings.push_back(bed_ping(sonar, 10 / std::cos(pitch), 30, random));
    pings.back().world_from_sonar.orientation = orientation_from_rpy(0.1, pitch, 2);
  }
  const BottomTrack track = track_bottom(pings, sonar);
  EXPECT_NEAR(track.altitude[10], 10, kWithin);
  EXPECT_NEAR(track.range[10], 10 / std::cos(pitch), kWithin);
}

// Beams that end 60 degrees below the horizontal meet the bed first at h / sin(60 deg).
TEST(BottomTrackTest, BeamsThatDoNotReachStraightDownAreTakenIntoAccount) {
  const SonarConfig sonar = side_scan_sonar();
  const double angle = radians_from_degrees(60);
  std::mt19937 random(9);
  std::vector<Ping> pings(20);
  std::ranges::generate(pings, [&] { return bed_ping(sonar, 10 / std::sin(angle), 30, random); });
  EXPECT_NEAR(track_bottom(pings, sonar, {.first_return_angle = angle}).altitude[10], 10, kWithin);
}

// Echoes at r = 10 m from 60 degrees below the horizontal, and nearer ones from above: 10 sin(60 deg) = 8.66 m.
TEST(BottomTrackTest, TheTrueAltitudeIsThatOfTheNearestEchoFromBelow) {
  const SonarConfig sonar = side_scan_sonar();
  Ping ping = dark_ping(sonar);
  ping.elevation.assign(ping.intensity.size(), std::numeric_limits<float>::quiet_NaN());
  ping.elevation[ping.index(100, 0)] = 0.2F;
  ping.elevation[ping.index(199, 1)] = static_cast<float>(-radians_from_degrees(60));
  EXPECT_NEAR(true_altitude(ping, sonar), 9.975 * std::sqrt(3) / 2, 1e-6);
}

TEST(BottomTrackTest, BadInputIsRefused) {
  const SonarConfig sonar = side_scan_sonar();
  EXPECT_EQ(message_of([&] { (void)track_bottom({}, sonar); }),
            "sss: a track of the bottom must have at least one ping");
  Ping ping = dark_ping(sonar);
  ping.world_from_sonar.position.x() = std::nan("");
  EXPECT_EQ(message_of([&] { (void)track_bottom({&ping, 1}, sonar); }), "ping 0 of sss: its pose is not finite");
  Ping other = dark_ping(sonar);
  other.bin_count = 7;
  EXPECT_EQ(message_of([&] {
              (void)track_bottom({&other, 1}, sonar);
            }),
            "ping 0 of sss has 2 beams x 7 bins, must have 2 x 800");
  EXPECT_EQ(message_of([&] { (void)BottomTracker(SonarConfig()); }),
            "sonar has 256 beams: a side-scan sonar must have one to port and one to starboard, or a single one that "
            "does not turn");
  EXPECT_EQ(message_of([&] { (void)BottomTracker(sonar, {.least_range = 5, .greatest_range = 5}); }),
            "greatest_range = 5 m must be greater than 5, at most 100000 m");
  EXPECT_EQ(message_of([&] { (void)true_altitude(dark_ping(sonar), sonar); }),
            "ping 0 of sss has no elevations; ground_truth: labels adds them");
}

}  // namespace
}  // namespace insonify::bottom_track_test
