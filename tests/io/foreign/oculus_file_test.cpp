// oculus_file_test.cpp -- files of an Oculus: pixels, settings and what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/foreign/foreign_bytes.h"

namespace insonify::oculus_file_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(OculusFileTest, PixelsAreCountsByRangeAndBeam) {
  const WorkingFolder folder;
  folder.write("a.raw", oculus_message({}) + oculus_message({.image = "abcdef"}));
  const RecordedPings pings("a.raw");
  EXPECT_EQ(pings.foreign_format(), "Oculus");
  EXPECT_EQ(pings.ping_count(), 2U);
  EXPECT_EQ(pings.bin_count(), 3);
  EXPECT_EQ(pings.beam_count(), 2);
  EXPECT_EQ(pings.full_scale(), 255);
  EXPECT_TRUE(pings.has_integers());
  EXPECT_THAT(pings.intensity(0), ElementsAre(1, 2, 3, 4, 5, 255));
  EXPECT_THAT(pings.intensity(1), ElementsAre('a', 'b', 'c', 'd', 'e', 'f'));
  EXPECT_THAT(pings.notes(), IsEmpty());
  EXPECT_THAT(pings.assumed(), IsEmpty());
}

// Bearings are positive to starboard, azimuths to port. Gamma 127 of 255.
TEST(OculusFileTest, SettingsAreThoseOfTheMessage) {
  const WorkingFolder folder;
  folder.write("a.raw", oculus_message({}));
  const SonarConfig sonar = RecordedPings("a.raw").sonar_config();
  EXPECT_EQ(sonar.name, "oculus");
  EXPECT_EQ(sonar.frequency, 2.1e6);
  EXPECT_EQ(sonar.min_range, 0);
  EXPECT_EQ(sonar.max_range, 1.5);
  EXPECT_NEAR(degrees_from_radians(sonar.beam_azimuth(0)), 10, 1e-9);
  EXPECT_NEAR(degrees_from_radians(sonar.beam_azimuth(1)), -10, 1e-9);
  EXPECT_EQ(sonar.bits, 8);
  EXPECT_EQ(sonar.mapping, Mapping::kGamma);
  EXPECT_NEAR(sonar.mapping_exponent, 127.0 / 255, 1e-12);
  EXPECT_EQ(sonar.assumed_sound_speed, 1490.0);
}

TEST(OculusFileTest, SixteenBitsGainWordsAndTheSecondLayoutAreRead) {
  const WorkingFolder folder;
  OculusBytes ping{.flags = 0x1f, .pixel_type = 1, .version = 2};
  ping.image = little(50U, std::uint16_t{1}, std::uint16_t{2}, 60U, std::uint16_t{300}, std::uint16_t{4}, 70U,
                      std::uint16_t{5}, std::uint16_t{65535});
  const std::string first = oculus_message(ping);
  ping.microseconds += 250'000;
  folder.write("a.oculus", first + oculus_message(ping));
  const RecordedPings pings("a.oculus");
  EXPECT_EQ(pings.full_scale(), 65535);
  EXPECT_THAT(pings.intensity(0), ElementsAre(1, 2, 300, 4, 5, 65535));
  EXPECT_EQ(pings.sonar_config().bits, 16);
  EXPECT_NEAR(pings.ping(1).time, 0.25, 1e-9);
}

TEST(OculusFileTest, WhatIsBetweenMessagesIsSkipped) {
  const WorkingFolder folder;
  const std::string log = "\x44\x33\x22\x11 a logger's head, with SO in it ";
  folder.write("a.oculus", log + oculus_message({}) + "item" + oculus_message({}) + "end");
  EXPECT_EQ(RecordedPings("a.oculus").ping_count(), 2U);
}

TEST(OculusFileTest, PingsOfOtherShapeAndACutOneAreLeftOutAndTold) {
  const WorkingFolder folder;
  const std::string whole = oculus_message({});
  folder.write("a.raw", whole + oculus_message({.rows = 1, .image = "ab"}) + whole + whole.substr(0, 100));
  const RecordedPings pings("a.raw");
  EXPECT_EQ(pings.ping_count(), 2U);
  const std::size_t cut = 2 * whole.size() + oculus_message({.rows = 1, .image = "ab"}).size();
  EXPECT_THAT(pings.notes(), ElementsAre("1 ping of other ranges, beams or frequency than the first left out",
                                         fmt::format("the last message, at byte {}, is cut off and left out", cut)));
}

// Bearings that do not rise are not those of a fan.
TEST(OculusFileTest, OddBearingsAreReplacedAndTold) {
  const WorkingFolder folder;
  folder.write("a.raw", oculus_message({.bearings = {1000, 1000}}));
  const RecordedPings pings("a.raw");
  EXPECT_THAT(pings.assumed(), ElementsAre("its bearings are not those of a fan, 120 deg are assumed"));
  EXPECT_NEAR(degrees_from_radians(pings.sonar_config().azimuth_aperture), 120, 1e-9);
}

TEST(OculusFileTest, WrongFilesAreOneMessage) {
  const WorkingFolder folder;
  const std::string whole = oculus_message({});
  folder.write("text.raw", "hello, this is text");
  EXPECT_EQ(opening("text.raw"),
            "text.raw: has no simple ping result of an Oculus (id 0x23); it begins with \"hell\", must begin with SO "
            "(0x4f53)");
  folder.write("cut.raw", whole.substr(0, 100));
  EXPECT_EQ(opening("cut.raw"), "cut.raw: byte 0: a message of an Oculus is cut off: the file has 100 bytes");
  folder.write("giant.raw", "SO" + padded(std::string("\0\0\0\0\x23\0\0\0\xff\xff\xff\xff", 12), 60));
  EXPECT_EQ(opening("giant.raw"), "giant.raw: byte 0: a message of 4294967311 bytes must have at most 67108864");
  folder.write("other.raw", oculus_message({.id = 0x22}));
  EXPECT_EQ(opening("other.raw"),
            "other.raw: has no simple ping result of an Oculus (id 0x23); 1 message of other ids, the last 0x22");
  folder.write("rows.raw", whole + oculus_message({.rows = 60000}));
  EXPECT_EQ(opening("rows.raw"),
            fmt::format("rows.raw: byte {}: a ping of an Oculus: image of 6 bytes must have 120000, 60000 rows of 2",
                        whole.size()));
  folder.write("pixels.raw", oculus_message({.pixel_type = 3}));
  EXPECT_EQ(opening("pixels.raw"),
            "pixels.raw: byte 0: a ping of an Oculus: pixels of type 3 must be of type 0 (8 bits) or 1 (16 bits)");
  folder.write("sonar.raw", whole);
  EXPECT_EQ(opening("sonar.raw", "fls"), "sonar.raw: has no sonar fls; its sonar is oculus");
}

// The same pings as another program has decoded them.
TEST(OculusFileTest, RealPingsAreThoseOfTheArrays) {
  INSONIFY_REAL_DATA(raw, "liboculus_oculus_raw/three_pings_8bit.raw");
  INSONIFY_REAL_DATA(npz, "arrays/liboculus_oculus_3pings.npz");
  const RecordedPings pings(raw), arrays(npz);
  ASSERT_EQ(pings.ping_count(), 3U);
  EXPECT_EQ(pings.bin_count(), 703);
  EXPECT_EQ(pings.beam_count(), 256);
  for (std::uint64_t ping = 0; ping < 3; ++ping) {
    EXPECT_EQ(pings.intensity(ping), arrays.intensity(ping)) << ping;
  }
  const SonarConfig sonar = pings.sonar_config(), stored = arrays.sonar_config();
  EXPECT_NEAR(sonar.max_range, 1.998059, 1e-6);
  EXPECT_NEAR(stored.max_range, sonar.max_range, 1e-9);
  for (const int beam : {0, 1, 100, 255}) {
    EXPECT_NEAR(stored.beam_azimuth(beam), sonar.beam_azimuth(beam), 1e-9) << beam;
  }
  EXPECT_NEAR(sonar.frequency, 2.1e6, 2e3);
}

}  // namespace
}  // namespace insonify::oculus_file_test
