// load_sound_speed_profile_test.cpp -- profiles from CSV, CARIS and Kongsberg files, and errors about invalid ones.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/acoustics/sound_speed.h"
#include "insonify/sound_speed_files.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::load_sound_speed_profile_test {
namespace {

class LoadSoundSpeedProfileTest : public testing::Test {
 protected:
  std::vector<ProfilePoint> load(const std::string& text, const std::string& name = "cast.csv") {
    folder.write(name, text);
    said.clear();
    return load_sound_speed_profile(name, [this](Severity, const std::string& line) { said.push_back(line); });
  }
  std::string fault(const std::string& text, const std::string& name = "cast.csv") {
    return message_of([&] { (void)load(text, name); });
  }

  WorkingFolder folder;
  std::vector<std::string> said;
};

TEST_F(LoadSoundSpeedProfileTest, CsvHasTheColumnsOfItsHeader) {
  const auto points = load("# station 7\r\nSpeed (m/s), Depth [m]\r\n1500.5, 0\r\n\r\n1490, 12.5\r\n");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].depth, 0);
  EXPECT_EQ(points[0].speed(), 1500.5);
  EXPECT_EQ(points[1].depth, 12.5);
  EXPECT_EQ(points[1].speed(), 1490);
}

TEST_F(LoadSoundSpeedProfileTest, SpeedFollowsFromTemperatureAndSalinity) {
  const auto points = load("depth;temp;sal;oxygen\n0;18,5;35;7\n20;9,25;34,5;6\n");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1].speed(), chen_millero_sound_speed(9.25, 34.5, 20));
  EXPECT_THAT(said, testing::ElementsAre("cast.csv: columns that are not read: oxygen"));
}

TEST_F(LoadSoundSpeedProfileTest, ReadsCaris) {
  const auto points = load(
      "[SVP_VERSION_2]\nharbour.svp\nSection 2015-148 23:49:31 -12:14:35.00 130:55:40.00\n0.201690 1539.508000\n"
      "0.399446 1539.485000\n",
      "cast.svp");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1].depth, 0.399446);
  EXPECT_EQ(points[1].speed(), 1539.485);
}

TEST_F(LoadSoundSpeedProfileTest, ReadsTwoColumns) {
  const auto points = load("# depth speed\n0.5\t1500\n4\t1499.5\n", "cast.svp");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[1].speed(), 1499.5);
}

const std::string kKongsberg = "( SoundVelocity  1.0 0 201505282349 -12.24305556 130.92777780 -1 0 0 SSM P 0003 )\n";

TEST_F(LoadSoundSpeedProfileTest, ReadsKongsberg) {
  const auto points = load(kKongsberg + "0.00 1539.51\n0.20 1539.51 24 35\n12000.00 1630\n", "cast.asvp");
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[2].depth, 12000);
  EXPECT_EQ(points[1].speed(), 1539.51);
}

TEST_F(LoadSoundSpeedProfileTest, SaysWhereAndWhatIsWrong) {
  EXPECT_EQ(fault("depth,speed\n0,1500\n5,1490\n5,1480\n"),
            "cast.csv:4:1: depth = 5 m must be greater than the one before it, 5 m");
  EXPECT_EQ(fault("depth,speed\n0,1500\n9,1490\n5,1480\n"),
            "cast.csv:4:1: depth = 5 m must be greater than the one before it, 9 m");
  EXPECT_EQ(fault("depth,speed\n0,nan\n"), "cast.csv:2:3: sound_speed = \"nan\" must be a number");
  EXPECT_EQ(fault("depth,speed\n0,1299\n"), "cast.csv:2:1: sound_speed = 1299 m/s must be from 1300 to 1700 m/s");
  EXPECT_EQ(fault("depth,speed\n-3,1500\n"), "cast.csv:2:1: depth = -3 m must be from 0 to 12000 m");
  EXPECT_EQ(fault("depth,temperature,salinity\n0,45,35\n"),
            "cast.csv:2:1: temperature_c = 45 degC must be from -3 to 40 degC");
  EXPECT_EQ(fault("depth,speed\n0,1500\n0.1,1511\n"),
            "cast.csv:3:1: sound speed changes by 110 m/s in each metre from the row before; must be at most 100 m/s");
  EXPECT_EQ(fault("depth,speed\n"), "cast.csv: holds no points of a sound-speed profile");
  EXPECT_EQ(fault(""), "cast.csv: the file is empty");
  EXPECT_EQ(fault("0,1500\n"),
            "cast.csv:1:1: the columns are 0, 1500; they must be depth and speed, or depth, temperature and salinity");
  EXPECT_EQ(fault("depth,speed,depth\n"), "cast.csv:1:13: depth is given twice");
  EXPECT_EQ(fault("depth [ft],speed\n"), "cast.csv:1:1: depth in \"ft\" must be in m");
  EXPECT_EQ(fault("0 1500\n", "cast.dat"),
            "cast.dat: is not a sound-speed profile: CSV ends in .csv, CARIS in .svp, Kongsberg in .asvp");
  EXPECT_EQ(fault("[SVP_VERSION_1]\n", "cast.svp"), "cast.svp:1:1: \"[SVP_VERSION_1]\" must be [SVP_VERSION_2]");
  EXPECT_EQ(fault("[SVP_VERSION_2]\nx\nSection a\n0 1500\nSection b\n1 1500\n", "cast.svp"),
            "cast.svp:5:1: a second section begins here; a profile has one: give each cast a file of its own");
}

// What is left of a file that was cut: a row without its end, or fewer rows than were announced.
TEST_F(LoadSoundSpeedProfileTest, SaysThatAFileIsNotWhole) {
  EXPECT_EQ(fault("depth,speed\n0,1500\n10"), "cast.csv:3:1: has 1 value, must have 2");
  EXPECT_EQ(fault("depth,speed\n0,1500\n10,14"), "cast.csv:3:1: sound_speed = 14 m/s must be from 1300 to 1700 m/s");
  EXPECT_EQ(fault("[SVP_VERSION_2]\nx\n", "cast.svp"), "cast.svp: holds no points of a sound-speed profile");
  EXPECT_EQ(fault(kKongsberg + "0.00 1539.51\n0.20 1539.51\n", "cast.asvp"),
            "cast.asvp:3:1: has 2 of the 3 points that its first line says: the file is not whole");
  EXPECT_EQ(fault(kKongsberg.substr(0, 40), "cast.asvp"), "cast.asvp:1:37: must end with )");
}

}  // namespace
}  // namespace insonify::load_sound_speed_profile_test
