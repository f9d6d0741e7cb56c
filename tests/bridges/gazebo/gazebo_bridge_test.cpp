// gazebo_bridge_test.cpp -- the bridge, beside a process that plays Gazebo and a reader of its topics.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <ignition/msgs/pointcloud_packed.pb.h>
#include <ignition/msgs/stringmsg.pb.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "bridges/gazebo/gazebo_reader.h"
#include "bridges/gazebo/processes.h"
#include "insonify/geometry.h"
#include "insonify/recorded_pings.h"
#include "support/working_folder.h"

namespace insonify {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kPeriod = 0.0625;  // A power of two: times of poses are exact [s].
constexpr double kBin = 12.0 / 90;  // [m]
constexpr const char* kSaid = "said.txt";

constexpr const char* kSonar = R"(
  - {name: fls, beam_count: 24, bin_count: 90, azimuth_aperture_deg: 70, elevation_aperture_deg: 25, max_range: 12,
     ping_period: 0.0625, position: [0.25, 0, 0], sampling: {columns_per_beam: 2, rows: 40}}
)";

// Between the values of an image, in steps of their 16 bits, and those that intensities have by
// docs/reference/messages.md.
double largest_difference(const GazeboSonarImage& image, const std::vector<double>& intensities) {
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

// Every test has a partition of its own, so that tests do not hear each other.
class GazeboBridgeTest : public testing::TestWithParam<std::string> {
 protected:
  GazeboBridgeTest() {
    const std::string partition = "insonify-" + std::to_string(getpid());
    setenv("IGN_PARTITION", partition.c_str(), 1);
    setenv("IGN_IP", "127.0.0.1", 1);
    folder_.write("dive.yaml", std::string("world: none\nsonars:") + kSonar);
  }

  Program bridge(std::vector<std::string> words = {"dive.yaml", "--vehicle", "rov::link"}) {
    words.insert(words.begin(), INSONIFY_BRIDGE_GAZEBO);
    words.insert(words.end(), {"--bits", "16", "--at-once"});
    return Program(std::move(words), kSaid);
  }

  // A wall whose near side is at x = 8, and a vehicle at the origin.
  static std::unique_ptr<Player> tank(const std::string& generation, double wall = 8.5) {
    auto player = std::make_unique<Player>("tank", generation);
    player->send("add 10 wall " + std::to_string(wall) + " 0 0 0 static box 1 20 20");
    player->send("add 20 rov 0 0 0 0 free box 0.4 0.4 0.4");
    return player;
  }

  // Tells poses until there is a message more; the last of them.
  static GazeboSonarImage next(Player& player, GazeboReader& reader, double time) {
    const std::size_t before = reader.count();
    for (int attempt = 0; attempt < 120 && reader.count() == before; ++attempt) {  // The same again changes nothing.
      player.send("poses " + std::to_string(time));
      (void)reader.wait_for(before + 1, 0.5);
    }
    EXPECT_GT(reader.count(), before) << "no ping at " << time << "; " << contents(kSaid);
    return GazeboSonarImage(reader.messages().back());
  }

  WorkingFolder folder_;
};

class BothGenerations : public GazeboBridgeTest {};
INSTANTIATE_TEST_SUITE_P(Of, BothGenerations, testing::Values("ignition", "gz"));

TEST_P(BothGenerations, PingsAreMadeWhereGazeboHasTheVehicle) {
  Program bridge = this->bridge();
  GazeboReader ignition("/fls/sonar_image", "ignition.msgs.Image"), gz("/fls/sonar_image", "gz.msgs.Image");
  const auto player = tank(GetParam());
  player->send("followed");
  for (int i = 0; i < 5; ++i) {
    const double x = 0.5 * i, time = 3 + kPeriod * i;
    player->send("move 20 " + std::to_string(x) + " 0 0 0");
    const GazeboSonarImage image = next(*player, ignition, time);
    EXPECT_NEAR(image.first_echo(), 8 - 0.25 - x, kBin) << i;
    EXPECT_NEAR(image.time, time, 1e-9);
    EXPECT_EQ(image.number, static_cast<unsigned long>(i));
    EXPECT_EQ(image.image.width(), 24U);
    EXPECT_EQ(image.image.height(), 90U);
    EXPECT_EQ(image.image.step(), 48U);
    EXPECT_EQ(image.image.pixel_format_type(), ignition::msgs::L_INT16);
    EXPECT_EQ(image.frame, "fls_beams");
  }
  EXPECT_TRUE(gz.wait_for(5));
  EXPECT_EQ(gz.messages().back(), ignition.messages().back());
  double seconds = 0;
  EXPECT_EQ(bridge.end(SIGINT, &seconds), 0);
  EXPECT_LT(seconds, kPrompt);
  EXPECT_THAT(contents(kSaid),
              AllOf(HasSubstr("following the world tank: 1 visuals, 0 of them in models that move"),
                    HasSubstr("5 pings in"), HasSubstr("from transmission to message"), Not(HasSubstr("dropped"))));
}

// Poses come each 16 ms of wall time, pings as fast as they are made: one at each of its times, none late, none lost.
TEST_P(BothGenerations, InLockStepThereIsAPingAtEachOfItsTimes) {
  constexpr int kPings = 24;
  Program bridge = this->bridge({"dive.yaml", "--vehicle", "rov::link", "--lock-step"});
  GazeboReader reader("/fls/sonar_image", "gz.msgs.Image");
  const auto player = tank(GetParam());
  player->send("followed");
  player->send("live 20 0.0125 0.4");  // Five steps a ping; 25 mm.
  ASSERT_TRUE(reader.wait_for(kPings, 60)) << contents(kSaid);
  const auto messages = reader.messages();
  for (int i = 0; i < kPings; ++i) {
    const GazeboSonarImage image(messages[static_cast<std::size_t>(i)]);
    EXPECT_EQ(image.number, static_cast<unsigned long>(i));
    EXPECT_NEAR(image.time, 1 + kPeriod * i, 1e-6);
    EXPECT_NEAR(image.first_echo(), 8 - 0.25 - 0.4 * kPeriod * i, kBin);
  }
  EXPECT_EQ(bridge.end(SIGINT), 0);
  EXPECT_THAT(contents(kSaid), Not(HasSubstr("dropped")));
}

TEST_P(BothGenerations, SpawnedModelsAreInTheNextPingAndRemovedOnesAreNot) {
  Program bridge = this->bridge();
  GazeboReader reader("/fls/sonar_image", "gz.msgs.Image");
  const auto player = tank(GetParam());
  player->send("followed");
  EXPECT_NEAR(next(*player, reader, 1).first_echo(), 7.75, kBin);
  player->send("add 30 buoy 4 0 0 0 free box 1 1 1");
  EXPECT_NEAR(next(*player, reader, 1 + kPeriod).first_echo(), 3.25, kBin);
  player->send("move 30 5 0 0 0");
  EXPECT_NEAR(next(*player, reader, 1 + 2 * kPeriod).first_echo(), 4.25, kBin);
  player->send("move 32 -1 0 0 0");  // Its visual in the link.
  EXPECT_NEAR(next(*player, reader, 1 + 3 * kPeriod).first_echo(), 3.25, kBin);
  player->send("remove 30");
  const GazeboSonarImage after = next(*player, reader, 1 + 4 * kPeriod);
  EXPECT_NEAR(after.first_echo(), 7.75, kBin);
  EXPECT_EQ(after.number, 4U);  // Numbers go on.
  player->send("add 40 buoy 3 0 0 0 static box 1 1 1");
  EXPECT_NEAR(next(*player, reader, 1 + 5 * kPeriod).first_echo(), 2.25, kBin);
}

TEST_F(GazeboBridgeTest, WhatMessagesDidNotTellIsFoundByThePoses) {
  Program bridge = this->bridge();
  GazeboReader reader("/fls/sonar_image", "gz.msgs.Image");
  const auto player = tank("ignition");
  player->send("followed");
  EXPECT_NEAR(next(*player, reader, 1).first_echo(), 7.75, kBin);
  player->send("add-silently 30 buoy 4 0 0 0 free box 1 1 1");
  player->send("poses 1.01");
  ASSERT_TRUE(says(kSaid, "1 visuals added"));
  EXPECT_NEAR(next(*player, reader, 1 + kPeriod).first_echo(), 3.25, kBin);
  player->send("remove-silently 30");
  player->send("poses 1.1");
  ASSERT_TRUE(says(kSaid, "1 removed"));
  EXPECT_NEAR(next(*player, reader, 1 + 3 * kPeriod).first_echo(), 7.75, kBin);
  // A static model that is put somewhere else all the same: it is made to move, and still again after 10 s there.
  player->send("move 10 6.5 0 0 0");
  EXPECT_NEAR(next(*player, reader, 1 + 4 * kPeriod).first_echo(), 5.75, kBin);
  ASSERT_TRUE(says(kSaid, "1 visuals added, 1 removed"));
  const std::string before = contents(kSaid);
  EXPECT_NEAR(next(*player, reader, 11).first_echo(), 5.75, kBin);
  EXPECT_EQ(contents(kSaid), before);
  EXPECT_NEAR(next(*player, reader, 11 + 5 * kPeriod).first_echo(), 5.75, kBin);
  EXPECT_EQ(contents(kSaid).substr(before.size()), "the world tank: 1 visuals added, 1 removed\n");
}

TEST_F(GazeboBridgeTest, TwoServersOfOneWorldAreTold) {
  Program bridge = this->bridge();
  const auto player = tank("gz");
  player->send("followed");
  const auto other = tank("gz");
  ASSERT_TRUE(says(kSaid, "2 servers have a world tank in the partition insonify-"));
  EXPECT_THAT(contents(kSaid), HasSubstr(": their poses are mixed; give each its own GZ_PARTITION\n"));
}

TEST_F(GazeboBridgeTest, WaitsForGazeboAndSurvivesItsRestart) {
  Program bridge = this->bridge();
  ASSERT_TRUE(says(kSaid, "there is no Gazebo in the partition insonify-"));
  GazeboReader reader("/fls/sonar_image", "gz.msgs.Image");
  auto player = tank("gz");
  player->send("followed");
  EXPECT_NEAR(next(*player, reader, 50).first_echo(), 7.75, kBin);
  player->die();
  player = tank("gz", 6.5);  // The same ids, other places, and time from the start.
  player->send("followed");
  EXPECT_NEAR(next(*player, reader, 0.25).time, 0.25, 1e-9);
  EXPECT_NEAR(next(*player, reader, 0.25 + kPeriod).first_echo(), 5.75, kBin);
}

TEST_F(GazeboBridgeTest, EndsWhenAskedWithoutGazebo) {
  Program bridge = this->bridge();
  ASSERT_TRUE(says(kSaid, "waiting for it"));
  bridge.signal(SIGUSR1);
  EXPECT_TRUE(says(kSaid, "0 pings in"));
  double seconds = 0;
  EXPECT_EQ(bridge.end(SIGINT, &seconds), 0);
  EXPECT_LT(seconds, kPrompt);
  std::size_t lines = 0;
  for (std::size_t at = 0; (at = contents(kSaid).find("waiting for it", at)) != std::string::npos; ++at) {
    ++lines;
  }
  EXPECT_EQ(lines, 1U);
}

// The sonars in a world's SDF file, and what it says of materials; `run` of the file makes the same pings.
TEST_F(GazeboBridgeTest, MessagesAgreeWithTheRecordingOfTheSameWorld) {
  folder_.write("tank.sdf", R"(<sdf version="1.9" xmlns:insonify="https://insonify.org/sdf"><world name="tank">
    <model name="wall"><static>true</static><pose>8.5 0 0 0 0 0</pose><link name="link">
      <visual name="visual"><geometry><box><size>1 20 20</size></box></geometry>
        <insonify:material>steel</insonify:material></visual></link></model>
    <model name="rov"><pose>1 0.5 0 0 0 0.2</pose><link name="link">
      <visual name="visual"><geometry><box><size>0.4 0.4 0.4</size></box></geometry></visual>
      <insonify:sonar name="bow"><pose>0.3 0 0 0 0.1 0</pose><beam_count>24</beam_count><bin_count>90</bin_count>
        <azimuth_aperture_deg>70</azimuth_aperture_deg><elevation_aperture_deg>25</elevation_aperture_deg>
        <max_range>12</max_range><ping_period>0.0625</ping_period>
        <sampling>{columns_per_beam: 2, rows: 40}</sampling></insonify:sonar></link></model>
  </world></sdf>)");
  ASSERT_EQ(std::system(INSONIFY_CLI " run tank.sdf -o out --record h5 --no-pictures --pings 2 > run.txt"), 0);
  const RecordedPings recording("out/bow.h5");
  Program bridge = this->bridge({"tank.sdf"});
  GazeboReader reader("/bow/sonar_image", "gz.msgs.Image");
  const auto player = tank("gz");
  player->send("move 20 1 0.5 0 0.2");
  player->send("followed");
  for (std::uint64_t ping = 0; ping < 2; ++ping) {
    const GazeboSonarImage image = next(*player, reader, kPeriod * static_cast<double>(ping));
    EXPECT_LE(largest_difference(image, recording.intensity(ping)), 1) << "ping " << ping;
    EXPECT_GT(std::ranges::count_if(image.values, [](auto value) { return value > 0 && value < 65535; }),
              20);  // Echoes.
  }
  EXPECT_THAT(contents(kSaid), Not(HasSubstr("is the name of nothing")));  // The carrier, which is left out.
}

// While a sonar listens to 40 m, for 53 ms, this vehicle moves by 0.4 m and turns by two thirds of a beam's width.
// `insonify run` knows its velocity from the trajectory; here it follows from two poses, and the first is none.
TEST_F(GazeboBridgeTest, VelocitiesFollowFromPoses) {
  const std::string common = R"(world: none
motion_in_ping: true
points: [{position: [33, 3, 0], target_strength_db: -10}, {position: [20, -5, 1], target_strength_db: -15}]
sonars:
  - {name: fls, beam_count: 24, bin_count: 800, azimuth_aperture_deg: 70, elevation_aperture_deg: 25, max_range: 40,
     ping_period: 0.125, position: [0.25, 0, 0], receiver: {speckle: false}, sampling: {columns_per_beam: 2, rows: 40}}
trajectory: [{time: 0, position: [3, 1, 0]}, )";
  folder_.write("still.yaml", common + "{time: 1, position: [3, 1, 0]}]\n");
  folder_.write("dive.yaml", common + "{time: 1, position: [10, 4, 0], orientation_deg: [0, 0, 40]}]\n");
  for (const char* name : {"still", "dive"}) {
    const std::string command = INSONIFY_CLI " run " + std::string(name) + ".yaml -o " + name;
    ASSERT_EQ(std::system((command + " --record h5 --no-pictures --pings 2 > run.txt").c_str()), 0);
  }
  const RecordedPings still("still/fls.h5"), moving("dive/fls.h5");
  Program bridge = this->bridge();
  GazeboReader reader("/fls/sonar_image", "gz.msgs.Image");
  Player player("tank", "gz");
  player.send("add 20 rov 3 1 0 0 free box 0.4 0.4 0.4");
  player.send("followed");
  constexpr double kBegin = 0.25, kStep = 0.125;  // Gazebo's time, which begins at 0 as a start does [s].
  const GazeboSonarImage first = next(player, reader, kBegin);
  player.send(fmt::format("move 20 {} {} 0 {}", 3 + 7 * kStep, 1 + 3 * kStep, radians_from_degrees(40 * kStep)));
  const GazeboSonarImage second = next(player, reader, kBegin + kStep);
  EXPECT_LE(largest_difference(first, still.intensity(0)), 1);
  EXPECT_LE(largest_difference(second, moving.intensity(1)), 1);
  EXPECT_GT(largest_difference(second, still.intensity(1)), 1000);
  EXPECT_GT(largest_difference(first, moving.intensity(0)), 1000);  // The velocity alone makes a difference.
}

TEST_F(GazeboBridgeTest, AllKindsOfMessagesAreThere) {
  Program bridge = this->bridge();
  GazeboReader image("/fls/sonar_image", "ignition.msgs.Image"), fan("/fls/fan", "ignition.msgs.Image"),
      points("/fls/points", "gz.msgs.PointCloudPacked"), pose("/fls/pose", "gz.msgs.Pose"),
      transforms("/tf", "ignition.msgs.Pose_V"), scenario("/scenario", "gz.msgs.StringMsg");
  const auto player = tank("ignition");
  player->send("move 20 1 2 3 0");
  player->send("followed");
  (void)next(*player, image, 1);
  (void)next(*player, image, 1 + kPeriod);
  for (GazeboReader* reader : {&fan, &points, &pose, &transforms, &scenario}) {
    ASSERT_TRUE(reader->wait_for(1));
  }
  const GazeboSonarImage picture(fan.messages().back());
  EXPECT_EQ(picture.image.pixel_format_type(), ignition::msgs::RGB_INT8);
  EXPECT_EQ(picture.image.height(), 480U);
  EXPECT_EQ(picture.image.data().size(), std::size_t{3} * picture.image.width() * picture.image.height());
  ignition::msgs::PointCloudPacked cloud;
  ASSERT_TRUE(cloud.ParseFromString(points.messages().back()));
  EXPECT_EQ(cloud.field_size(), 4);
  EXPECT_EQ(cloud.field(3).name(), "intensity");
  EXPECT_EQ(cloud.data().size(), std::size_t{16} * cloud.width());
  EXPECT_EQ(cloud.width(), 22U);  // The strongest hundredth of 24 x 90.
  ignition::msgs::Pose place;
  ASSERT_TRUE(place.ParseFromString(pose.messages().back()));
  EXPECT_NEAR(place.position().x(), 1.25, 1e-9);
  EXPECT_NEAR(place.position().z(), 3, 1e-9);
  ignition::msgs::Pose_V frames;
  ASSERT_TRUE(frames.ParseFromString(transforms.messages().back()));
  ASSERT_EQ(frames.pose_size(), 2);
  EXPECT_EQ(frames.pose(1).name(), "fls_beams");
  ignition::msgs::StringMsg text;
  ASSERT_TRUE(text.ParseFromString(scenario.messages().back()));
  EXPECT_THAT(text.data(), HasSubstr("sonars:"));
}

// A multibeam 3 m above a floor. Points of 36 bytes: x points down, y to port.
TEST_F(GazeboBridgeTest, SoundingsOfMultibeamsArePoints) {
  folder_.write("dive.yaml", R"(world: none
sonars:
  - {name: swath, type: mbes, beam_count: 24, bin_count: 300, azimuth_aperture_deg: 100, azimuth_resolution_deg: 4,
     elevation_aperture_deg: 4, max_range: 12, ping_period: 0.0625}
)");
  Program bridge = this->bridge();
  GazeboReader image("/swath/sonar_image", "gz.msgs.Image");
  GazeboReader gz("/swath/soundings", "gz.msgs.PointCloudPacked"),
      ignition("/swath/soundings", "ignition.msgs.PointCloudPacked");
  Player player("tank", "gz");
  player.send("add 10 floor 0 0 -3.5 0 static box 60 60 1");
  player.send("add 20 rov 0 0 0 0 free box 0.1 0.1 0.1");
  player.send("followed");
  (void)next(player, image, 1);
  (void)next(player, image, 1 + kPeriod);
  ASSERT_TRUE(gz.wait_for(1) && ignition.wait_for(1));
  EXPECT_EQ(gz.messages().back(), ignition.messages().back());
  ignition::msgs::PointCloudPacked cloud;
  ASSERT_TRUE(cloud.ParseFromString(gz.messages().back()));
  ASSERT_EQ(cloud.field_size(), 10);
  EXPECT_EQ(cloud.field(6).name(), "beam");
  EXPECT_EQ(cloud.field(6).datatype(), ignition::msgs::PointCloudPacked::Field::UINT16);
  EXPECT_EQ(cloud.field(7).datatype(), ignition::msgs::PointCloudPacked::Field::UINT8);
  EXPECT_EQ(cloud.field(8).datatype(), ignition::msgs::PointCloudPacked::Field::INT32);
  EXPECT_EQ(cloud.field(8).offset(), 28U);
  EXPECT_EQ(cloud.field(5).datatype(), ignition::msgs::PointCloudPacked::Field::FLOAT32);
  EXPECT_EQ(cloud.point_step(), 36U);
  ASSERT_GT(cloud.width(), 12U);
  ASSERT_EQ(cloud.data().size(), std::size_t{36} * cloud.width());
  for (std::uint32_t point = 0; point < cloud.width(); ++point) {
    float place[3];
    std::memcpy(place, &cloud.data()[std::size_t{36} * point], sizeof place);
    EXPECT_NEAR(place[0], 3, 0.3) << point;
    EXPECT_LT(std::abs(place[1]), 4) << point;
    EXPECT_EQ(place[2], 0) << point;
  }
}

TEST_F(GazeboBridgeTest, WhatCannotBeMadeIsToldOnceAndTheRestIsInsonified) {
  folder_.write("models/dock/wall.obj", "v 5 -9 -9\nv 5 9 -9\nv 5 9 9\nv 5 -9 9\nf 4 3 2 1\n");
  setenv("GZ_SIM_RESOURCE_PATH", (folder_.path() / "models").c_str(), 1);
  Program bridge = this->bridge();
  GazeboReader reader("/fls/sonar_image", "gz.msgs.Image");
  const auto player = tank("gz");
  player->send("add 30 dock 0 0 0 0 static mesh model://dock/wall.obj");
  player->send("add 40 lost 0 0 0 0 static mesh model://lost/hull.dae");
  player->send("add 50 marker 0 0 0 0 static empty");
  player->send("followed");
  EXPECT_NEAR(next(*player, reader, 1).first_echo(), 4.75, kBin);
  EXPECT_NEAR(next(*player, reader, 1 + kPeriod).first_echo(), 4.75, kBin);
  bridge.end(SIGINT);
  const std::string said = contents(kSaid);
  EXPECT_THAT(said, AllOf(HasSubstr("the world tank: 1 part of the world is skipped (an error with strict: true): "
                                    "visual 'lost::link::visual': 'model://lost/hull.dae' not found beside this file"),
                          HasSubstr("visual 'marker::link::visual' is skipped: it has no shape")));
  EXPECT_EQ(said.find("hull.dae"), said.rfind("hull.dae"));
}

TEST_F(GazeboBridgeTest, AVehicleThatIsNotThereIsTold) {
  Program bridge = this->bridge({"dive.yaml", "--vehicle", "fls=boat::hull"});
  const auto player = tank("gz");
  player->send("followed");
  for (int i = 0; i < 200 && !says(kSaid, "no ping", 0.1); ++i) {
    player->send("poses 1");
  }
  EXPECT_THAT(contents(kSaid), HasSubstr("no ping: boat::hull, which carries fls, is not in the world; its models are "
                                         "rov, wall"));
  player->send("add 60 boat 2 0 0 0 free empty");
  EXPECT_EQ(bridge.end(SIGINT), 0);
  Program other = this->bridge({"dive.yaml", "--vehicle", "sls=boat"});
  EXPECT_TRUE(says(kSaid, "--vehicle sls=boat: there is no sonar sls"));
}

TEST_F(GazeboBridgeTest, ObjectsAreLeftOutAndGivenMaterialsAsTheScenarioSays) {
  folder_.write("dive.yaml",
                std::string("world: none\nignore: [buo*, unused]\nmaterials: {later: steel}\nsonars:") + kSonar);
  Program bridge = this->bridge();
  GazeboReader reader("/fls/sonar_image", "gz.msgs.Image");
  const auto player = tank("gz");
  player->send("add 30 buoy 4 0 0 0 free box 1 1 1");
  player->send("followed");
  EXPECT_NEAR(next(*player, reader, 1).first_echo(), 7.75, kBin);
  EXPECT_THAT(contents(kSaid), HasSubstr("unused"));
}

}  // namespace
}  // namespace insonify
