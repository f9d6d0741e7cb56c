// water_profile_test.cpp -- the key water.profile: a list of points or a file, and what is wrong with either.

#include <gtest/gtest.h>

#include "insonify/files.h"
#include "support/message_of.h"
#include "support/working_folder.h"

namespace insonify::water_profile_test {
namespace {

class WaterProfileTest : public testing::Test {
 protected:
  Water load(const std::string& water) const {
    folder.write("s.yaml", "world: none\nsonars: [{name: fls}]\nwater: " + water + "\n");
    return load_scenario("s.yaml").water;
  }
  std::string fault(const std::string& water) const {
    return message_of([&] { (void)load(water); });
  }

  WorkingFolder folder;
};

TEST_F(WaterProfileTest, IsAListOfPoints) {
  const Water water =
      load("{depth: 5, profile: [{depth: 0, sound_speed: 1510}, {depth: 20, temperature_c: 8, salinity: 34}]}");
  ASSERT_EQ(water.profile.size(), 2U);
  EXPECT_EQ(water.profile[0].sound_speed, 1510);
  EXPECT_EQ(water.profile[1].temperature_c, 8);
  EXPECT_EQ(water.true_sound_speed(), SoundSpeedProfile(water.profile).speed_at(5));
}

TEST_F(WaterProfileTest, OrAFileBesideTheScenario) {
  folder.write("cast.svp", "0 1510\n20 1480\n");
  for (const std::string form : {"{profile: cast.svp}", "{profile: {file: cast.svp}}"}) {
    const Water water = load(form);
    ASSERT_EQ(water.profile.size(), 2U);
    EXPECT_EQ(water.profile[1].depth, 20);
    EXPECT_EQ(water.profile[1].sound_speed, 1480);
  }
}

TEST_F(WaterProfileTest, IsWrittenAsItIsRead) {
  folder.write("s.yaml",
               "world: none\nsonars: [{name: fls}]\nwater: {profile: [{depth: 1.5, sound_speed: 1510}, {depth: 3, "
               "temperature_c: 8, salinity: 34}]}\n");
  const Scenario read = load_scenario("s.yaml"), again = parse_scenario(to_yaml(read));
  ASSERT_EQ(again.water.profile.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again.water.profile[i].depth, read.water.profile[i].depth);
    EXPECT_EQ(again.water.profile[i].sound_speed, read.water.profile[i].sound_speed);
    EXPECT_EQ(again.water.profile[i].temperature_c, read.water.profile[i].temperature_c);
    EXPECT_EQ(again.water.profile[i].salinity, read.water.profile[i].salinity);
  }
}

TEST_F(WaterProfileTest, SaysWhereAndWhatIsWrong) {
  folder.write("cast.csv", "depth,speed\n0,1510\n20,1780\n");
  EXPECT_EQ(fault("{profile: cast.csv}"), "cast.csv:3:1: sound_speed = 1780 m/s must be from 1300 to 1700 m/s");
  EXPECT_EQ(fault("{profile: gone.csv}"), "s.yaml:3:9: gone.csv: no such file");
  EXPECT_EQ(fault("{profile: [{depth: 3, sound_speed: 1500}, {depth: 2, sound_speed: 1500}]}"),
            "s.yaml:3:51: water.profile[1].depth = 2 m must be greater than water.profile[0].depth = 3 m");
  EXPECT_EQ(fault("{profile: [{depth: 3}]}"),
            "s.yaml:3:19: water.profile[0] must have a sound_speed, or temperature_c and salinity");
  EXPECT_EQ(fault("{profile: [{depth: 3, speed: 1500}]}"), "s.yaml:3:30: water.profile[0].speed is not a known key");
  EXPECT_EQ(fault("{profile: 7}"),
            "s.yaml:3:9: 7: is not a sound-speed profile: CSV ends in .csv, CARIS in .svp, Kongsberg in .asvp");
}

}  // namespace
}  // namespace insonify::water_profile_test
