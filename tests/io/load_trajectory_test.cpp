// load_trajectory_test.cpp -- waypoints from CSV and TUM files, and errors about invalid files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/files.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::load_trajectory_test {
namespace {

class LoadTrajectoryTest : public testing::Test {
 protected:
  std::vector<Waypoint> load(const std::string& text, const std::string& name = "t.csv",
                             const TrajectoryColumns& columns = {}) const {
    folder.write(name, text);
    said.clear();
    return load_trajectory(name, columns, [this](Severity, const std::string& line) { said.push_back(line); })
        .waypoints;
  }
  std::string fault(const std::string& text, const std::string& name = "t.csv") const {
    return message_of([&] { (void)load(text, name); });
  }

  WorkingFolder folder;
  mutable std::vector<std::string> said;
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
  EXPECT_EQ(fault("0 1 2\n", "t.dat"),
            "t.dat: is not a trajectory: CSV ends in .csv, TUM in .tum or .txt, KITTI in .txt or .kitti");
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
  EXPECT_EQ(fault("time,x,y,x\n"), "t.csv:1:10: x is given twice");
  EXPECT_EQ(fault("time,x,y,z,qw\n"),
            "t.csv:1:1: the columns are time, x, y, z, qw; they must be time, x, y, z and, for the orientation, either "
            "qw, qx, qy, qz or roll, pitch, yaw [rad] or roll_deg, pitch_deg, yaw_deg");
}

// ---------------------------------------------------------------- Logs as they are

using testing::ElementsAre;
using testing::IsEmpty;

TEST_F(LoadTrajectoryTest, RowsWithEqualTimesAreLeftOut) {
  const std::string text =
      "1311868230.00 1 0 0 0 0 0 1\n1311868230.01 2 0 0 0 0 0 1\n1311868230.01 3 0 0 0 0 0 1\n"
      "1311868230.02 4 0 0 0 0 0 1\n";
  const auto waypoints = load(text, "t.tum");
  ASSERT_EQ(waypoints.size(), 3U);
  EXPECT_EQ(waypoints[1].position.x(), 2);
  EXPECT_THAT(said, ElementsAre("t.tum: 1 row left out, with the time of the one before"));
  EXPECT_EQ(fault(text + "1311868230.01 5 0 0 0 0 0 1\n", "t.tum"),
            "t.tum:5:1: time = 1311868230.01 s must be greater than the one before it, 1311868230.02 s");
}

// EuRoC's ground truth: nanoseconds, scalar first, then velocities and biases.
TEST_F(LoadTrajectoryTest, TakesEuRoC) {
  const std::string row = "1403636580838555648,4.5,-1.5,0.75,0.70711,0,0,0.70711,0.1,0.2,0.3\n";
  for (const std::string header :
       {"#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
        "v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1]\n",
        ""}) {
    const auto waypoints = load(header + row);
    ASSERT_EQ(waypoints.size(), 1U);
    EXPECT_NEAR(waypoints[0].time, 1403636580.838555648, 1e-6);
    EXPECT_EQ(waypoints[0].position, Vec3(4.5, -1.5, 0.75));
    EXPECT_NEAR(waypoints[0].orientation.z(), std::numbers::pi / 2, 1e-9);
    EXPECT_THAT(said, ElementsAre(header.empty() ? "t.csv: columns that are not read: column 9, column 10, column 11"
                                                 : "t.csv: columns that are not read: v_rs_r_x, v_rs_r_y, v_rs_r_z"));
  }
}

TEST_F(LoadTrajectoryTest, TakesSemicolonsAndOtherColumns) {
  const auto german = load("time;x;y;z\n0,5;1,25;2;-3\n");
  EXPECT_EQ(german.at(0).time, 0.5);
  EXPECT_EQ(german.at(0).position, Vec3(1.25, 2, -3));
  EXPECT_THAT(said, IsEmpty());

  EXPECT_EQ(load("time,x,y,z,jaw,depth\n0,1,2,3,4,5\n").at(0).position, Vec3(1, 2, 3));
  EXPECT_THAT(said, ElementsAre("t.csv: columns that are not read: jaw (did you mean yaw?), depth"));
  EXPECT_EQ(load("0 1 2 3 0 0 0 1 99\n", "t.tum").at(0).position, Vec3(1, 2, 3));
  EXPECT_THAT(said, ElementsAre("t.tum: columns that are not read: column 9"));
  EXPECT_EQ(load("# timestamp tx ty tz qx qy qz qw\n0 1 2 3 0 0 0 1\n", "t.tum").at(0).position, Vec3(1, 2, 3));
  EXPECT_EQ(load("secs\tposition.x\tposition.y\tposition.z\theading [deg]\troll\tpitch\n0\t1\t2\t3\t90\t0\t0\n",
                 "t.txt", {{"roll_deg", {"roll", "deg"}}, {"pitch_deg", {"pitch", "deg"}}})
                .at(0)
                .orientation.z(),
            radians_from_degrees(90));
}

TEST_F(LoadTrajectoryTest, TakesKitti) {
  const std::string rows = "1 0 0 5 0 1 0 6 0 0 1 7\n0 -1 0 5 1 0 0 6 0 0 1 8\n";
  const auto waypoints = load(rows, "poses.txt");
  ASSERT_EQ(waypoints.size(), 2U);
  EXPECT_EQ(waypoints[1].time, 0.1);
  EXPECT_EQ(waypoints[1].position, Vec3(5, 6, 8));
  EXPECT_NEAR(waypoints[1].orientation.z(), std::numbers::pi / 2, 1e-12);
  EXPECT_THAT(said,
              ElementsAre("poses.txt: matrices of KITTI, without a times.txt beside it: they are taken 0.1 s apart"));

  folder.write("times.txt", "0.000000e+00\n1.037875e-01\n");
  EXPECT_EQ(load(rows, "poses.txt").at(1).time, 0.1037875);
  EXPECT_THAT(said, IsEmpty());
  EXPECT_EQ(fault(rows + rows, "poses.txt"), "poses.txt:3:1: times.txt has 2 times, fewer than there are matrices");
  EXPECT_EQ(fault("2 0 0 5 0 1 0 6 0 0 1 7\n", "poses.txt"),
            "poses.txt:1:1: the matrix does not turn: its rows must be orthogonal, of norm 1");
}

TEST_F(LoadTrajectoryTest, AnglesLikelyInDegreesAreTold) {
  (void)load("time,x,y,z,roll,pitch,yaw\n0,0,0,0,0,0,80\n");
  EXPECT_THAT(said,
              ElementsAre("t.csv: has an angle of 80 rad; in degrees the columns are roll_deg, pitch_deg, yaw_deg"));
}

TEST_F(LoadTrajectoryTest, ColumnsHaveNamesUnitsAndSigns) {
  const TrajectoryColumns columns = {
      {"time", {"clock", "ms"}}, {"x", {"north"}}, {"y", {"east", "", -1}}, {"z", {"depth", "cm", -1}}};
  const auto waypoints = load("clock,north,east,depth,z\n1500,1,2,300,9\n", "t.csv", columns);
  EXPECT_EQ(waypoints.at(0).time, 1.5);
  EXPECT_EQ(waypoints.at(0).position, Vec3(1, -2, -3));
  EXPECT_THAT(said, ElementsAre("t.csv: columns that are not read: z"));

  const auto error = [&](const TrajectoryColumns& wrong, const std::string& name = "t.csv") {
    return message_of(
        [&] { (void)load(name == "t.csv" ? "time,x,y,z\n0,1,2,3\n" : "0 1 2 3 0 0 0 1\n", name, wrong); });
  };
  EXPECT_EQ(error({{"z", {"depth"}}}), "t.csv:1:1: there is no column \"depth\" for z; there are time, x, y, z");
  EXPECT_EQ(error({{"z", {"z", "fathoms"}}}),
            "t.csv:1:1: \"fathoms\" is not a unit of z; there are s, ms, us, ns, m, cm, mm, km, ft, rad, deg");
  EXPECT_EQ(error({{"depth", {"z"}}}),
            "t.csv:1:1: \"depth\" is not a number of a waypoint; there are time, x, y, z, qw, qx, qy, qz, roll, "
            "pitch, yaw, roll_deg, pitch_deg, yaw_deg");
  EXPECT_EQ(error({{"z", {"z"}}}, "t.tum"), "t.tum:1:1: `columns` needs a header that names the columns of the file");
}

}  // namespace
}  // namespace insonify::load_trajectory_test
