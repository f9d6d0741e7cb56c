// The component of ROS 2 publishes pings as the bridge to DDS does, with rclcpp's stand-ins in its place.
#include "sonar_node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "insonify/files.h"
#include "insonify/simulator.h"

namespace insonify::ros2_node_test {
namespace {

using insonify_ros2::SonarNode;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr std::chrono::seconds kPatience{30};  // Limits only end a test that fails.

// A CDR message has four bytes of its own and then the stamp.
double stamp_of(const std::vector<std::uint8_t>& message) {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  std::memcpy(&sec, message.data() + 4, 4);
  std::memcpy(&nanosec, message.data() + 8, 4);
  return sec + 1e-9 * nanosec;
}

// These messages end with position and orientation.
void expect_pose_near(const std::vector<std::uint8_t>& found, const std::vector<std::byte>& expected) {
  std::array<double, 7> pose{}, expected_pose{};
  std::memcpy(pose.data(), found.data() + found.size() - sizeof pose, sizeof pose);
  std::memcpy(expected_pose.data(), expected.data() + expected.size() - sizeof pose, sizeof pose);
  EXPECT_THAT(pose, testing::Pointwise(testing::DoubleNear(1e-6), expected_pose));
}

class SonarNodeTest : public ::testing::Test {
 protected:
  SonarNodeTest() {
    rclcpp::graph().topics.clear();
    rclcpp::graph().subscribers.clear();
    rclcpp::graph().warnings.clear();
    rclcpp::graph().absent_package.clear();
    std::ofstream(scenario_)
        << "points: [{position: [6, 1, 0], target_strength_db: -55}]\n"
           "sonars: [{name: fls, beam_count: 24, bin_count: 90, max_range: 12, ping_period: 0.02,\n"
           "          sampling: {columns_per_beam: 2, rows: 20}}]\n";
  }
  ~SonarNodeTest() override { std::filesystem::remove(scenario_); }

  void start(std::vector<rclcpp::Parameter> parameters = {}) {
    rclcpp::NodeOptions options;
    options.parameter_overrides() = std::move(parameters);
    options.parameter_overrides().emplace_back("scenario", scenario_.string());
    node_.emplace(options);
  }

  static std::vector<std::vector<std::uint8_t>> messages(const std::string& topic) {
    const std::lock_guard lock(rclcpp::graph().mutex);
    return rclcpp::graph().topics[topic].messages;
  }

  static std::vector<std::uint8_t> message(const std::string& topic, std::size_t number = 0) {
    std::unique_lock lock(rclcpp::graph().mutex);
    const auto& all = rclcpp::graph().topics[topic].messages;
    rclcpp::graph().changed.wait_for(lock, kPatience, [&] { return all.size() > number; });
    return all.size() > number ? all[number] : throw std::runtime_error("no message on " + topic);
  }

  // Waits for a message that has this text.
  static bool says(const std::string& topic, const std::string& text) {
    const auto has_text = [&](const std::vector<std::uint8_t>& each) {
      return std::string(each.begin(), each.end()).find(text) != std::string::npos;
    };
    std::unique_lock lock(rclcpp::graph().mutex);
    return rclcpp::graph().changed.wait_for(
        lock, kPatience, [&] { return std::ranges::any_of(rclcpp::graph().topics[topic].messages, has_text); });
  }

  template <typename Message>
  static void write(const std::string& topic, const Message& message) {
    rclcpp::graph().subscribers.at(topic)(&message);
  }

  rcl_interfaces::msg::SetParametersResult set(const std::string& name, const rclcpp::Value& value) {
    return node_->set_parameters_atomically({{name, value}});
  }

  std::filesystem::path scenario_ =
      std::filesystem::temp_directory_path() / ("ros2_node_" + std::to_string(getpid()) + ".yaml");
  std::optional<SonarNode> node_;
};

// The odometry's stamp makes the messages those of the same ping of a simulator, to the last byte.
TEST_F(SonarNodeTest, MessagesAreThoseOfAPingFromTheOdometrysPose) {
  start({{"odometry", std::string("/auv/odom")}, {"bits", std::int64_t{16}}, {"at_once", true}});
  nav_msgs::msg::Odometry odometry;
  odometry.header.stamp = {7, 250'000'000};
  odometry.pose.pose.position = {1.5, 0.5, -0.25};
  odometry.pose.pose.orientation = {0, 0, std::sin(0.1), std::cos(0.1)};
  write("/auv/odom", odometry);

  const Scenario scenario = load_scenario(scenario_);
  Simulator simulator(scenario, load_scene(scenario));
  PingRequest request;
  request.world_from_vehicle = {.position = {1.5, 0.5, -0.25},
                                .orientation = Eigen::Quaterniond(std::cos(0.1), 0, 0, std::sin(0.1))};
  const Ping ping = simulator.ping(0, request);
  SonarMessages expected(message_source(scenario, simulator.sonar(0)), {.bits = 16, .raw = true, .live = true});
  expected.take(ping, 7.25);
  (void)message("/fls/pose");  // All topics are there before the first ping.
  for (std::size_t channel = 0; channel < expected.channels().size(); ++channel) {
    const MessageChannel& is = expected.channels()[channel];
    {
      const std::lock_guard lock(rclcpp::graph().mutex);
      EXPECT_EQ(rclcpp::graph().topics[is.topic].type, is.type);
      EXPECT_EQ(rclcpp::graph().topics[is.topic].is_latched, is.latched);
    }
    if (!is.latched && is.kind != MessageKind::kScan) {
      const auto bytes = expected.encode(channel);
      const auto found = message(is.topic);
      ASSERT_EQ(found.size(), bytes.size()) << is.topic;
      if (is.kind == MessageKind::kPose || is.kind == MessageKind::kTransforms) {
        expect_pose_near(found, bytes);  // Live poses are kept to a micrometre.
        continue;
      }
      EXPECT_EQ(std::memcmp(found.data(), bytes.data(), bytes.size()), 0) << is.topic;
    }
  }
}

TEST_F(SonarNodeTest, WithoutAPoseOfItsOdometryThereIsNoPing) {
  start({{"odometry", std::string("/auv/odom")}});
  (void)message("/fls/description");  // The topics are there all the same.
  nav_msgs::msg::Odometry odometry;
  odometry.header.stamp.sec = 7;
  odometry.pose.pose.orientation.w = 1;
  write("/auv/odom", odometry);
  EXPECT_EQ(stamp_of(message("/fls/pose")), 7);  // The first of all.
  EXPECT_THAT(rclcpp::graph().warnings, SizeIs(0));
}

TEST_F(SonarNodeTest, EachPoseThatAsksHasAPing) {
  start({{"ping_at", std::string("/ask")}});
  constexpr int kPings = 20;
  for (int number = 1; number <= kPings; ++number) {
    geometry_msgs::msg::PoseStamped pose;
    pose.header.stamp.sec = number;
    write("/ask", pose);
  }
  (void)message("/fls/pose", kPings - 1);
  geometry_msgs::msg::PoseStamped last;  // A ping that nobody has asked for would come before it.
  last.header.stamp.sec = kPings + 1;
  write("/ask", last);
  for (int number = 1; number <= kPings + 1; ++number) {
    EXPECT_EQ(stamp_of(message("/fls/pose", static_cast<std::size_t>(number - 1))), number);
  }
}

// Sound takes 2 x 75 m / 1500 m/s = 0.1 s.
TEST_F(SonarNodeTest, APingIsPublishedWhenItsLastEchoCouldBeBack) {
  start({{"settings", std::vector<std::string>{"max_range=75", "ping_period=0.2"}}});
  const double stamp = stamp_of(message("/fls/pose"));
  const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  EXPECT_GE(now - stamp, 0.0999);
}

TEST_F(SonarNodeTest, PingsKeepTheTimeOfSimulatedTime) {
  start({{"use_sim_time", true}});
  EXPECT_THAT(messages("/fls/pose"), SizeIs(0));
  constexpr std::size_t kPings = 5;
  constexpr std::uint32_t kMost = 4000;  // Steps of 5 ms.
  for (std::uint32_t step = 0; step < kMost && messages("/fls/pose").size() < kPings; ++step) {
    const std::uint32_t ms = 5 * step;
    write("/clock", rosgraph_msgs::msg::Clock{{5 + static_cast<std::int32_t>(ms / 1000), ms % 1000 * 1'000'000}});
    {  // So that steps do not run away from the pings.
      std::unique_lock lock(rclcpp::graph().mutex);
      rclcpp::graph().changed.wait_for(lock, std::chrono::milliseconds(5));
    }
    for (const auto& each : messages("/fls/pose")) {  // Sound takes 16 ms to 12 m and back.
      EXPECT_LE(stamp_of(each) + 0.016, 5 + 0.005 * step + 1e-6);
      EXPECT_GE(stamp_of(each), 5);
    }
  }
  EXPECT_THAT(messages("/fls/pose"), SizeIs(testing::Ge(kPings)));
}

TEST_F(SonarNodeTest, RangeIsAParameter) {
  start();
  EXPECT_EQ(node_->get_parameter("fls.max_range").as_double(), 12);
  EXPECT_TRUE(says("/fls/description", "\"max_range\":12"));
  EXPECT_TRUE(set("fls.max_range", 8.0).successful);
  EXPECT_TRUE(says("/fls/description", "\"max_range\":8"));
  const auto refused = set("fls.max_range", -1.0);
  EXPECT_FALSE(refused.successful);
  EXPECT_THAT(refused.reason, HasSubstr("max_range = -1 m"));
  EXPECT_EQ(node_->get_parameter("fls.max_range").as_double(), 8);
}

TEST_F(SonarNodeTest, ARangeGivenAtTheStartIsApplied) {
  start({{"fls.max_range", 9.0}});
  EXPECT_TRUE(says("/fls/description", "\"max_range\":9"));
  node_.reset();
  EXPECT_THAT(
      [this] {
        start({{"fls.max_range", -1.0}});
      },
      testing::ThrowsMessage<Error>(HasSubstr("max_range = -1 m")));
}

TEST_F(SonarNodeTest, SettingsAreAppliedTogetherOrNotAtAll) {
  start();
  EXPECT_THAT(set("settings", std::vector<std::string>{"max_range=9", "no_such_key=1"}).reason,
              HasSubstr("no_such_key"));
  EXPECT_TRUE(set("settings", std::vector<std::string>{"max_range=9", "bin_count=80"}).successful);
  EXPECT_TRUE(says("/scenario", "bin_count: 80"));
  EXPECT_FALSE(set("scenario", std::string("other.yaml")).successful);
}

// An image's values of 8 bits span 60 dB: 6 dB more are 25 or 26 of 255.
TEST_F(SonarNodeTest, TheGainRaisesTheLevelsOfImages) {
  start();
  const auto loudest = [](const std::vector<std::uint8_t>& image) {
    return *std::max_element(image.end() - 24 * 90, image.end());
  };
  const int before = loudest(message("/fls/raw"));
  ASSERT_GT(before, 0);
  ASSERT_LT(before, 225);
  EXPECT_TRUE(set("fls.gain_db", 6.0).successful);
  const std::size_t made = messages("/fls/raw").size();
  EXPECT_NEAR(loudest(message("/fls/raw", made + 6)), before + 25.5,
              1);  // At most four had been made before, and one sent.
  EXPECT_EQ(set("fls.gain_db", 101.0).reason, "fls.gain_db must be from -100 to 100 dB");
}

TEST_F(SonarNodeTest, ATypeThatIsNotInstalledIsReportedOnceAndTheOthersArePublished) {
  rclcpp::graph().absent_package = "marine_acoustic_msgs";
  start();
  (void)message("/fls/fan", 2);
  const std::lock_guard lock(rclcpp::graph().mutex);
  EXPECT_THAT(rclcpp::graph().warnings,
              testing::ElementsAre("/fls/sonar_image is not published: package 'marine_acoustic_msgs' not found"));
}

TEST_F(SonarNodeTest, AMissingScenarioIsAnError) {
  std::filesystem::remove(scenario_);
  EXPECT_THAT([this] { start(); }, testing::ThrowsMessage<Error>(HasSubstr("no such file")));
}

}  // namespace
}  // namespace insonify::ros2_node_test
