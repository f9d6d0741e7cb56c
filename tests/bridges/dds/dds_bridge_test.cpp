// dds_bridge_test.cpp -- the bridge to DDS, read and steered by another vendor's DDS over loopback.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <thread>

#include "bridges/dds/fast_node.h"
#include "bridges/dds/own_domain.h"
#include "bridges/dds/ros_messages.h"
#include "bridges/dds/started_bridge.h"
#include "dds/dds_names.h"
#include "dds/frame_tree.h"
#include "insonify/recorded_pings.h"
#include "io/mcap/mcap_reader.h"
#include "support/working_folder.h"

namespace insonify {
namespace {

constexpr double kPeriod = 0.0625;  // A power of two: times of poses are exact [s].
constexpr int kPings = 6;

double x_at(int ping) {
  return 0.25 * ping;
}

std::string scenario() {
  std::string text = R"(world: none
points: [{position: [6, 0.5, 0], target_strength_db: -10}]
sonars:
  - {name: fls, beam_count: 24, bin_count: 90, azimuth_aperture_deg: 70, elevation_aperture_deg: 25, max_range: 12,
     ping_period: 0.0625, sampling: {columns_per_beam: 2, rows: 40}}
pings: 6
trajectory:
)";
  for (int i = 0; i <= kPings; ++i) {
    text += "  - {time: " + std::to_string(i * kPeriod) + ", position: [" + std::to_string(x_at(i)) + ", 0.5, 0]}\n";
  }
  return text;
}

// Without the up to three bytes that fill the last four.
Bytes cut_to(Bytes message, std::size_t size) {
  if (message.size() >= size && message.size() < size + 4) {
    message.resize(size);
  }
  return message;
}

class DdsBridgeTest : public testing::Test {
 protected:
  [[nodiscard]] StartedBridge start(const std::vector<std::string>& words) const { return {domain_.number(), words}; }

  WorkingFolder folder_;
  OwnDomain domain_;
  FastNode node_{domain_.number()};
};

TEST(DdsNamesTest, AreThoseOfRos2) {
  EXPECT_EQ(dds_topic_name("/fls/fan"), "rt/fls/fan");
  EXPECT_EQ(dds_topic_name("odom"), "rt/odom");
  EXPECT_EQ(dds_type_name("tf2_msgs/msg/TFMessage"), "tf2_msgs::msg::dds_::TFMessage_");
}

TEST(TypeHashTest, IsThatWhichRos2Prints) {
  EXPECT_EQ(type_hash("std_msgs::msg::dds_::String_"),
            "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
  EXPECT_EQ(type_hash("std_msgs::msg::dds_::Strings_"), "");
}

TEST(FrameTreeTest, ComposesTransformsUpwards) {
  FrameTree tree;
  tree.set("odom", "/base_link", {Vec3(1, 2, 0), orientation_from_rpy(0, 0, radians_from_degrees(90))}, 5);
  tree.set("world", "odom", {Vec3(10, 0, 0), Eigen::Quaterniond::Identity()}, 3);
  tree.set("base_link", "sonar", {Vec3(1, 0, 0), Eigen::Quaterniond::Identity()}, 0);
  const auto place = tree.find("world", "sonar");
  ASSERT_TRUE(place);
  EXPECT_LT((place->pose.position - Vec3(11, 3, 0)).norm(), 1e-12);  // 10 + 1, and 2 + 1 turned to y.
  EXPECT_EQ(place->stamp, 5);
  EXPECT_FALSE(tree.find("map", "sonar"));
  EXPECT_EQ(tree.top("sonar"), "world");
  tree.set("sonar", "world", {}, 1);  // A circle.
  EXPECT_FALSE(tree.find("map", "sonar"));
}

// Between the values of an image, in steps of their 16 bits, and those that intensities have by
// docs/reference/messages.md.
double largest_difference(const SonarImage& image, const std::vector<double>& intensities) {
  constexpr double kLowest = -100, kStep = 60.0 / 65535, kGainPerDecade = 30;  // [dB]
  if (image.values.size() != intensities.size()) {
    return std::numeric_limits<double>::infinity();
  }
  double largest = 0;
  for (std::size_t i = 0; i < intensities.size(); ++i) {
    const double range = image.ranges[i / image.azimuths.size()];
    const double level = 10 * std::log10(intensities[i]) + kGainPerDecade * std::log10(range);  // -inf for 0.
    const double expected = std::clamp((level - kLowest) / kStep, 0.0, 65535.0);
    largest = std::max(largest, std::abs(image.values[i] - expected));
  }
  return largest;
}

void expect_levels_of(const RecordedPings& recording, std::uint64_t ping, const Bytes& message) {
  const SonarImage image = sonar_image(message);
  ASSERT_EQ(image.ranges.size(), static_cast<std::size_t>(recording.bin_count()));
  EXPECT_NEAR(image.time, recording.ping(ping).time, 2e-9);
  EXPECT_LE(largest_difference(image, recording.intensity(ping)), 1) << "ping " << ping;
  EXPECT_GT(std::ranges::count_if(image.values, [](auto value) { return value > 0 && value < 65535; }), 20);  // Echoes.
}

using Readers = std::map<std::string, std::unique_ptr<FastReader>>;

// Sends poses and times until each reader has a message for each of them; a failure otherwise.
void ping_along(FastNode& node, const Readers& readers) {
  const auto odom = node.writer("rt/auv/odom", "nav_msgs::msg::dds_::Odometry_");
  const auto clock = node.writer("rt/clock", "rosgraph_msgs::msg::dds_::Clock_", {.reliable = false});
  ASSERT_TRUE(odom->wait_for_reader());
  ASSERT_TRUE(clock->wait_for_reader());
  for (const auto& [topic, reader] : readers) {
    ASSERT_TRUE(reader->wait_for_writer()) << topic;
  }
  std::this_thread::sleep_for(kDiscovery);
  for (int i = 0; i < kPings; ++i) {
    for (int attempt = 0; attempt < 10; ++attempt) {  // The same pose and time again change nothing.
      odom->write(odometry(i * kPeriod, x_at(i), 0.5));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      clock->write(clock_message(i * kPeriod));
      if (readers.begin()->second->wait_for(static_cast<std::size_t>(i) + 1, std::chrono::seconds(1))) {
        break;
      }
    }
    for (const auto& [topic, reader] : readers) {
      ASSERT_TRUE(reader->wait_for(static_cast<std::size_t>(i) + 1)) << topic << ", ping " << i;
    }
  }
}

// The first message has the stamp 1 ns, and 0 in the recording.
void expect_same(const McapReader& mcap, const Readers& readers) {
  for (const auto& [topic, reader] : readers) {
    const std::vector<McapReader::Entry>& entries = mcap.messages(topic);
    ASSERT_EQ(entries.size(), static_cast<std::size_t>(kPings)) << topic;
    const std::vector<Bytes> messages = reader->messages();
    for (std::size_t i = 1; i < entries.size(); ++i) {
      const Bytes expected = mcap.read(entries[i]);
      EXPECT_TRUE(cut_to(messages[i], expected.size()) == expected) << topic << ", ping " << i;
    }
  }
}

// Poses and time of another vendor's program in, messages out: the same bytes as the recording of the same pings has.
TEST_F(DdsBridgeTest, MessagesAreThoseOfTheRecordings) {
  folder_.write("dive.yaml", scenario());
  ASSERT_EQ(std::system(INSONIFY_CLI " run dive.yaml -o out --record h5,mcap --no-pictures > said.txt"), 0);
  std::filesystem::path recorded;
  for (const auto& entry : std::filesystem::directory_iterator("out")) {
    recorded = entry.path().extension() == ".mcap" ? entry.path() : recorded;
  }
  const McapReader mcap(recorded);

  StartedBridge bridge = start({"--odometry", "/auv/odom", "--clock", "simulated"});
  Readers readers;
  for (const auto& [topic, type] : mcap.topics()) {
    if (topic != "/scenario") {
      readers[topic] = node_.reader(dds_topic_name(topic), dds_type_name(type));
    }
  }
  ASSERT_EQ(readers.size(), 6U);
  ASSERT_NO_FATAL_FAILURE(ping_along(node_, readers));
  expect_same(mcap, readers);
  const RecordedPings hdf5("out/fls.h5");
  ASSERT_EQ(hdf5.ping_count(), static_cast<std::uint64_t>(kPings));
  for (std::uint64_t i = 0; i < kPings; ++i) {
    expect_levels_of(hdf5, i, readers.at("/fls/sonar_image")->messages().at(i));
  }
  const auto late = node_.reader("rt/scenario", "std_msgs::msg::dds_::String_", {.transient_local = true});
  EXPECT_TRUE(late->wait_for(1));  // Long after it was sent.
  double seconds = 0;
  EXPECT_EQ(bridge.end(&seconds), 0);
  EXPECT_LT(seconds, kPrompt);
}

// A multibeam 5 m above a floor, and a fan, which has no soundings.
TEST_F(DdsBridgeTest, SoundingsAreThoseOfTheRecordings) {
  folder_.write("floor.obj", "v -50 -50 -5\nv 50 -50 -5\nv 50 50 -5\nv -50 50 -5\nf 1 2 3 4\n");
  std::string text = scenario();
  text.replace(text.find("none"), 4, "floor.obj");
  text.insert(text.find("pings:"),
              R"(  - {name: swath, type: mbes, beam_count: 24, bin_count: 200, azimuth_aperture_deg: 120,
     azimuth_resolution_deg: 4, elevation_aperture_deg: 4, max_range: 12, ping_period: 0.0625}
)");
  folder_.write("dive.yaml", text);
  ASSERT_EQ(std::system(INSONIFY_CLI " run dive.yaml -o out --record mcap --no-pictures > said.txt"), 0);
  const McapReader mcap("out/swath.mcap");
  EXPECT_FALSE(McapReader("out/fls.mcap").topics().contains("/fls/detections"));
  StartedBridge bridge = start({"--odometry", "/auv/odom", "--clock", "simulated"});
  Readers readers;
  for (const char* topic : {"/swath/detections", "/swath/soundings"}) {
    readers[topic] = node_.reader(dds_topic_name(topic), dds_type_name(mcap.topics().at(topic)));
  }
  ASSERT_NO_FATAL_FAILURE(ping_along(node_, readers));
  expect_same(mcap, readers);
  EXPECT_EQ(node_.user_data("rt/swath/detections"),
            fmt::format("typehash={};", type_hash("marine_acoustic_msgs::msg::dds_::SonarDetections_")));
  constexpr std::size_t kWithoutPoints = 400;  // Greater than the cloud's other fields [bytes].
  EXPECT_GT(readers.at("/swath/soundings")->messages().back().size(), kWithoutPoints);
}

// Messages with stamps from a time on [s]; they begin with a header.
std::vector<Bytes> from(std::int32_t time, const std::vector<Bytes>& messages) {
  std::vector<Bytes> found;
  std::ranges::copy_if(messages, std::back_inserter(found),
                       [&](const Bytes& message) { return CdrReader(message).get<std::int32_t>() >= time; });
  return found;
}

// Twenty poses at once have twenty pings, with their stamps; whoever comes later knows the sonar and where it is
// mounted. Pings before tell that the bridge knows the readers: that they know it is not enough.
TEST_F(DdsBridgeTest, EachPoseThatIsAskedForHasAPing) {
  constexpr int kAsked = 20, kFirst = 1'000'000;  // [s]
  folder_.write("dive.yaml", scenario());
  StartedBridge bridge = start({"--ping-at", "/insonify/ping", "--vehicle-frame", "base_link"});
  const auto poses = node_.reader("rt/fls/pose", "geometry_msgs::msg::dds_::PoseStamped_");
  const auto labels = node_.reader("rt/fls/labels", "sensor_msgs::msg::dds_::Image_");
  const auto ping = node_.writer("rt/insonify/ping", "geometry_msgs::msg::dds_::PoseStamped_");
  ASSERT_TRUE(ping->wait_for_reader());
  ASSERT_TRUE(poses->wait_for_writer());
  ASSERT_TRUE(labels->wait_for_writer());
  for (int i = 1; i < 600 && (poses->messages().empty() || labels->messages().empty()); ++i) {
    ping->write(pose_stamped(i, 0, 0, 0));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  for (int i = 0; i < kAsked; ++i) {
    ping->write(pose_stamped(kFirst + 0.5 * i, x_at(i), 1, radians_from_degrees(90)));
  }
  for (const auto* const reader : {&poses, &labels}) {
    for (int i = 0; i < 600 && from(kFirst, (*reader)->messages()).size() < kAsked; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  EXPECT_EQ(from(kFirst, labels->messages()).size(), std::size_t{kAsked});
  const std::vector<Bytes> messages = from(kFirst, poses->messages());
  ASSERT_EQ(messages.size(), std::size_t{kAsked});
  for (int i = 0; i < kAsked; ++i) {
    const Bytes expected = pose_stamped(kFirst + 0.5 * i, x_at(i), 1, radians_from_degrees(90));
    EXPECT_TRUE(cut_to(messages[static_cast<std::size_t>(i)], expected.size()) == expected) << i;
  }
  const auto late = node_.reader("rt/fls/description", "std_msgs::msg::dds_::String_", {.transient_local = true});
  ASSERT_TRUE(late->wait_for(1));
  const Bytes description = late->messages().front();
  EXPECT_THAT(CdrReader(description).text(), testing::StartsWith(R"({"name":"fls","type":"fls",)"));
  const auto mountings = node_.reader("rt/tf_static", "tf2_msgs::msg::dds_::TFMessage_", {.transient_local = true});
  ASSERT_TRUE(mountings->wait_for(1));
  const Bytes mounting = mountings->messages().front();
  CdrReader cdr(mounting);
  EXPECT_EQ(cdr.get<std::uint32_t>(), 2U);
  (void)cdr.get<std::int32_t>();
  (void)cdr.get<std::uint32_t>();
  EXPECT_EQ(cdr.text(), "base_link");
  EXPECT_EQ(cdr.text(), "fls");
  EXPECT_EQ(node_.user_data("rt/insonify/ping"),
            fmt::format("typehash={};", type_hash("geometry_msgs::msg::dds_::PoseStamped_")));
  EXPECT_EQ(from(kFirst, poses->messages()).size(), std::size_t{kAsked});
}

// Heading to +y at 9 m/s: along the axes of the vehicle that is (9, 0, 0). While a sonar listens to 40 m it moves by
// half a metre, as the echoes of `insonify run` show on a trajectory of that speed.
TEST_F(DdsBridgeTest, TheTwistOfOdometryIsAlongTheAxesOfTheVehicle) {
  folder_.write("dive.yaml", R"(world: none
motion_in_ping: true
points: [{position: [0.5, 30, 0], target_strength_db: -10}, {position: [-8, 20, 1], target_strength_db: -15}]
sonars:
  - {name: fls, beam_count: 24, bin_count: 900, azimuth_aperture_deg: 70, elevation_aperture_deg: 25, max_range: 40,
     ping_period: 0.25, receiver: {speckle: false}, sampling: {columns_per_beam: 2, rows: 40}}
trajectory:
  - {time: 0, position: [0, 0, 0], orientation_deg: [0, 0, 90]}
  - {time: 10, position: [0, 90, 0], orientation_deg: [0, 0, 90]}
)");
  ASSERT_EQ(std::system(INSONIFY_CLI " run dive.yaml -o out --record h5 --no-pictures --pings 1 > said.txt"), 0);
  const std::vector<double> expected = RecordedPings("out/fls.h5").intensity(0);
  for (const double speed : {9.0, 0.0}) {
    StartedBridge bridge = start({"--odometry", "/auv/odom", "--clock", "simulated"});
    FastNode vehicle(domain_.number());
    const auto images = vehicle.reader("rt/fls/sonar_image", "marine_acoustic_msgs::msg::dds_::ProjectedSonarImage_");
    const auto odom = vehicle.writer("rt/auv/odom", "nav_msgs::msg::dds_::Odometry_");
    const auto clock = vehicle.writer("rt/clock", "rosgraph_msgs::msg::dds_::Clock_", {.reliable = false});
    ASSERT_TRUE(odom->wait_for_reader());
    ASSERT_TRUE(clock->wait_for_reader());
    ASSERT_TRUE(images->wait_for_writer());
    std::this_thread::sleep_for(kDiscovery);
    for (int attempt = 0; attempt < 20 && images->messages().empty(); ++attempt) {  // The same again changes nothing.
      odom->write(odometry(0, 0, 0, radians_from_degrees(90), speed));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      clock->write(clock_message(0));
      (void)images->wait_for(1, std::chrono::seconds(1));
    }
    ASSERT_FALSE(images->messages().empty());
    const double difference = largest_difference(sonar_image(images->messages().front()), expected);
    if (speed > 0) {
      EXPECT_LE(difference, 1);
    } else {
      EXPECT_GT(difference, 1000);  // The speed alone makes a difference.
    }
  }
}

TEST_F(DdsBridgeTest, AMessageOfMegabytesGetsThrough) {
  folder_.write("dive.yaml", scenario());
  StartedBridge bridge = start({"--fan-height", "900"});
  const auto reader = node_.reader("rt/fls/fan", "sensor_msgs::msg::dds_::Image_");
  ASSERT_TRUE(reader->wait_for(5));
  for (const Bytes& message : reader->messages()) {
    EXPECT_GT(message.size(), std::size_t{2} << 20);
    EXPECT_EQ(message.size(), reader->messages().front().size());
  }
}

TEST_F(DdsBridgeTest, SettingsActAndAreAnswered) {
  folder_.write("dive.yaml", scenario());
  StartedBridge bridge = start({});
  const auto set = node_.writer("rt/insonify/set", "std_msgs::msg::dds_::String_");
  const auto answers = node_.reader("rt/insonify/set_result", "std_msgs::msg::dds_::String_");
  ASSERT_TRUE(set->wait_for_reader());
  ASSERT_TRUE(answers->wait_for_writer());
  std::this_thread::sleep_for(kDiscovery);
  const auto ask = [&](std::string_view text, std::size_t count) {
    RosWriter cdr;
    cdr.put(text);
    set->write(cdr.take());
    EXPECT_TRUE(answers->wait_for(count));
    if (answers->messages().empty()) {
      return std::string();
    }
    const Bytes answer = answers->messages().back();
    return CdrReader(answer).text();
  };
  const std::string hash = fmt::format("typehash={};", type_hash("std_msgs::msg::dds_::String_"));
  for (const char* topic : {"rt/insonify/set", "rt/insonify/set_result", "rt/scenario"}) {
    EXPECT_EQ(node_.user_data(topic), hash) << topic;
  }
  EXPECT_EQ(ask("max_range=9", 1), "done: max_range=9");
  EXPECT_THAT(ask("max_range=-3", 2), testing::StartsWith("refused: "));
  EXPECT_THAT(ask("", 3), testing::StartsWith("refused: "));
}

}  // namespace
}  // namespace insonify
