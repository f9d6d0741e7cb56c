// live_objects_test.cpp -- objects that come and go while a loop makes pings.

#include <gmock/gmock.h>

#include "insonify/files.h"
#include "insonify/live_loop.h"
#include "insonify/simulator.h"
#include "insonify/stored_tables.h"
#include "live/live_pings.h"
#include "support/same_pings.h"
#include "support/working_folder.h"

namespace insonify::live_objects_test {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr double kPeriod = 0.041;  // [s]

constexpr const char* kScenario = R"(world: gone.sdf
seed: 5
materials: {buoy: steel, pile: concrete}
sonars:
  - {name: fls, beam_count: 24, bin_count: 90, azimuth_aperture_deg: 70, elevation_aperture_deg: 25, max_range: 12,
     ping_period: 0.041, sampling: {columns_per_beam: 2, rows: 40}}
  - {name: rear, beam_count: 16, bin_count: 60, azimuth_aperture_deg: 70, elevation_aperture_deg: 25, max_range: 12,
     ping_period: 0.041, sampling: {columns_per_beam: 2, rows: 40}}
)";

Instance sphere(const std::string& name, double x, bool moving) {
  static const auto mesh = std::make_shared<const Mesh>(make_sphere(0.5));
  return {.name = name, .mesh = mesh, .world_from_mesh = {Vec3(x, 0.2, 0)}, .moving = moving};
}

Scene scene_of(std::vector<Instance> instances) {
  Scene scene;
  scene.instances = std::move(instances);
  return scene;
}

// Range of the loudest bin [m].
double loudest(const LivePing& ping) {
  const auto most = std::ranges::max_element(ping.ping.intensity);
  const auto bin = (most - ping.ping.intensity.begin()) / ping.ping.beam_count;
  return ping.world->sonars[static_cast<std::size_t>(ping.sonar)].bin_range(static_cast<int>(bin));
}

class LiveObjectsTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("gone.sdf", "<sdf version='1.9'/>");
    folder_.write("live.yaml", kScenario);
    loop_ = std::make_unique<LiveLoop>("live.yaml", std::span<const std::string>(),
                                       LiveOptions{.threads = 1, .driven = true, .clocked = true, .followed = true});
    loop_->start(keeper_);
  }

  // The pings of both sonars at the next time.
  std::vector<LivePing> next(const LiveDrive& drive = {}) {
    loop_->drive(drive);
    loop_->advance(kPeriod * static_cast<double>(times_++));
    keeper_.wait_for_all(2 * times_);
    const std::vector<LivePing> all = keeper_.pings();
    return {all.end() - 2, all.end()};
  }

  // A run that restarts makes its first pings at once.
  void wait_for_first() { keeper_.wait_for_all(2 * ++times_); }

  WorkingFolder folder_;
  LiveKeeper keeper_;
  std::unique_ptr<LiveLoop> loop_;
  std::size_t times_ = 0;
};

TEST_F(LiveObjectsTest, ComeAndGoBetweenTwoPings) {
  loop_->change_objects({.added = scene_of({sphere("pile::l::pile", 7, false)})});
  EXPECT_NEAR(loudest(next()[0]), 6.5, 0.2);  // 7 m less the radius, within a bin of 0.13 m.
  loop_->change_objects({.added = scene_of({sphere("buoy::l::buoy", 4, true)})});
  const LivePing nearer = next()[0];
  EXPECT_NEAR(loudest(nearer), 3.5, 0.2);
  EXPECT_EQ(nearer.ping.number, 1U);  // Numbers go on.
  EXPECT_EQ(nearer.world->scene.instances.size(), 2U);
  EXPECT_EQ(nearer.world->scene.materials[nearer.world->scene.instances[1].materials[0]].name, "buoy");
  loop_->change_objects({.removed = {"buoy::l::buoy"}});
  EXPECT_NEAR(loudest(next()[0]), 6.5, 0.2);
  loop_->change_objects({.removed = {"pile::l::pile"}, .added = scene_of({sphere("pile::l::pile", 9, false)})});
  EXPECT_NEAR(loudest(next()[0]), 8.5, 0.2);
  loop_->end();
}

TEST_F(LiveObjectsTest, PingsAreThoseOfASceneWithTheSameObjects) {
  loop_->change_objects({.added = scene_of({sphere("a", 7, false), sphere("b", 4, true)})});
  loop_->change_objects({.removed = {"a"}, .added = scene_of({sphere("c", 5, false)})});
  (void)next();
  const LiveDrive drive{.world_from_vehicle = {Vec3(0.3, 0.1, 0)},
                        .moved = {{.name = "b", .world_from_object = {Vec3(3, -0.6, 0)}}}};
  const LivePing live = next(drive)[0];
  loop_->end();
  Scenario scenario = load_scenario("live.yaml");
  scenario.materials.for_more = true;
  Scene scene = scene_of({sphere("b", 4, true), sphere("c", 5, false)});
  assign_scenario_materials(scene, scenario);
  Simulator simulator(scenario, scene, 1);
  PingRequest request{.number = 1, .time = kPeriod, .world_from_vehicle = drive.world_from_vehicle};
  request.moved = drive.moved;
  EXPECT_EQ(simulator.ping(0, request).intensity, live.ping.intensity);
}

// The engine keeps what it has built where the middle of the scene stays.
TEST_F(LiveObjectsTest, PingsAreThoseOfANewSceneWhereMostOfItStays) {
  const Instance floor{.name = "floor",
                       .mesh = std::make_shared<const Mesh>(make_box({40, 40, 1})),
                       .world_from_mesh = {Vec3(0, 0, -2)}};
  Instance turned = sphere("c", 5, false);
  turned.world_from_mesh = {Vec3(6, 1, 0), orientation_from_rpy(0.1, 0.2, 0.3)};
  const auto expected = [&](const Scene& given, std::uint64_t number, const std::vector<MovedObject>& moved) {
    Scenario scenario = load_scenario("live.yaml");
    scenario.materials.for_more = true;
    Scene scene = given;
    assign_scenario_materials(scene, scenario);
    Simulator simulator(scenario, scene, 1);
    PingRequest request{.number = number, .time = kPeriod * static_cast<double>(number), .moved = moved};
    return simulator.ping(0, request).intensity;
  };
  loop_->change_objects({.added = scene_of({floor, sphere("a", 7, false), sphere("b", 4, true)})});
  EXPECT_EQ(next()[0].ping.intensity, expected(scene_of({floor, sphere("a", 7, false), sphere("b", 4, true)}), 0, {}));
  const std::vector<MovedObject> moved = {{.name = "b", .world_from_object = {Vec3(3, -0.6, 0)}}};
  EXPECT_EQ(next({.world_from_vehicle = {}, .moved = moved})[0].ping.intensity,
            expected(scene_of({floor, sphere("a", 7, false), sphere("b", 4, true)}), 1, moved));
  loop_->change_objects({.removed = {"a"}, .added = scene_of({turned, sphere("d", 8, true)})});
  EXPECT_EQ(next({.world_from_vehicle = {}, .moved = moved})[0].ping.intensity,
            expected(scene_of({floor, sphere("b", 4, true), turned, sphere("d", 8, true)}), 2, moved));
  loop_->change_objects({.removed = {"b", "c"}, .added = scene_of({sphere("b", 5, false)})});
  EXPECT_EQ(next()[0].ping.intensity, expected(scene_of({floor, sphere("d", 8, true), sphere("b", 5, false)}), 3, {}));
  loop_->end();
}

TEST_F(LiveObjectsTest, StayWhenSettingsChange) {
  loop_->change_objects({.added = scene_of({sphere("a", 7, false), sphere("b", 4, true)})});
  (void)next();
  // While the change is prepared.
  const std::string error = answer_to([&](const LiveLoop::Done& done) {
    loop_->set({"water.salinity=3", "receiver.speckle=false"}, done);  // Speckle moves the loudest bin.
    loop_->change_objects({.removed = {"b"}, .added = scene_of({sphere("c", 5, false)})});
  });
  EXPECT_EQ(error, "");
  wait_for_first();
  const LivePing after = next()[0];
  EXPECT_NEAR(loudest(after), 4.5, 0.2);
  EXPECT_EQ(after.world->scenario.water.salinity, 3);
  loop_->end();
}

TEST_F(LiveObjectsTest, ARecordingGoesOnInAFurtherFile) {
  loop_->change_objects({.added = scene_of({sphere("a", 7, false)})});
  (void)next();
  EXPECT_EQ(answer_to([&](const LiveLoop::Done& done) { loop_->record("out.h5", done); }), "");
  wait_for_first();
  (void)next();
  loop_->change_objects({.added = scene_of({sphere("b", 4, true)})});
  wait_for_first();
  const LivePing after = next()[0];
  EXPECT_NEAR(loudest(after), 3.5, 0.2);
  EXPECT_EQ(answer_to([&](const LiveLoop::Done& done) { loop_->stop_recording(done); }), "");
  loop_->end();
  const std::vector<LiveRecording> recordings = keeper_.recordings();
  ASSERT_EQ(recordings.size(), 2U);
  EXPECT_EQ(recordings[0].pings, 4U);
  EXPECT_EQ(recordings[1].pings, 4U);
  EXPECT_EQ(recordings[1].files[0], "out-2-fls.h5");
  EXPECT_TRUE(std::filesystem::exists("out-fls.h5") && std::filesystem::exists("out-2-fls.h5"));
}

TEST_F(LiveObjectsTest, ARecordingBegunAfterAnObjectIsGoneDoesNotNameIt) {
  loop_->change_objects({.added = scene_of({sphere("a", 7, false), sphere("b", 5, false)})});
  (void)next();
  loop_->change_objects({.removed = {"a"}});
  (void)next();
  for (const char* file : {"out.h5", "other.mcap"}) {
    EXPECT_EQ(answer_to([&](const LiveLoop::Done& done) { loop_->record(file, done); }), "");
    wait_for_first();
    (void)next();
    EXPECT_EQ(answer_to([&](const LiveLoop::Done& done) { loop_->stop_recording(done); }), "");
  }
  loop_->end();
  EXPECT_THAT(StoredTables("out-fls.h5").texts("instance_names"), testing::ElementsAre("", "b"));
  EXPECT_THAT(StoredTables("other.mcap", "fls").texts("instance_names"), testing::ElementsAre("", "b"));
}

TEST_F(LiveObjectsTest, SonarsMayBeCarriedByDifferentThings) {
  loop_->change_objects({.added = scene_of({sphere("a", 7, false)})});
  const std::vector<LivePing> pings = next(
      {.world_from_vehicle = {Vec3(1, 0, 0)}, .carried = {{.sonar = "rear", .world_from_carrier = {Vec3(3, 0, 0)}}}});
  EXPECT_NEAR(loudest(pings[0]), 5.5, 0.2);
  EXPECT_NEAR(loudest(pings[1]), 3.5, 0.2);
  loop_->end();
}

TEST_F(LiveObjectsTest, WhatCannotBeAddedIsLeftOutAndTold) {
  Instance wrong = sphere("wrong", 3, true);
  wrong.user_material = "unobtainium";
  loop_->change_objects({.added = scene_of({wrong, sphere("a", 7, false)})});
  EXPECT_NEAR(
      loudest(next({.world_from_vehicle = {}, .moved = {{.name = "wrong", .world_from_object = {Vec3(2, 0, 0)}}}})[0]),
      6.5, 0.2);
  EXPECT_THAT(keeper_.notes(), Contains(HasSubstr("wrong: material = unobtainium is not a known material")));
  loop_->end();
}

TEST_F(LiveObjectsTest, NamesThatDoNotFitAreRefusedWhole) {
  loop_->change_objects({.added = scene_of({sphere("a", 7, false)})});
  const auto refusal = [&](LiveObjects change) -> std::string {
    try {
      loop_->change_objects(std::move(change));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({.removed = {"a", "z"}}), "there is no object z to remove");
  EXPECT_EQ(refusal({.added = scene_of({sphere("b", 4, false), sphere("a", 4, false)})}),
            "an object a exists already; remove it first, or choose another name");
  EXPECT_EQ(refusal({.added = scene_of({sphere("", 4, false)})}), "an object to be added has no name");
  EXPECT_NEAR(loudest(next()[0]), 6.5, 0.2);  // Nothing has changed.
  loop_->end();
}

}  // namespace
}  // namespace insonify::live_objects_test
