// message_frames_test.cpp -- topics and frames of the messages of a ping, and those of scanning heads.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "insonify/messages.h"
#include "io/message/message_display.h"
#include "io/recording/small_messages.h"
#include "support/message_of.h"

namespace insonify::message_frames_test {
namespace {

using namespace small_messages;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(MessageFramesTest, SonarsOfAScenarioHaveTopicsOfTheirOwn) {
  Scenario scenario;
  for (const char* name : {"à", "é"}) {
    scenario.sonars.push_back(fan());
    scenario.sonars.back().name = name;
  }
  const auto topic = [&](int sonar) {
    return SonarMessages(message_source(scenario, scenario.sonars[sonar])).channels().front().topic;
  };
  EXPECT_EQ(topic(0), "/_/sonar_image");
  EXPECT_EQ(topic(1), "/__2/sonar_image");
}

TEST(MessageFramesTest, NamesTopicsAfterTheSonar) {
  const SonarMessages messages(source_of(fan()));
  std::vector<std::string> topics;
  for (const MessageChannel& channel : messages.channels()) {
    topics.push_back(channel.topic + " " + channel.type);
  }
  EXPECT_THAT(topics,
              ElementsAre("/fls_2/sonar_image marine_acoustic_msgs/msg/ProjectedSonarImage",
                          "/fls_2/fan sensor_msgs/msg/Image", "/fls_2/points sensor_msgs/msg/PointCloud2",
                          "/fls_2/true_points sensor_msgs/msg/PointCloud2", "/fls_2/pose geometry_msgs/msg/PoseStamped",
                          "/tf tf2_msgs/msg/TFMessage", "/scenario std_msgs/msg/String"));
}

TEST(MessageFramesTest, FramesLeadFromTheWorldToTheBeams) {
  SonarConfig sonar = fan();
  sonar.elevation_center = -0.3;
  SonarMessages messages(source_of(sonar));
  messages.take(ping_of(sonar, kLevels));
  CdrRead in = encoded(messages, MessageKind::kTransforms);
  ASSERT_EQ(in.number<std::uint32_t>(), 2);
  EXPECT_EQ(std::get<2>(in.header()), "world");
  EXPECT_EQ(in.text(), "fls_2");
  const std::vector<double> housing = in.doubles(7);
  EXPECT_THAT(housing, ElementsAre(1, 2, -3, DoubleNear(0, 1e-12), DoubleNear(0, 1e-12),
                                   DoubleNear(std::sin(kQuarter), 1e-12), DoubleNear(std::cos(kQuarter), 1e-12)));
  EXPECT_EQ(std::get<2>(in.header()), "fls_2");
  EXPECT_EQ(in.text(), "fls_2_beams");
  const std::vector<double> beams = in.doubles(7);
  const Eigen::Quaterniond turn(beams[6], beams[3], beams[4], beams[5]);
  EXPECT_TRUE((turn * Vec3::UnitZ()).isApprox(Vec3(std::cos(-0.3), 0, std::sin(-0.3)), 1e-12));
  EXPECT_TRUE((turn * Vec3::UnitY()).isApprox(Vec3::UnitY(), 1e-12));
  EXPECT_TRUE(in.at_end());
}

TEST(MessageFramesTest, PoseIsThatOfTheHousing) {
  SonarMessages messages(source_of(fan()), {.world_frame = "map"});
  messages.take(ping_of(fan(), kLevels));
  CdrRead in = encoded(messages, MessageKind::kPose);
  EXPECT_EQ(in.header(), std::tuple(12, 250'000'000U, "map"));
  EXPECT_THAT(in.doubles(3), ElementsAre(1, 2, -3));
  (void)in.doubles(4);
  EXPECT_TRUE(in.at_end());
}

// Two sonars on a vehicle, the second 2 m ahead of its middle and turned to port.
TEST(MessageFramesTest, MountingsAreOneStaticMessage) {
  SonarConfig other = fan();
  other.name = "port";
  other.position = Vec3(2, 0, 0);
  other.orientation = Vec3(0, 0, 2 * kQuarter);
  const MessageOptions options{.vehicle_frame = "base_link"};
  std::vector<SonarMessages> sonars;
  sonars.emplace_back(source_of(fan()), options);
  sonars.emplace_back(source_of(other), options);
  const MessageChannel& channel = sonars[0].channels()[5];
  EXPECT_EQ(channel.topic, "/tf_static");
  EXPECT_TRUE(channel.latched);
  CdrRead in(SonarMessages::mountings(sonars));
  ASSERT_EQ(in.number<std::uint32_t>(), 4U);
  std::vector<std::string> frames;
  std::vector<double> last;
  for (int i = 0; i < 4; ++i) {
    const auto [seconds, nanoseconds, parent] = in.header();
    frames.push_back(parent + " " + in.text());
    const std::vector<double> numbers = in.doubles(7);
    last = i == 2 ? numbers : last;
  }
  EXPECT_THAT(frames, ElementsAre("base_link fls_2", "fls_2 fls_2_beams", "base_link port", "port port_beams"));
  EXPECT_THAT(last, testing::Pointwise(testing::DoubleNear(1e-12),
                                       std::vector<double>{2, 0, 0, 0, 0, std::sin(kQuarter), std::cos(kQuarter)}));
}

TEST(MessageFramesTest, ScenarioIsItsText) {
  SonarMessages messages(source_of(fan()));
  messages.take(ping_of(fan(), kLevels));
  CdrRead in = encoded(messages, MessageKind::kScenario);
  EXPECT_EQ(in.text(), "pings: 3\n");
  EXPECT_TRUE(in.at_end());
}

SonarConfig head() {
  SonarConfig sonar = fan();
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.beam_azimuths = {};
  sonar.azimuth_aperture = 0.05;
  sonar.head.step = kQuarter;
  return sonar;
}

TEST(MessageFramesTest, BeamOfAScanningHeadTurnsWithIt) {
  SonarMessages messages(source_of(head()), {.strong_share = 0.5});
  Ping ping = ping_of(head(), {-60, -200});
  ping.head_angle = 2 * kQuarter;  // To port.
  messages.take(ping);
  CdrRead in = encoded(messages, MessageKind::kSonarImage);
  (void)in.header();
  (void)in.number<float>();
  (void)in.number<float>();
  EXPECT_EQ(in.numbers<float>().size(), 1);
  (void)in.numbers<float>();
  ASSERT_EQ(in.number<std::uint32_t>(), 1);
  EXPECT_THAT(in.doubles(3), ElementsAre(0, DoubleNear(1, 1e-12), DoubleNear(0, 1e-12)));
  CdrRead points = encoded(messages, MessageKind::kPoints);
  (void)points.header();
  (void)points.number<std::uint32_t>();
  EXPECT_EQ(points.number<std::uint32_t>(), 1);
}

TEST(MessageFramesTest, FanOfAScanningHeadShowsItsLastTurn) {
  // Eight steps make a turn: after nine pings the first is forgotten, whose place the ninth takes anyway; so the
  // picture is that of the last eight alone.
  SonarMessages all(source_of(head()), {.fan_height = 240});
  SonarMessages last(source_of(head()), {.fan_height = 240});
  SonarMessages one(source_of(head()), {.fan_height = 240});
  for (int i = 0; i < 9; ++i) {
    Ping ping = ping_of(head(), {-70.0 - i, -90});
    ping.head_angle = i * kQuarter;
    all.take(ping);
    if (i > 0) {
      last.take(ping);
    }
    if (i == 8) {
      one.take(ping);
    }
  }
  EXPECT_TRUE(all.encode(1) == last.encode(1));
  EXPECT_FALSE(all.encode(1) == one.encode(1));
}

}  // namespace
}  // namespace insonify::message_frames_test
