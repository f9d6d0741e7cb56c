// messages_test.cpp -- pings as ROS 2 messages: encoding, frames, levels, points.

#include "insonify/messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "io/message/message_display.h"
#include "io/recording/small_messages.h"
#include "support/message_of.h"

namespace insonify::messages_test {
namespace {

using namespace small_messages;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(SonarMessagesTest, SonarImageIsRangeMajorWithStarboardAtPositiveAzimuth) {
  SonarMessages messages(source_of(fan()), {.bits = 8});
  messages.take(ping_of(fan(), kLevels));
  CdrRead in = encoded(messages, MessageKind::kSonarImage);
  EXPECT_EQ(in.header(), std::tuple(12, 250'000'000U, "fls_2_beams"));
  EXPECT_EQ(in.number<float>(), 455e3F);
  EXPECT_EQ(in.number<float>(), 1480.0F);
  EXPECT_THAT(in.numbers<float>(), ElementsAre(0.5F, 0.5F, 0.5F));  // tx_beamwidths
  EXPECT_EQ(in.numbers<float>().size(), 3);
  ASSERT_EQ(in.number<std::uint32_t>(), 3);
  const std::vector<double> azimuths = {-kQuarter, 0, kQuarter};  // As readers find them: positive to starboard.
  for (const double azimuth : azimuths) {
    const std::vector<double> direction = in.doubles(3);
    EXPECT_EQ(direction[0], 0);
    EXPECT_NEAR(std::atan2(-direction[1], direction[2]), azimuth, 1e-12);
    EXPECT_NEAR(std::hypot(direction[1], direction[2]), 1, 1e-12);
  }
  EXPECT_THAT(in.numbers<float>(), ElementsAre(10, 30));
  EXPECT_FALSE(in.number<bool>());
  EXPECT_EQ(in.number<std::uint32_t>(), 0);  // DTYPE_UINT8
  EXPECT_EQ(in.number<std::uint32_t>(), 3);
  // 255 (level + 100) / 60, rounded: -70 gives 127.5, -40 all, -130 none; -90 gives 42.5, -99.9 0.4, +5 all.
  EXPECT_THAT(in.numbers<std::uint8_t>(),
              ElementsAre(testing::AnyOf(127, 128), 255, 0, testing::AnyOf(42, 43), 0, 255));
  EXPECT_TRUE(in.at_end());
}

// Sides 40 deg below the horizontal are 50 deg from straight down. Bins of 0.5 m from 2 m on: sample 4, 1480 a second.
TEST(SonarMessagesTest, SideScansHaveRawImagesOfTwoBeams) {
  SonarConfig sides = fan();
  sides.type = SonarType::kSideScan;
  sides.beam_count = 2;
  sides.beam_azimuths.clear();
  sides.azimuth_aperture = 0.02;
  sides.depression = radians_from_degrees(40);
  sides.min_range = 2;
  sides.max_range = 3;
  SonarMessages messages(source_of(sides), {.bits = 8});
  messages.take(ping_of(sides, {-160, 5, -160, 5}));
  EXPECT_EQ(messages.channels().back().topic, "/fls_2/raw_sonar_image");
  EXPECT_EQ(messages.channels().back().type, "marine_acoustic_msgs/msg/RawSonarImage");
  CdrRead in = encoded(messages, MessageKind::kRawImage);
  EXPECT_EQ(in.header(), std::tuple(12, 250'000'000U, "fls_2_beams"));
  EXPECT_EQ(in.number<float>(), 455e3F);
  EXPECT_EQ(in.number<float>(), 1480.0F);
  EXPECT_THAT(in.numbers<float>(), ElementsAre(0.5F, 0.5F));
  EXPECT_THAT(in.numbers<float>(), ElementsAre(0.02F, 0.02F));
  EXPECT_FLOAT_EQ(in.number<float>(), 1480.0F);  // sample_rate
  EXPECT_EQ(in.number<std::uint32_t>(), 2);      // samples_per_beam
  EXPECT_EQ(in.number<std::uint32_t>(), 4);      // sample0
  EXPECT_THAT(in.numbers<float>(), ElementsAre(0, 0));
  EXPECT_THAT(in.numbers<float>(), ElementsAre(0, 0));
  const auto half = static_cast<float>(radians_from_degrees(50));
  EXPECT_THAT(in.numbers<float>(), ElementsAre(testing::FloatEq(-half), testing::FloatEq(half)));
  EXPECT_FALSE(in.number<bool>());
  EXPECT_EQ(in.number<std::uint32_t>(), 0);  // DTYPE_UINT8
  EXPECT_EQ(in.number<std::uint32_t>(), 2);
  EXPECT_THAT(in.numbers<std::uint8_t>(), ElementsAre(0, 255, 0, 255));
  EXPECT_TRUE(in.at_end());
  // In the frame of beams x is down, y to port: the sides look 40 deg below the horizontal.
  CdrRead image = encoded(messages, MessageKind::kSonarImage);
  (void)image.header();
  (void)image.number<float>();
  (void)image.number<float>();
  (void)image.numbers<float>();
  (void)image.numbers<float>();
  (void)image.number<std::uint32_t>();
  const double level = std::cos(sides.depression), down = std::sin(sides.depression);
  EXPECT_THAT(image.doubles(6), ElementsAre(DoubleNear(down, 1e-12), DoubleNear(level, 1e-12), DoubleNear(0, 1e-12),
                                            DoubleNear(down, 1e-12), DoubleNear(-level, 1e-12), DoubleNear(0, 1e-12)));
}

TEST(SonarMessagesTest, SixteenBitsResolveAThousandthOfADecibel) {
  SonarMessages messages(source_of(fan()), {.bits = 16});
  messages.take(ping_of(fan(), kLevels));
  CdrRead in = encoded(messages, MessageKind::kSonarImage);
  (void)in.header();
  (void)in.number<float>();
  (void)in.number<float>();
  (void)in.numbers<float>();
  (void)in.numbers<float>();
  const auto directions = in.number<std::uint32_t>();
  (void)in.doubles(3 * static_cast<int>(directions));
  (void)in.numbers<float>();
  (void)in.number<bool>();
  EXPECT_EQ(in.number<std::uint32_t>(), 2);  // DTYPE_UINT16
  (void)in.number<std::uint32_t>();
  const auto bytes = in.numbers<std::uint8_t>();
  ASSERT_EQ(bytes.size(), 12);
  // Little-endian; -99.9 dB is 65535 x 0.1 / 60 = 109.2.
  EXPECT_EQ(bytes[8] + 256 * bytes[9], 109);
  const double share = (bytes[0] + 256 * bytes[1]) / 65535.0;
  EXPECT_NEAR(10 * std::log10(intensity_of_share(messages.levels(), share, 10)), -100, 0.001);
  EXPECT_EQ(intensity_of_share(messages.levels(), 0, 10), 0);
}

TEST(SonarMessagesTest, LevelsAreTheReceiversOwnWhereItHasAFullScale) {
  MessageSource source = source_of(fan());
  source.receiver.full_scale_db = -20;
  source.sonar.mapping_range_db = 70;
  const MessageLevels levels = SonarMessages(source).levels();
  EXPECT_EQ(levels.low_db, -90);
  EXPECT_EQ(levels.high_db, -20);
  EXPECT_EQ(levels.gain_per_decade, 0);
}

TEST(SonarMessagesTest, PaperModelIsLinear) {
  MessageSource source = source_of(fan());
  source.model = EchoModel::kPaper;
  const MessageLevels levels = SonarMessages(source).levels();
  EXPECT_FALSE(levels.decibels);
  EXPECT_NEAR(intensity_of_share(levels, 0.25, 30), 0.25, 1e-12);
}

// In the middle of their beams; the true ones at the elevation of the ground truth.
void expect_points(MessageKind kind, double truth) {
  // Half of six cells: raised, +5 (30 m, starboard), -40 (10 m, ahead), -70 (10 m, port).
  SonarMessages messages(source_of(fan()), {.strong_share = 0.5});
  Ping ping = ping_of(fan(), kLevels);
  const float none = std::numeric_limits<float>::quiet_NaN();
  ping.elevation = {none, -0.1F, none, none, none, 0.2F};
  messages.take(ping);
  CdrRead in = encoded(messages, kind);
  EXPECT_EQ(in.header(), std::tuple(12, 250'000'000U, "fls_2"));
  EXPECT_EQ(in.number<std::uint32_t>(), 1);
  ASSERT_EQ(in.number<std::uint32_t>(), 3);
  ASSERT_EQ(in.number<std::uint32_t>(), 4);
  for (const auto& [name, offset] :
       {std::pair("x", 0U), std::pair("y", 4U), std::pair("z", 8U), std::pair("intensity", 12U)}) {
    EXPECT_EQ(in.text(), name);
    EXPECT_EQ(in.number<std::uint32_t>(), offset);
    EXPECT_EQ(in.number<std::uint8_t>(), 7);
    EXPECT_EQ(in.number<std::uint32_t>(), 1);
  }
  EXPECT_FALSE(in.number<bool>());
  EXPECT_EQ(in.number<std::uint32_t>(), 16);
  EXPECT_EQ(in.number<std::uint32_t>(), 48);
  ASSERT_EQ(in.number<std::uint32_t>(), 48);
  const auto expect_point = [&](double range, double azimuth, double elevation, double level) {
    const Vec3 place = point_from_spherical({range, azimuth, elevation});
    EXPECT_NEAR(in.number<float>(), place.x(), 1e-5);
    EXPECT_NEAR(in.number<float>(), place.y(), 1e-5);
    EXPECT_NEAR(in.number<float>(), place.z(), 1e-5);
    EXPECT_NEAR(in.number<float>(), level, 1e-4);
  };
  expect_point(10, kQuarter, 0, -100);
  expect_point(10, 0, truth * -0.1, -70);
  expect_point(30, -kQuarter, truth * 0.2, 5 - kGainAt30);
  EXPECT_TRUE(in.number<bool>());
  EXPECT_TRUE(in.at_end());
}

TEST(SonarMessagesTest, PointsAreWhereTheStrongestEchoesCameFrom) {
  expect_points(MessageKind::kPoints, 0);
  expect_points(MessageKind::kTruePoints, 1);
}

TEST(SonarMessagesTest, SilenceHasNoPoints) {
  SonarMessages messages(source_of(fan()), {.strong_share = 1});
  Ping ping = ping_of(fan(), kLevels);
  std::fill(ping.intensity.begin(), ping.intensity.end(), 0.0F);
  messages.take(ping);
  CdrRead in = encoded(messages, MessageKind::kPoints);
  (void)in.header();
  (void)in.number<std::uint32_t>();
  EXPECT_EQ(in.number<std::uint32_t>(), 0);
}

TEST(SonarMessagesTest, FanIsThePictureAtItsFixedLevels) {
  SonarMessages messages(source_of(fan()), {.low_db = -80, .high_db = -40, .fan_height = 240});
  const Ping ping = ping_of(fan(), kLevels);
  messages.take(ping);
  CdrRead in = encoded(messages, MessageKind::kFan);
  EXPECT_EQ(std::get<2>(in.header()), "fls_2");
  Display display = usual_display(EchoModel::kCalibrated, {});
  display.floor_db = -40;
  display.full_scale = 1e-4;
  display.height = 240;
  display.annotations = false;
  const Picture picture = draw_fan(raised_by_range(ping, fan(), 30), fan(), display);
  EXPECT_EQ(in.number<std::uint32_t>(), picture.height);
  EXPECT_EQ(in.number<std::uint32_t>(), picture.width);
  EXPECT_EQ(in.text(), "rgb8");
  EXPECT_EQ(in.number<std::uint8_t>(), 0);
  EXPECT_EQ(in.number<std::uint32_t>(), 3 * picture.width);
  EXPECT_TRUE(in.numbers<std::uint8_t>() == picture.rgb);
  EXPECT_TRUE(in.at_end());
}

// The values of the sonar image, as a picture of its own.
TEST(SonarMessagesTest, RawImageHasAPixelForEachBeamAndBin) {
  for (const int bits : {8, 16}) {
    SonarMessages messages(source_of(fan()), {.bits = bits, .raw = true});
    messages.take(ping_of(fan(), kLevels));
    CdrRead in = encoded(messages, MessageKind::kRaw);
    EXPECT_EQ(std::get<2>(in.header()), "fls_2");
    EXPECT_EQ(in.number<std::uint32_t>(), 2U);  // Bins.
    EXPECT_EQ(in.number<std::uint32_t>(), 3U);  // Beams.
    EXPECT_EQ(in.text(), bits == 8 ? "mono8" : "mono16");
    EXPECT_EQ(in.number<std::uint8_t>(), 0);
    EXPECT_EQ(in.number<std::uint32_t>(), 3U * static_cast<unsigned>(bits) / 8);
    const std::vector<std::uint8_t> bytes = in.numbers<std::uint8_t>();
    EXPECT_TRUE(in.at_end());
    const std::vector<std::byte> image = messages.encode(0);  // Its last field are the values.
    ASSERT_EQ(bytes.size(), 6U * static_cast<unsigned>(bits) / 8);
    EXPECT_TRUE(std::equal(bytes.rbegin(), bytes.rend(), image.rbegin(),
                           [](std::uint8_t a, std::byte b) { return std::byte{a} == b; }));
  }
  SonarMessages without(source_of(fan()));
  EXPECT_THROW((void)encoded(without, MessageKind::kRaw), Error);
}

TEST(SonarMessagesTest, LabelsAreThoseOfThePing) {
  for (const bool known : {true, false}) {
    SonarMessages messages(source_of(fan()), {.live = true});
    Ping ping = ping_of(fan(), kLevels);
    if (known) {
      ping.instance = {4, kNoLabel, 0, 300, 1, 2};
    }
    messages.take(ping);
    CdrRead in = encoded(messages, MessageKind::kLabels);
    EXPECT_EQ(in.header(), std::tuple(12, 250'000'000U, "fls_2"));
    EXPECT_EQ(in.number<std::uint32_t>(), 2U);  // Bins.
    EXPECT_EQ(in.number<std::uint32_t>(), 3U);  // Beams.
    EXPECT_EQ(in.text(), "mono16");
    EXPECT_EQ(in.number<std::uint8_t>(), 0);
    EXPECT_EQ(in.number<std::uint32_t>(), 6U);
    const std::vector<std::uint8_t> bytes = in.numbers<std::uint8_t>();
    std::vector<int> labels;
    for (std::size_t i = 0; i < bytes.size(); i += 2) {
      labels.push_back(bytes[i] + 256 * bytes[i + 1]);
    }
    EXPECT_EQ(labels, known ? std::vector<int>({4, 65535, 0, 300, 1, 2}) : std::vector<int>(6, 65535));
  }
}

TEST(SonarMessagesTest, DescriptionHasBeamsBinsLevelsAndLabels) {
  MessageSource source = source_of(fan());
  source.labels = {"wall", "box::\"link\""};
  SonarMessages messages(source, {.bits = 8, .live = true});
  const auto json = nlohmann::json::parse(encoded(messages, MessageKind::kDescription).text());
  EXPECT_EQ(json["name"], "fls-2");
  EXPECT_EQ(json["type"], "fls");
  EXPECT_EQ(json["frame"], "fls_2");
  EXPECT_EQ(json["azimuths"], nlohmann::json({kQuarter, 0.0, -kQuarter}));
  EXPECT_NEAR(json["receive_widths"][1].get<double>(), kQuarter, 1e-12);
  EXPECT_EQ(json["elevation_aperture"], 0.5);
  EXPECT_EQ(json["max_range"], 40.0);
  EXPECT_EQ(json["bin_count"], 2);
  EXPECT_EQ(json["sound_speed"], 1480.0);
  EXPECT_EQ(json["levels"]["low_db"], -100.0);
  EXPECT_EQ(json["levels"]["bits"], 8);
  EXPECT_EQ(json["labels"], nlohmann::json(source.labels));
  EXPECT_FALSE(json.contains("head"));
}

TEST(SonarMessagesTest, RefusesWhatRosCannotHold) {
  SonarMessages messages(source_of(fan()));
  Ping ping = ping_of(fan(), kLevels);
  ping.time = -0.5;
  EXPECT_EQ(message_of([&] { messages.take(ping); }),
            "ping 7 of fls-2: time = -0.5 s must be from 0 to below 2147483647 s, as ROS messages hold it");
  ping.time = 3e9;
  EXPECT_THAT(message_of([&] { messages.take(ping); }), HasSubstr("time = 3e+09 s"));
  ping.time = 0;
  ping.intensity.pop_back();
  EXPECT_EQ(message_of([&] { messages.take(ping); }), "ping 7 of fls-2 has 5 intensities, must have 6");
}

TEST(SonarMessagesTest, RefusesOptionsOutOfLimits) {
  EXPECT_EQ(message_of([] { SonarMessages(source_of(fan()), {.bits = 12}); }), "messages.bits = 12 must be 8 or 16");
  EXPECT_EQ(message_of([] { SonarMessages(source_of(fan()), {.low_db = -30}); }),
            "messages.low_db = -30 dB must be less than high_db = -40 dB");
  EXPECT_EQ(message_of([] { SonarMessages(source_of(fan()), {.world_frame = ""}); }),
            "messages.world_frame must not be empty");
  EXPECT_EQ(message_of([] { SonarMessages(source_of(fan()), {.strong_share = 0}); }),
            "messages.strong_share = 0 must be greater than 0, at most 1");
}

}  // namespace
}  // namespace insonify::messages_test
