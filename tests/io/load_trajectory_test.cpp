// load_trajectory_test.cpp -- waypoints from CSV and TUM files, and errors about invalid files.

#include <gtest/gtest.h>

#include "insonify/files.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::load_trajectory_test {
namespace {

class LoadTrajectoryTest : public testing::Test {
 protected:
  std::vector<Waypoint> load(const std::string& text, const std::string& name = "t.csv") const {
    folder.write(name, text);
    return load_trajectory(name).waypoints;
  }
  std::string fault(const std::string& text, const std::string& name = "t.csv") const {
    return message_of([&] { (void)load(text, name); });
  }

  WorkingFolder folder;
};

const std::string kHeader = "time,x,y,z,qw,qx,qy,qz\n";

TEST_F(LoadTrajectoryTest, CsvHasTheColumnsOfItsHeaderInAnyOrder) {
  const auto waypoints = load(
      "# a log\r\nx, time, y, z, yaw_deg, roll_deg, pitch_deg\r\n1, 0.5, 2, -3, 90, 10, 20\r\n\r\n"
      "+4,1e1,.5,6,0,0,0");
  ASSERT_EQ(waypoints.size(), 2U);
  EXPECT_EQ(waypoints[0].time, 0.5);
  EXPECT_EQ(waypoints[0].position, Vec3(1, 2, -3));
  EXPECT_EQ(waypoints[0].orientation,
            Vec3(radians_from_degrees(10), radians_from_degrees(20), radians_from_degrees(90)));
  EXPECT_EQ(waypoints[1].time, 10);
  EXPECT_EQ(waypoints[1].position, Vec3(4, 0.5, 6));
}

TEST_F(LoadTrajectoryTest, AnglesWithoutADegreeAreRadians) {
  EXPECT_EQ(load("time,x,y,z,roll,pitch,yaw\n0,0,0,0,0.1,-0.2,3\n")[0].orientation, Vec3(0.1, -0.2, 3));
}

TEST_F(LoadTrajectoryTest, WithoutAnglesItIsLevelAndLooksAlongX) {
  EXPECT_EQ(load("time,x,y,z\n0,1,2,3\n")[0].orientation, Vec3(0, 0, 0));
}

// A quarter turn to port: cosine and sine of half of it are 0.70711. TUM has the scalar last.
TEST_F(LoadTrajectoryTest, CsvAndTumAgreeOnQuaternions) {
  const Vec3 csv = load(kHeader + "0,0,0,0,0.70711,0,0,0.70711\n")[0].orientation;
  const Vec3 tum = load("# time x y z qx qy qz qw\n0 0 0 0  0 0\t0.70711 0.70711\n", "t.tum")[0].orientation;
  EXPECT_NEAR(csv.z(), std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(csv, tum);
  EXPECT_EQ(load("0 1 2 3 0 0 0 1\n", "t.txt")[0].position, Vec3(1, 2, 3));
}

TEST_F(LoadTrajectoryTest, SaysWhereAndWhatIsWrong) {
  EXPECT_EQ(fault(kHeader), "t.csv: holds no waypoints");
  EXPECT_EQ(fault(""), "t.csv: the file is empty");
  EXPECT_EQ(message_of([] { (void)load_trajectory("gone.csv"); }), "gone.csv: no such file");
  EXPECT_EQ(fault("0 1 2\n", "t.dat"), "t.dat: is not a trajectory: CSV ends in .csv, TUM in .tum or .txt");
  EXPECT_EQ(fault(kHeader + "0,0,0,abc,1,0,0,0\n"), "t.csv:2:7: z = \"abc\" must be a number");
  EXPECT_EQ(fault(kHeader + "0,0,0,nan,1,0,0,0\n"), "t.csv:2:7: z = \"nan\" must be a number");
  EXPECT_EQ(fault(kHeader + "0,0,,0,1,0,0,0\n"), "t.csv:2:5: y = \"\" must be a number");
  EXPECT_EQ(fault(kHeader + "0,0,0\n"), "t.csv:2:1: has 3 values, must have 8: time, x, y, z, qw, qx, qy, qz");
  EXPECT_EQ(fault("0 0 0 0 0 0 1\n", "t.tum"), "t.tum:1:1: has 7 values, must have 8: time, x, y, z, qx, qy, qz, qw");
  EXPECT_EQ(fault(kHeader + "2,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n"),
            "t.csv:3:1: time = 1 s must be greater than the one before it, 2 s");
  EXPECT_EQ(fault(kHeader + "0,0,0,0,1,0,0,1\n"), "t.csv:2:1: the norm of qw, qx, qy, qz is 1.414, must be 1");
  EXPECT_EQ(fault("time,x,y,z\n0,2e7,0,0\n"),
            "t.csv:2:1: position[0] = 20000000 m must be from -10000000 to 10000000 m");
}

TEST_F(LoadTrajectoryTest, SaysWhatIsWrongWithAHeader) {
  EXPECT_EQ(
      fault("time,x,y,z,jaw\n"),
      "t.csv:1:12: \"jaw\" is not a column of a trajectory; did you mean yaw? There are time, x, y, z, qw, qx, qy, "
      "qz, roll, pitch, yaw, roll_deg, pitch_deg, yaw_deg");
  EXPECT_EQ(fault("time,x,y,x\n"), "t.csv:1:10: x is given twice");
  EXPECT_EQ(fault("time,x,y,z,qw\n"),
            "t.csv:1:1: the columns are time, x, y, z, qw; they must be time, x, y, z and, for the orientation, either "
            "qw, qx, qy, qz or roll, pitch, yaw [rad] or roll_deg, pitch_deg, yaw_deg");
}

}  // namespace
}  // namespace insonify::load_trajectory_test
