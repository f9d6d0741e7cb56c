// message_parts_test.cpp -- what ROS messages are made of: CDR, definitions of types, names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/message/message_channels.h"
#include "io/message/ros_name.h"
#include "io/message/ros_writer.h"

namespace insonify::message_parts_test {
namespace {

using testing::ElementsAre;

std::vector<int> plain(const std::vector<std::byte>& bytes) {
  std::vector<int> numbers;
  for (const std::byte byte : bytes) {
    numbers.push_back(std::to_integer<int>(byte));
  }
  return numbers;
}

TEST(RosWriterTest, AlignsNumbersFromTheEndOfItsHeader) {
  RosWriter out;
  out.put(std::string_view("ab"));  // Length 3 with its zero: ends at 7.
  out.put(std::uint16_t{0x0201});   // At 8.
  out.put(1.0);                     // At 16.
  out.put(true);
  EXPECT_THAT(plain(out.take()), ElementsAre(0, 1, 0, 0, 3, 0, 0, 0, 'a', 'b', 0, 0, 1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
                                             0, 0, 0xf0, 0x3f, 1));
}

TEST(RosWriterTest, AlignsNoElementsOfAnEmptySequence) {
  RosWriter out;
  out.put(std::span<const double>());
  out.put(std::uint8_t{9});
  EXPECT_THAT(plain(out.take()), ElementsAre(0, 1, 0, 0, 0, 0, 0, 0, 9));
}

TEST(MessageDefinitionTest, ListsEachTypeOnceAfterThoseThatUseIt) {
  const std::string line(80, '=');
  EXPECT_EQ(message_definition("geometry_msgs/PoseStamped", MessageForm::kRos2),
            "std_msgs/Header header\ngeometry_msgs/Pose pose\n" + line +
                "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + line +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + line +
                "\nMSG: geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n" +
                line + "\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" + line +
                "\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n");
}

// As `rosmsg md5` of the release Noetic prints them.
TEST(MessageDefinitionTest, ChecksumsAreThoseOfRos1) {
  EXPECT_EQ(ros1_checksum("sensor_msgs/LaserScan"), "90c7ef2dc6895d81024acba2ac42f369");
  EXPECT_EQ(ros1_checksum("sensor_msgs/Image"), "060021388200f6f0f447d0fcd9c64743");
}

TEST(RosNameTest, HasOnlyWhatTopicsAllow) {
  EXPECT_EQ(ros_name("fls"), "fls");
  EXPECT_EQ(ros_name("front left-2"), "front_left_2");
  EXPECT_EQ(ros_name("720i"), "_720i");
  EXPECT_EQ(ros_name("ä"), "_");
  EXPECT_EQ(ros_name("büg 深"), "b_g__");
  EXPECT_EQ(ros_name("\xff\xc3"), "__");
  EXPECT_EQ(ros_name(""), "sonar");
}

TEST(RosNameTest, KeepsNamesApart) {
  EXPECT_THAT(ros_names({"bow", "stern"}), ElementsAre("bow", "stern"));
  EXPECT_THAT(ros_names({"ä", "ö", "_", "ü"}), ElementsAre("__2", "__3", "_", "__4"));
  EXPECT_THAT(ros_names({"a b", "a_b_2", "a-b"}), ElementsAre("a_b", "a_b_2", "a_b_3"));
}

}  // namespace
}  // namespace insonify::message_parts_test
