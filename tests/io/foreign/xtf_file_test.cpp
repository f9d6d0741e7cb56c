// xtf_file_test.cpp -- side-scan channels of XTF files: samples, settings and what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>

#include "insonify/recording_info.h"
#include "insonify/stored_tables.h"
#include "io/foreign/foreign_bytes.h"

namespace insonify::xtf_file_test {
namespace {

using testing::ElementsAre;

std::string words(std::uint16_t a, std::uint16_t b, std::uint16_t c) {
  return little(a, b, c);
}

const XtfBytes kPing{.port = words(3, 2, 1), .starboard = words(11, 12, 40000)};

// Those of port are stored from the outermost inwards.
TEST(XtfFileTest, SamplesBeginAtTheSonarOnBothSides) {
  const WorkingFolder folder;
  XtfBytes next = kPing;
  next.port = words(6, 5, 4);
  next.second = 7;
  folder.write("a.xtf", xtf_header(kPing) + xtf_packet(kPing) + xtf_packet(next));
  const RecordedPings port("a.xtf", "port"), starboard("a.xtf", "starboard"), both("a.xtf");
  EXPECT_EQ(port.foreign_format(), "XTF");
  EXPECT_EQ(port.ping_count(), 2U);
  EXPECT_EQ(port.beam_count(), 1);
  EXPECT_EQ(port.full_scale(), 65535);
  EXPECT_THAT(port.intensity(0), ElementsAre(1, 2, 3));
  EXPECT_THAT(port.intensity(1), ElementsAre(4, 5, 6));
  EXPECT_THAT(starboard.intensity(0), ElementsAre(11, 12, 40000));
  EXPECT_NEAR(port.ping(1).time, 2, 1e-6);
  EXPECT_THAT(both.intensity(1), ElementsAre(4, 11, 5, 12, 6, 40000));
  EXPECT_EQ(both.sonar(), "side_scan");
  EXPECT_TRUE(both.sonar_config().is_side_scan());
  EXPECT_THAT(both.sonars(), ElementsAre("side_scan"));
  EXPECT_THAT(both.notes(), ElementsAre());
  EXPECT_THAT(starboard.notes(), ElementsAre());
  const SonarConfig sonar = starboard.sonar_config();
  EXPECT_EQ(sonar.name, "starboard");
  EXPECT_EQ(sonar.max_range, 30);
  EXPECT_EQ(sonar.frequency, 600e3);
  EXPECT_NEAR(degrees_from_radians(sonar.beam_azimuth(0)), -90, 1e-9);
}

// A sub-bottom channel of one byte a sample comes first in the packet; of two port channels the second has a number.
TEST(XtfFileTest, OtherChannelsAreSteppedOver) {
  const WorkingFolder folder;
  std::string header = xtf_header(kPing);
  header[256] = 0;
  header[256 + 6] = 1;
  header[256 + 2 * 128] = 2;
  header[256 + 2 * 128 + 6] = 2;
  XtfBytes ping = kPing;
  ping.port = "abc";
  std::string packet = xtf_packet(ping);
  folder.write("a.xtf", header + packet);
  EXPECT_THAT(RecordedPings("a.xtf").intensity(0), ElementsAre(11, 12, 40000));
  EXPECT_EQ(opening("a.xtf", "starboard2"), "a.xtf: has no ping of starboard2 in 1 packet");
  EXPECT_EQ(opening("a.xtf", "port"), "a.xtf: has no sonar port; it has starboard, starboard2");
}

TEST(XtfFileTest, EightBitsAndFloatsAreRead) {
  const WorkingFolder folder;
  const XtfBytes bytes{.sample_bytes = 1, .port = "cba", .starboard = "xyz"};
  folder.write("bytes.xtf", xtf_header(bytes) + xtf_packet(bytes));
  EXPECT_EQ(RecordedPings("bytes.xtf").full_scale(), 255);
  EXPECT_THAT(RecordedPings("bytes.xtf", "port").intensity(0), ElementsAre('a', 'b', 'c'));
  const XtfBytes floats{
      .sample_bytes = 4, .sample_format = 5, .port = little(1.F, 2.F, 3.F), .starboard = little(.5F, .25F, 0.F)};
  folder.write("floats.xtf", xtf_header(floats) + xtf_packet(floats));
  EXPECT_THAT(RecordedPings("floats.xtf", "starboard").intensity(0), ElementsAre(.5, .25, 0));
  EXPECT_EQ(RecordedPings("floats.xtf", "starboard").full_scale(), 1);
}

TEST(XtfFileTest, OtherRangesAndACutEndAreTold) {
  const WorkingFolder folder;
  XtfBytes far = kPing;
  far.range = 60;
  const std::string whole = xtf_header(kPing) + xtf_packet(kPing) + xtf_packet(far);
  folder.write("a.xtf", whole + xtf_packet(kPing).substr(0, 300));
  const RecordedPings pings("a.xtf", "port");
  EXPECT_EQ(pings.ping_count(), 1U);
  EXPECT_THAT(
      pings.notes(),
      ElementsAre("1 ping of another range or number of samples than the first left out",
                  fmt::format("the file is cut off: its last 300 bytes, from byte {} on, are not a whole packet",
                              whole.size())));
}

TEST(XtfFileTest, WrongFilesAreOneMessage) {
  const WorkingFolder folder;
  folder.write("text.xtf", std::string(2000, 'x'));
  EXPECT_EQ(opening("text.xtf"), "text.xtf: byte 0: begins with 0x78; an XTF file begins with 0x7b");
  folder.write("short.xtf", "{ short");
  EXPECT_EQ(opening("short.xtf"), "short.xtf: byte 0: the file header of 1024 bytes is cut off: the file has 7");
  folder.write("none.xtf", padded("{", 1024));
  EXPECT_EQ(opening("none.xtf"), "none.xtf: has no side-scan channel; depths of multibeam sonars are not read");
  folder.write("a.xtf", xtf_header(kPing) + xtf_packet(kPing) + "no packet at all");
  EXPECT_EQ(opening("a.xtf"), fmt::format("a.xtf: byte {}: a packet begins with 0x6f6e, must begin with 0xface",
                                          1024 + xtf_packet(kPing).size()));
  folder.write("other.xtf", xtf_header(kPing) + xtf_packet(kPing));
  EXPECT_EQ(opening("other.xtf", "fls"), "other.xtf: has no sonar fls; it has side_scan, port, starboard");
  XtfBytes giant = kPing;
  giant.samples = 4'000'000'000;
  folder.write("giant.xtf", xtf_header(kPing) + xtf_packet(giant));
  EXPECT_EQ(opening("giant.xtf"),
            "giant.xtf: byte 1280: 4000000000 samples of channel 0 need 8000000000 bytes; the packet has 76");
  std::string endless = xtf_header(kPing) + xtf_packet(kPing);
  endless.replace(1024 + 10, 4, little(std::uint32_t{0}));
  folder.write("endless.xtf", endless);
  EXPECT_EQ(opening("endless.xtf"), "endless.xtf: byte 1024: a packet of 0 bytes must have at least 14");
  XtfBytes wide = kPing;
  wide.sample_bytes = 8;
  folder.write("wide.xtf", xtf_header(wide) + xtf_packet(kPing));
  EXPECT_EQ(
      opening("wide.xtf"),
      "wide.xtf: samples of port have 8 bytes and format 0; those of 1 or 2 bytes are read, and of 4 in format 5");
}

// A fish 14 m deep, 5 m above the bed, heading north-east, its nose 10 degrees down, 3 / 3600 of a degree of latitude
// north of the first: 92.6 m on a parallel of 45 degrees, where a degree has 111 132 m.
TEST(XtfFileTest, PosesAndAltitudesAreThoseOfThePacketsHeads) {
  const WorkingFolder folder;
  std::string header = xtf_header(kPing);
  header[164] = 3;
  XtfBytes ping = kPing;
  const std::string lost = xtf_packet(ping);
  ping.fix = {45, -68, 14, 5, -10, 0, 45};
  const std::string first = xtf_packet(ping);
  ping.fix[0] += 3.0 / 3600;
  folder.write("a.xtf", header + lost + first + xtf_packet(ping));
  const RecordedPings pings("a.xtf");
  EXPECT_THAT(pings.notes(), ElementsAre("1 ping without a position: that of the next is taken"));
  EXPECT_EQ(pings.altitude(0), std::nullopt);
  EXPECT_EQ(pings.altitude(1), 5);
  ASSERT_TRUE(pings.origin().has_value());
  EXPECT_EQ(pings.origin()->latitude, 45);
  EXPECT_EQ(pings.origin()->longitude, -68);
  EXPECT_EQ(pings.ping(0).world_from_sonar.position, Vec3(0, 0, -14));
  const Pose pose = pings.ping(2).world_from_sonar;
  EXPECT_NEAR(pose.position.x(), 0, 1e-6);
  EXPECT_NEAR(pose.position.y(), 111132 * 3.0 / 3600, 0.01);
  const Vec3 ahead = pose.orientation * Vec3::UnitX();
  EXPECT_NEAR(ahead.x(), std::cos(radians_from_degrees(10)) / std::sqrt(2), 1e-6);
  EXPECT_NEAR(ahead.y(), ahead.x(), 1e-6);
  EXPECT_NEAR(ahead.z(), -std::sin(radians_from_degrees(10)), 1e-6);
}

// Some programs store the sound speed, others half of it; what is neither is unknown.
TEST(XtfFileTest, SoundSpeedsAreThoseOfThePings) {
  const WorkingFolder folder;
  std::string bytes = xtf_header(kPing);
  for (const float velocity : {740.F, 1490.F, 3.F}) {
    XtfBytes ping = kPing;
    ping.sound_velocity = velocity;
    bytes += xtf_packet(ping);
  }
  folder.write("a.xtf", bytes);
  EXPECT_EQ(RecordedPings("a.xtf").sonar_config().assumed_sound_speed, 1480);
  const StoredTables tables("a.xtf", "");
  const StoredTable* const speeds = tables.find("sound_speed");
  ASSERT_NE(speeds, nullptr);
  std::array<double, 3> values{};
  tables.read(*speeds, std::array{TableSlice{0, 3}}, std::as_writable_bytes(std::span(values)));
  EXPECT_THAT(values, ElementsAre(1480, 1490, testing::IsNan()));
  folder.write("none.xtf", xtf_header(kPing) + xtf_packet(kPing));
  EXPECT_EQ(StoredTables("none.xtf", "").find("sound_speed"), nullptr);
  EXPECT_EQ(RecordedPings("none.xtf").sonar_config().assumed_sound_speed, std::nullopt);
}

TEST(XtfFileTest, PingsThatLackASideAreTold) {
  const WorkingFolder folder;
  XtfBytes half = kPing;
  std::string packet = xtf_packet(half);
  packet.replace(256 + 64 + half.port.size() + 42, 4, little(std::uint32_t{0}));
  folder.write("a.xtf", xtf_header(kPing) + xtf_packet(kPing) + packet);
  EXPECT_EQ(RecordedPings("a.xtf").ping_count(), 1U);
  EXPECT_THAT(RecordedPings("a.xtf").notes(), ElementsAre("1 ping without samples of both sides left out"));
  EXPECT_EQ(RecordedPings("a.xtf", "port").ping_count(), 2U);
}

// Channels 0 and 1 are one sonar, 2 and 3 another, which ping in turn: neither lacks the other's pings.
TEST(XtfFileTest, PingsOfAnotherSonarAreNotMissing) {
  const WorkingFolder folder;
  std::string header = xtf_header(kPing);
  header.replace(256 + 2 * 128, 2 * 128, header.substr(256, 2 * 128));
  std::string second = xtf_packet(kPing);
  second[256] = 2;
  second[256 + 64 + static_cast<int>(kPing.port.size())] = 3;
  folder.write("a.xtf", header + xtf_packet(kPing) + second + xtf_packet(kPing));
  EXPECT_THAT(RecordedPings("a.xtf", "side_scan").notes(), ElementsAre());
  EXPECT_EQ(RecordedPings("a.xtf", "side_scan").ping_count(), 2U);
  EXPECT_THAT(RecordedPings("a.xtf", "side_scan2").notes(), ElementsAre());
  EXPECT_EQ(RecordedPings("a.xtf", "side_scan2").ping_count(), 1U);
  EXPECT_THAT(RecordedPings("a.xtf").notes(),
              ElementsAre("has side_scan, side_scan2; side_scan is taken, --sonar takes another"));
  const RecordingInfo info = recording_info("a.xtf");
  ASSERT_EQ(info.sonars.size(), 2U);
  EXPECT_EQ(info.sonars[0].config.name, "side_scan");
  EXPECT_EQ(info.sonars[1].config.name, "side_scan2");
  EXPECT_EQ(info.sonars[1].pings, 1U);
  EXPECT_THAT(info.notes, ElementsAre());
  folder.write("unused.xtf", header + xtf_packet(kPing));
  EXPECT_EQ(recording_info("unused.xtf").sonars.size(), 1U);
  EXPECT_THAT(recording_info("unused.xtf").notes, ElementsAre("has no ping of side_scan2 in 1 packet"));
  folder.write("cut.xtf", header + xtf_packet(kPing) + second + "\xce\xfa");
  EXPECT_THAT(recording_info("cut.xtf").notes,
              ElementsAre(fmt::format("the file is cut off: its last 2 bytes, from byte {} on, are not a whole packet",
                                      1024 + xtf_packet(kPing).size() + second.size())));
}

// By WGS84 a degree of latitude has 111 199 m at 48.4457 degrees, one of longitude 73 980 m; the last ping is
// 48.4458633 - 48.4454500 north and 68.8283367 - 68.8279350 west of the second, the first with a place.
TEST(XtfFileTest, RealPingsHaveNavigation) {
  INSONIFY_REAL_DATA(xtf, "opensidescan_xtf_wreck/scotsman-iver2.xtf");
  const RecordedPings pings(xtf);
  EXPECT_EQ(pings.ping_count(), 461U);
  EXPECT_EQ(pings.beam_count(), 2);
  EXPECT_THAT(pings.notes(), ElementsAre("1 ping without a position: that of the next is taken"));
  ASSERT_TRUE(pings.origin().has_value());
  EXPECT_NEAR(pings.origin()->latitude, 48.44545, 1e-6);
  EXPECT_NEAR(pings.origin()->longitude, -68.827935, 1e-6);
  const Pose last = pings.ping(460).world_from_sonar;
  EXPECT_NEAR(last.position.x(), -73980 * .00040167, .02);
  EXPECT_NEAR(last.position.y(), 111199 * .00041333, .02);
  EXPECT_NEAR(last.position.z(), -22.96, 1e-4);
  const Vec3 ahead = last.orientation * Vec3::UnitX();
  EXPECT_NEAR(degrees_from_radians(std::atan2(ahead.x(), ahead.y())), 336.7 - 360, 1e-3);
  EXPECT_NEAR(degrees_from_radians(std::asin(ahead.z())), 3.1, 1e-3);
  EXPECT_NEAR(pings.altitude(1).value(), 11.45, 1e-5);
  EXPECT_NEAR(pings.altitude(460).value(), 2.68, 1e-5);
  EXPECT_EQ(pings.sonar_config().assumed_sound_speed, 1500);
}

// The same side as another program has decoded it; a multibeam file has depths only.
TEST(XtfFileTest, RealPingsAreThoseOfTheArrays) {
  INSONIFY_REAL_DATA(xtf, "opensidescan_xtf_wreck/scotsman-iver2.xtf");
  INSONIFY_REAL_DATA(npz, "arrays/opensidescan_scotsman_sss.npz");
  const RecordedPings starboard(xtf, "starboard"), array(npz, "starboard");
  ASSERT_EQ(starboard.ping_count(), 461U);
  EXPECT_EQ(starboard.bin_count(), 1024);
  const RecordedPings port(xtf, "port"), stored_port(npz, "port");
  for (const std::uint64_t ping : {0, 1, 230, 460}) {
    EXPECT_EQ(starboard.intensity(ping), array.intensity(ping)) << ping;
    std::vector<double> inwards = stored_port.intensity(ping);
    std::ranges::reverse(inwards);
    EXPECT_EQ(port.intensity(ping), inwards) << ping;
  }
  EXPECT_NEAR(starboard.sonar_config().max_range, 29.983501, 1e-5);
  EXPECT_EQ(starboard.sonar_config().frequency, 600e3);
  INSONIFY_REAL_DATA(depths, "mbeslib_xtf_r2sonic/0009_150708_R2Testing_0001.xtf");
  EXPECT_EQ(opening(depths), depths.string() + ": has no side-scan channel; depths of multibeam sonars are not read");
}

}  // namespace
}  // namespace insonify::xtf_file_test
