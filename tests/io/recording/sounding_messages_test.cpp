// sounding_messages_test.cpp -- soundings of multibeams as messages, and read back from MCAP recordings.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "insonify/mcap_recording.h"
#include "insonify/recorded_pings.h"
#include "insonify/stored_tables.h"
#include "io/message/clouds.h"
#include "io/recording/small_messages.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::sounding_messages_test {
namespace {

using namespace small_messages;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::FloatEq;
using testing::NanSensitiveFloatEq;

/// Three beams at 45, 0 and -45 degrees from straight down.
SonarConfig swath() {
  SonarConfig sonar = fan();
  sonar.name = "swath";
  sonar.type = SonarType::kMultibeam;
  sonar.azimuth_resolution = 0.02;
  return sonar;
}

constexpr float kQuarterTurn = 0.78539816F;

// By phase 28 m to port, by amplitude 20 m below, and nothing to starboard.
std::vector<Sounding> soundings() {
  return {{.azimuth = kQuarterTurn,
           .range = 28.25F,
           .uncertainty = 0.125F,
           .quality = 2.354F,
           .intensity = 1e-6F,
           .snippet_begin = 0,
           .snippet_end = 2,
           .detection = Detection::kPhase},
          {.azimuth = 0,
           .range = 20,
           .uncertainty = 0.25F,
           .quality = 1.903F,
           .intensity = 1e-4F,
           .snippet_begin = 1,
           .snippet_end = 2,
           .detection = Detection::kAmplitude},
          {.azimuth = -kQuarterTurn}};
}

Ping ping_of_swath(std::vector<Sounding> found) {
  Ping ping = ping_of(swath(), kLevels);
  ping.soundings = std::move(found);
  return ping;
}

TEST(SoundingMessagesTest, OnlyMultibeamsHaveThem) {
  std::vector<std::string> topics;
  for (const MessageForm form : {MessageForm::kRos2, MessageForm::kRos1, MessageForm::kGazebo}) {
    for (const SonarConfig& sonar : {fan(), swath()}) {
      const SonarMessages messages(source_of(sonar), {}, form);
      for (const MessageChannel& channel : messages.channels()) {
        if (channel.kind == MessageKind::kDetections || channel.kind == MessageKind::kSoundings) {
          topics.push_back(channel.topic + " " + channel.type + " " + channel.md5);
          EXPECT_FALSE(channel.latched);
        }
      }
    }
  }
  EXPECT_THAT(topics, ElementsAre("/swath/detections marine_acoustic_msgs/msg/SonarDetections ",
                                  "/swath/soundings sensor_msgs/msg/PointCloud2 ",
                                  "/swath/detections marine_acoustic_msgs/SonarDetections "
                                  "588993519ccaab99fb0df80256b440ff",
                                  "/swath/soundings sensor_msgs/PointCloud2 1158d486dd51d683ce2f1be655c3c181",
                                  "/swath/soundings gz.msgs.PointCloudPacked "));
}

// Times are there and back at 1480 m/s: 56.5 / 1480 and 40 / 1480.
TEST(SoundingMessagesTest, DetectionsHaveAValueForEachBeam) {
  SonarMessages messages(source_of(swath()));
  messages.take(ping_of_swath(soundings()));
  CdrRead in = encoded(messages, MessageKind::kDetections);
  EXPECT_EQ(in.header(), std::tuple(12, 250'000'000U, "swath_swath"));
  EXPECT_EQ(in.number<float>(), 455e3F);
  EXPECT_EQ(in.number<float>(), 1480.0F);
  EXPECT_THAT(in.numbers<float>(), ElementsAre(0.5F, 0.5F, 0.5F));     // tx_beamwidths
  EXPECT_THAT(in.numbers<float>(), ElementsAre(0.02F, 0.02F, 0.02F));  // rx_beamwidths
  EXPECT_THAT(in.numbers<std::uint8_t>(), ElementsAre(0, 0, 1));       // DETECT_OK, DETECT_OK, DETECT_BAD_SONAR
  EXPECT_THAT(in.numbers<float>(), ElementsAre(FloatEq(56.5F / 1480), FloatEq(40.0F / 1480), 0));
  EXPECT_THAT(in.numbers<float>(), ElementsAre(0, 0, 0));                         // tx_delays
  EXPECT_THAT(in.numbers<float>(), ElementsAre(FloatEq(-60), FloatEq(-40), 0));   // intensities
  EXPECT_THAT(in.numbers<float>(), ElementsAre(0, 0, 0));                         // tx_angles
  EXPECT_THAT(in.numbers<float>(), ElementsAre(-kQuarterTurn, 0, kQuarterTurn));  // To starboard.
  EXPECT_TRUE(in.at_end());
}

struct ReadCloud {
  std::string frame;
  std::vector<std::tuple<std::string, unsigned, int>> fields;  // Name, offset, type.
  std::vector<std::uint8_t> data;
  unsigned count = 0, step = 0;

  template <typename Number>
  [[nodiscard]] Number value(unsigned point, unsigned offset) const {
    Number number{};
    std::memcpy(&number, &data.at(std::size_t{point} * step + offset), sizeof number);
    return number;
  }
};

ReadCloud cloud_in(CdrRead in) {
  ReadCloud cloud;
  cloud.frame = std::get<2>(in.header());
  EXPECT_EQ(in.number<std::uint32_t>(), 1U);  // height
  cloud.count = in.number<std::uint32_t>();
  const auto fields = in.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < fields; ++i) {
    std::string name = in.text();
    const auto offset = in.number<std::uint32_t>();
    cloud.fields.emplace_back(name, offset, in.number<std::uint8_t>());
    EXPECT_EQ(in.number<std::uint32_t>(), 1U);
  }
  EXPECT_FALSE(in.number<bool>());  // is_bigendian
  cloud.step = in.number<std::uint32_t>();
  EXPECT_EQ(in.number<std::uint32_t>(), cloud.count * cloud.step);
  cloud.data = in.numbers<std::uint8_t>();
  EXPECT_EQ(cloud.data.size(), cloud.count * cloud.step);
  EXPECT_TRUE(in.number<bool>());  // is_dense
  EXPECT_TRUE(in.at_end());
  return cloud;
}

// In the frame of the housing x points down and y to port: 28.25 m at 45 degrees are 19.97577 m of each.
TEST(SoundingMessagesTest, CloudHasThePointsOfTheBeamsThatFoundTheBottom) {
  SonarMessages messages(source_of(swath()));
  messages.take(ping_of_swath(soundings()));
  const ReadCloud cloud = cloud_in(encoded(messages, MessageKind::kSoundings));
  EXPECT_EQ(cloud.frame, "swath");
  constexpr int kUint8 = 2, kUint16 = 4, kInt32 = 5, kFloat32 = 7;
  using Field = std::tuple<std::string, unsigned, int>;
  EXPECT_THAT(cloud.fields,
              ElementsAre(Field("x", 0, kFloat32), Field("y", 4, kFloat32), Field("z", 8, kFloat32),
                          Field("intensity", 12, kFloat32), Field("uncertainty", 16, kFloat32),
                          Field("quality", 20, kFloat32), Field("beam", 24, kUint16), Field("detection", 26, kUint8),
                          Field("snippet_begin", 28, kInt32), Field("snippet_end", 32, kInt32)));
  EXPECT_EQ(cloud.step, 36U);
  ASSERT_EQ(cloud.count, 2U);
  const std::array<std::array<double, 6>, 2> expected = {
      {{19.97577, 19.97577, 0, -60, 0.125, 2.354}, {20, 0, 0, -40, 0.25, 1.903}}};
  for (unsigned point = 0; point < 2; ++point) {
    for (unsigned i = 0; i < 6; ++i) {
      EXPECT_NEAR(cloud.value<float>(point, 4 * i), expected[point][i], 1e-5) << point << ", " << i;
    }
    EXPECT_EQ(cloud.value<std::uint16_t>(point, 24), point);
    EXPECT_EQ(cloud.value<std::uint8_t>(point, 26), point == 0 ? 2 : 1);
    EXPECT_EQ(cloud.value<std::int32_t>(point, 28), point == 0 ? 0 : 1);
    EXPECT_EQ(cloud.value<std::int32_t>(point, 32), 2);
  }
}

// No soundings at all, none found, and one whose range is no number.
TEST(SoundingMessagesTest, BeamsWithoutARangeHaveAFlagAndNoPoint) {
  std::vector<Sounding> lost = soundings();
  for (Sounding& sounding : lost) {
    sounding = {.azimuth = sounding.azimuth};
  }
  std::vector<Sounding> strange = lost;
  strange[1].detection = Detection::kPhase;
  for (const std::vector<Sounding>& each : {std::vector<Sounding>(), lost, strange}) {
    SonarMessages messages(source_of(swath()));
    messages.take(ping_of_swath(each));
    EXPECT_EQ(cloud_in(encoded(messages, MessageKind::kSoundings)).count, 0U);
    CdrRead in = encoded(messages, MessageKind::kDetections);
    (void)in.header();
    (void)in.number<float>();
    (void)in.number<float>();
    (void)in.numbers<float>();
    (void)in.numbers<float>();
    EXPECT_THAT(in.numbers<std::uint8_t>(), ElementsAre(1, 1, 1));
    EXPECT_THAT(in.numbers<float>(), ElementsAre(0, 0, 0));
    EXPECT_THAT(in.numbers<float>(), ElementsAre(0, 0, 0));
    EXPECT_THAT(in.numbers<float>(), ElementsAre(0, 0, 0));
    (void)in.numbers<float>();
    EXPECT_THAT(in.numbers<float>(), ElementsAre(-kQuarterTurn, 0, kQuarterTurn));
  }
}

// The frame of angles: z straight down, which is x of the housing; x ahead, which is its z.
TEST(SoundingMessagesTest, AnglesAreInAFrameOfTheirOwn) {
  SonarMessages messages(source_of(swath()));
  messages.take(ping_of_swath(soundings()));
  CdrRead in = encoded(messages, MessageKind::kTransforms);
  ASSERT_EQ(in.number<std::uint32_t>(), 3U);
  std::vector<double> last;
  std::vector<std::string> frames;
  for (int i = 0; i < 3; ++i) {
    const std::string parent = std::get<2>(in.header());
    frames.push_back(parent + " " + in.text());
    last = in.doubles(7);
  }
  EXPECT_THAT(frames, ElementsAre("world swath", "swath swath_beams", "swath swath_swath"));
  const Eigen::Quaterniond turn(last[6], last[3], last[4], last[5]);
  const double angle = -kQuarterTurn, range = 28.25;  // Of the first beam, which looks to port.
  const Vec3 place = turn * Vec3(0, range * std::sin(angle), range * std::cos(angle));
  EXPECT_THAT(std::vector<double>(place.begin(), place.end()),
              ElementsAre(DoubleNear(19.97577, 1e-5), DoubleNear(19.97577, 1e-5), DoubleNear(0, 1e-9)));
  EXPECT_TRUE((turn * Vec3::UnitX()).isApprox(Vec3::UnitZ(), 1e-12));
}

// Gazebo has no message of angles, other sonars have none either.
TEST(SoundingMessagesTest, OthersDoNotHaveTheFrameOfAngles) {
  SonarMessages messages(source_of(fan()));
  messages.take(ping_of(fan(), kLevels));
  EXPECT_EQ(encoded(messages, MessageKind::kTransforms).number<std::uint32_t>(), 2U);
  SonarMessages gazebo(source_of(swath()), {}, MessageForm::kGazebo);
  gazebo.take(ping_of_swath(soundings()));
  const std::vector<std::byte> bytes = gazebo.encode(5);
  ASSERT_EQ(gazebo.channels()[5].kind, MessageKind::kTransforms);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_NE(text.find("swath_beams"), std::string_view::npos);
  EXPECT_EQ(text.find("swath_swath"), std::string_view::npos);
}

TEST(SoundingMessagesTest, RefusesWhatCannotBe) {
  SonarMessages messages(source_of(swath()));
  EXPECT_EQ(message_of([&] {
              messages.take(ping_of_swath({{}, {}}));
            }),
            "ping 7 of swath has 2 soundings, must have 3");
  SonarConfig unknown = swath();
  unknown.assumed_sound_speed.reset();
  EXPECT_EQ(message_of([&] { SonarMessages{source_of(unknown)}; }),
            "messages of the multibeam swath: assumed_sound_speed is missing, by which ranges are times");
}

void record(const std::filesystem::path& path) {
  McapOptions options;
  options.messages.fan_height = 240;
  McapRecording out(path, {source_of(fan()), source_of(swath())}, options);
  out.add(0, ping_of(fan(), kLevels));
  Ping ping = ping_of_swath(soundings());
  out.add(1, ping);
  ping.time += 1;
  ping.soundings.clear();
  out.add(1, ping);
  out.close();
}

TEST(McapSoundingsTest, AreReadBack) {
  const WorkingFolder folder;
  record("a.mcap");
  const RecordedPings pings("a.mcap", "swath");
  ASSERT_EQ(pings.ping_count(), 2U);
  EXPECT_TRUE(pings.has_soundings());
  const std::vector<Sounding> found = pings.soundings(0), expected = soundings();
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t beam = 0; beam < 3; ++beam) {
    EXPECT_THAT(found[beam].azimuth, FloatEq(expected[beam].azimuth));
    EXPECT_THAT(found[beam].range, NanSensitiveFloatEq(expected[beam].range));
    EXPECT_EQ(found[beam].uncertainty, expected[beam].uncertainty);
    EXPECT_EQ(found[beam].quality, expected[beam].quality);
    EXPECT_NEAR(found[beam].intensity, expected[beam].intensity, 1e-6 * expected[beam].intensity);
    EXPECT_EQ(found[beam].snippet_begin, expected[beam].snippet_begin);
    EXPECT_EQ(found[beam].snippet_end, expected[beam].snippet_end);
    EXPECT_EQ(found[beam].detection, expected[beam].detection);
  }
  for (const Sounding& sounding : pings.ping(1).soundings) {
    EXPECT_FALSE(sounding.found());
    EXPECT_TRUE(std::isnan(sounding.range));
  }
  EXPECT_FALSE(RecordedPings("a.mcap", "fls-2").has_soundings());
  EXPECT_TRUE(RecordedPings("a.mcap", "fls-2").ping(0).soundings.empty());
}

TEST(McapSoundingsTest, AreTablesAsInHdf5) {
  const WorkingFolder folder;
  record("a.mcap");
  const StoredTables tables("a.mcap", "swath");
  EXPECT_EQ(StoredTables("a.mcap", "fls-2").find("sounding_range"), nullptr);
  const StoredTable* ends = tables.find("sounding_snippet_end");
  ASSERT_NE(ends, nullptr);
  EXPECT_EQ(ends->type, NumberType::kInt64);
  EXPECT_THAT(ends->shape, ElementsAre(2, 3));
  std::vector<std::int64_t> values(4);
  tables.read(*ends, std::array{TableSlice{0, 2}, TableSlice{0, 2, 2}}, std::as_writable_bytes(std::span(values)));
  EXPECT_THAT(values, ElementsAre(2, 0, 0, 0));
  std::vector<std::uint8_t> detections(6);
  tables.read(*tables.find("sounding_detection"), std::array{TableSlice{0, 2}, TableSlice{0, 3}},
              std::as_writable_bytes(std::span(detections)));
  EXPECT_THAT(detections, ElementsAre(2, 1, 0, 0, 0, 0));
  std::vector<float> ranges(3);
  tables.read(*tables.find("sounding_range"), std::array{TableSlice{0, 1}, TableSlice{0, 3}},
              std::as_writable_bytes(std::span(ranges)));
  EXPECT_THAT(ranges, ElementsAre(FloatEq(28.25), FloatEq(20), testing::IsNan()));
}

TEST(McapSoundingsTest, PointsThatCannotBeAreRefused) {
  std::vector<Sounding> beams(3);
  const auto set = [&](std::uint16_t beam, std::uint8_t detection) {
    return message_of([&] { set_soundings(std::array{SoundingPoint{.beam = beam, .detection = detection}}, beams); });
  };
  EXPECT_EQ(set(2, 1), "no error");
  EXPECT_EQ(set(3, 1),
            "its soundings have a point of beam 3 and detection 1, must be of a beam below 3 and detection 1 "
            "or 2");
  EXPECT_EQ(set(0, 0),
            "its soundings have a point of beam 0 and detection 0, must be of a beam below 3 and detection 1 "
            "or 2");
}

}  // namespace
}  // namespace insonify::sounding_messages_test
