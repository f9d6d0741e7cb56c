// dds_inputs_test.cpp -- the bridge to DDS goes where odometry and tf of another vendor's programs say, also when they
// restart.

#include <gmock/gmock.h>

#include <limits>
#include <optional>
#include <thread>

#include "bridges/dds/fast_node.h"
#include "bridges/dds/own_domain.h"
#include "bridges/dds/ros_messages.h"
#include "bridges/dds/started_bridge.h"
#include "insonify/geometry.h"
#include "support/working_folder.h"

namespace insonify {
namespace {

using testing::HasSubstr;

constexpr const char* kPoseType = "geometry_msgs::msg::dds_::PoseStamped_";
constexpr const char* kOdometryType = "nav_msgs::msg::dds_::Odometry_";
constexpr const char* kTransformsType = "tf2_msgs::msg::dds_::TFMessage_";

// tf2_msgs/msg/TFMessage with one transform.
Bytes transform(const std::string& parent, const std::string& child, const Pose& pose) {
  RosWriter cdr;
  cdr.put_length(1);
  put_time(cdr, 5.5);
  cdr.put(std::string_view(parent));
  cdr.put(std::string_view(child));
  const Eigen::Quaterniond& q = pose.orientation;
  for (const double value : {pose.position.x(), pose.position.y(), pose.position.z(), q.x(), q.y(), q.z(), q.w()}) {
    cdr.put(value);
  }
  return cdr.take();
}

// What is read of geometry_msgs/msg/PoseStamped.
struct Stamped {
  std::string frame;
  Vec3 position;
};
Stamped stamped(const Bytes& message) {
  CdrReader cdr(message);
  (void)cdr.get<std::int32_t>();
  (void)cdr.get<std::uint32_t>();
  Stamped pose{cdr.text(), {}};
  for (double& value : pose.position) {
    value = cdr.get<double>();
  }
  return pose;
}

class DdsInputsTest : public testing::Test {
 protected:
  DdsInputsTest() {
    folder_.write("dive.yaml", R"(world: none
points: [{position: [3, 0.2, 0], target_strength_db: -10}]
sonars:
  - {name: fls, position: [1, 0, 0], beam_count: 12, bin_count: 30, max_range: 6, ping_period: 0.05,
     sampling: {columns_per_beam: 1, rows: 4}}
)");
  }

  // Writes a message until a pose comes that is at a place.
  bool reaches(FastWriter& writer, const Bytes& message, const FastReader& poses, const Vec3& place) {
    for (int i = 0; i < 600; ++i) {
      writer.write(message);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      const std::vector<Bytes> messages = poses.messages();
      if (!messages.empty() && (stamped(messages.back()).position - place).norm() < 1e-9) {
        return true;
      }
    }
    return false;
  }

  WorkingFolder folder_;
  OwnDomain domain_;
  FastNode node_{domain_.number()};
};

TEST_F(DdsInputsTest, TheVehicleIsWhereTfHasItsFrameInTheWorlds) {
  StartedBridge bridge(domain_.number(), {"--tf", "base_link", "--world-frame", "map"});
  const auto poses = node_.reader("rt/fls/pose", kPoseType);
  const auto tf_static = node_.writer("rt/tf_static", kTransformsType, {.transient_local = true});
  const auto tf = node_.writer("rt/tf", kTransformsType);
  tf_static->write(transform("map", "odom", {Vec3(10, 0, 0.5), Eigen::Quaterniond::Identity()}));
  ASSERT_TRUE(tf->wait_for_reader());
  // 10 + 1 and 2, and the sonar 1 m ahead of the vehicle, which looks along y.
  EXPECT_TRUE(reaches(
      *tf, transform("odom", "base_link", {Vec3(1, 2, 0), orientation_from_rpy(0, 0, radians_from_degrees(90))}),
      *poses, Vec3(11, 3, 0.5)));
  EXPECT_EQ(stamped(poses->messages().back()).frame, "map");
}

TEST_F(DdsInputsTest, AVehicleThatComesLateAndStartsAnewIsFollowed) {
  StartedBridge bridge(domain_.number(), {"--odometry", "/auv/odom", "--world-frame", "odom"});
  const auto poses = node_.reader("rt/fls/pose", kPoseType);
  EXPECT_TRUE(StartedBridge::wait_for("insonify: /auv/odom: nobody writes nav_msgs/msg/Odometry to it\n"));
  for (const double x : {2.0, 7.0}) {
    FastNode vehicle(domain_.number());
    const auto writer = vehicle.writer("rt/auv/odom", kOdometryType);
    EXPECT_TRUE(reaches(*writer, odometry(3, x, 0.25), *poses, Vec3(x + 1, 0.25, 0)));
    EXPECT_TRUE(StartedBridge::wait_for("insonify: /auv/odom: is written now\n"));
    if (x == 2) {
      bridge.send(SIGUSR1);
      EXPECT_TRUE(StartedBridge::wait_for(" ms from transmission to message"));
    }
  }
  EXPECT_TRUE(StartedBridge::wait_for("insonify: /auv/odom: nobody writes nav_msgs/msg/Odometry to it any more\n"));
  EXPECT_THAT(StartedBridge::said(),
              HasSubstr("insonify: /auv/odom: poses are in the frame world, which messages call odom; --world-frame "
                        "world would agree\n"));
  double seconds = 0;
  EXPECT_EQ(bridge.end(&seconds), 0);
  EXPECT_LT(seconds, kPrompt);
}

TEST_F(DdsInputsTest, APoseThatIsNoneIsToldOnceAndTheOneBeforeHolds) {
  StartedBridge bridge(domain_.number(), {"--odometry", "/auv/odom"});
  const auto poses = node_.reader("rt/fls/pose", kPoseType);
  const auto writer = node_.writer("rt/auv/odom", kOdometryType);
  ASSERT_TRUE(reaches(*writer, odometry(3, 2, 0.25), *poses, Vec3(3, 0.25, 0)));
  const double nowhere = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 3; ++i) {
    writer->write(odometry(3, nowhere, 0.25));
  }
  const std::string refusal =
      "insonify: /auv/odom: world_from_vehicle.position[0] = nan m must be from -10000000 to 10000000 m\n";
  EXPECT_TRUE(StartedBridge::wait_for(refusal));
  const std::size_t before = poses->messages().size();
  EXPECT_TRUE(poses->wait_for(before + 3));
  EXPECT_LT((stamped(poses->messages().back()).position - Vec3(3, 0.25, 0)).norm(), 1e-9);
  const std::string said = StartedBridge::said();
  EXPECT_EQ(said.find("world_from_vehicle"), said.rfind("world_from_vehicle")) << said;
}

}  // namespace
}  // namespace insonify
