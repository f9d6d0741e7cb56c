// live_drive_test.cpp -- pings of a vehicle moved by another program, at another program's time.

#include <gmock/gmock.h>

#include <limits>
#include <thread>

#include "insonify/files.h"
#include "insonify/live_loop.h"
#include "insonify/simulator.h"
#include "live/live_pings.h"
#include "support/message_of.h"
#include "support/same_pings.h"
#include "support/working_folder.h"

namespace insonify::live_drive_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr double kPeriod = 0.041;  // [s]

std::string scenario_text(const std::string& more = "") {
  return R"(world: none
seed: 5
points: [{position: [6, 0.5, -1], target_strength_db: -10}]
sonars:
  - {name: fls, beam_count: 24, bin_count: 90, azimuth_aperture_deg: 70, elevation_aperture_deg: 25, max_range: 12,
     ping_period: 0.041, position: [0.4, 0, -0.1], orientation_deg: [0, 11, 0], sampling: {columns_per_beam: 2, rows: 40}}
trajectory: [{time: 0, position: [100, 0, 0]}, {time: 9, position: [110, 0, 0]}]
)" + more;
}

Pose pose_at(double x, double yaw = 0.1) {
  return {Vec3(x, 0.2, -1), orientation_from_rpy(0.02, -0.01, yaw)};
}

class LiveDriveTest : public testing::Test {
 protected:
  void start(const LiveOptions& options, const std::string& text = scenario_text()) {
    folder_.write("live.yaml", text);
    loop_ = std::make_unique<LiveLoop>("live.yaml", std::span<const std::string>(), options);
    loop_->start(keeper_);
  }

  WorkingFolder folder_;
  LiveKeeper keeper_;
  std::unique_ptr<LiveLoop> loop_;
};

// Poses come faster than pings are made; too many are refused.
TEST_F(LiveDriveTest, EachPoseHasOnePingOnRequest) {
  start({.threads = 1, .driven = true, .on_request = true});
  const auto ask = [this](int i) { loop_->drive({.world_from_vehicle = pose_at(0.1 * i), .stamp = 70.0 + i}); };
  for (int i = 0; i < 4; ++i) {
    ask(i);
  }
  keeper_.wait_for_all(4);
  ask(4);
  keeper_.wait_for_all(5);
  loop_->pause(true);
  EXPECT_EQ(message_of([&] {
              for (int i = 0; i <= 1000; ++i) {
                ask(5);
              }
            }),
            "drive: 1000 poses wait for their pings");
  loop_->end();
  const std::vector<LivePing> pings = keeper_.pings();
  ASSERT_GE(pings.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(pings[i].ping.number, i);
    EXPECT_EQ(pings[i].stamp, 70 + static_cast<double>(i));
    EXPECT_LT((pings[i].world_from_vehicle.position - pose_at(0.1 * static_cast<double>(i)).position).norm(), 2e-5);
  }
  EXPECT_TRUE(pings[4].received_at > pings[3].received_at && pings[1].received_at > pings[0].received_at);
}

TEST_F(LiveDriveTest, PingsAreMadeWhereTheVehicleWasToldToBe) {
  start({.threads = 1, .driven = true, .clocked = true});
  for (int i = 0; i < 5; ++i) {
    loop_->drive({.world_from_vehicle = pose_at(-9), .stamp = -1});  // Replaced by the next.
    loop_->drive({.world_from_vehicle = pose_at(0.3 * i, 0.2 * i), .stamp = 70.0 + i});
    loop_->advance(1000 + kPeriod * i);
    keeper_.wait_for_all(static_cast<std::size_t>(i) + 1);
  }
  loop_->end();
  const std::vector<LivePing> pings = keeper_.pings();
  ASSERT_EQ(pings.size(), 5U);
  const std::string yaml = loop_->saved_scenario();
  const Scenario scenario = parse_scenario(yaml);
  Simulator simulator(scenario, load_scene(scenario), 1);
  for (std::size_t i = 0; i < pings.size(); ++i) {
    const double index = static_cast<double>(i);
    EXPECT_EQ(pings[i].ping.number, i);
    EXPECT_NEAR(pings[i].ping.time, kPeriod * index, 1e-9);
    EXPECT_EQ(pings[i].stamp, 70 + index);
    EXPECT_EQ(pings[i].clock, 1000 + kPeriod * index);
    EXPECT_GE(pings[i].made_at, pings[i].received_at);
    EXPECT_LT(pings[i].made_at - pings[i].received_at, 10);
    const Pose told = pose_at(0.3 * index, 0.2 * index);
    EXPECT_LT((pings[i].world_from_vehicle.position - told.position).norm(), 2e-5);
    EXPECT_LT(pings[i].world_from_vehicle.orientation.angularDistance(told.orientation), 2e-5);
    expect_same(pings[i].ping, simulator.make_ping(0, i));
  }
}

TEST_F(LiveDriveTest, ThereIsNoPingBeforeThePoseAndTheTime) {
  start({.threads = 1, .driven = true, .clocked = true});
  loop_->advance(3);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_THAT(keeper_.pings(), IsEmpty());
  loop_->drive({.world_from_vehicle = pose_at(0)});
  keeper_.wait_for_all(1);
  loop_->advance(3 + 0.99 * kPeriod);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(keeper_.pings().size(), 1U);
  loop_->advance(3 + kPeriod);
  keeper_.wait_for_all(2);
}

TEST_F(LiveDriveTest, AClockThatJumpsMakesNoQueue) {
  start({.threads = 1, .driven = true, .clocked = true});
  loop_->drive({.world_from_vehicle = pose_at(0)});
  loop_->advance(0);
  keeper_.wait_for_all(1);
  loop_->advance(100);
  keeper_.wait_for_all(2);
  loop_->advance(100 + 0.9 * kPeriod);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(keeper_.pings().size(), 2U);
  loop_->advance(2);  // The other program restarted.
  loop_->advance(2 + 0.9 * kPeriod);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const std::size_t before = keeper_.pings().size();
  EXPECT_LE(before, 3U);
  loop_->advance(2 + 1.01 * kPeriod);
  loop_->advance(2 + 2.02 * kPeriod);
  keeper_.wait_for_all(before + 1);
}

TEST_F(LiveDriveTest, WithoutAClockPingsComeAtTheSonarsRate) {
  start({.threads = 1, .driven = true});
  loop_->drive({.world_from_vehicle = pose_at(0), .stamp = 4});
  keeper_.wait_for_all(3);
  loop_->drive({.world_from_vehicle = pose_at(1), .stamp = 5});
  keeper_.wait_for_pings(3);
  loop_->end();
  const std::vector<LivePing> pings = keeper_.pings();
  EXPECT_EQ(pings.front().stamp, 4);
  EXPECT_EQ(pings.back().stamp, 5);
  const double between = (pings.back().made_at - pings.front().made_at) / static_cast<double>(pings.size() - 1);
  EXPECT_GT(between, 0.9 * kPeriod);
}

TEST_F(LiveDriveTest, APlaceWithoutPingsIsToldAndLeft) {
  start({.threads = 1, .driven = true}, scenario_text("surface: {level: 0.5}\n"));
  loop_->drive({.world_from_vehicle = {Vec3(0, 0, 3), Eigen::Quaterniond::Identity()}});
  keeper_.wait_for_notes(1);
  EXPECT_THAT(keeper_.notes().back(), StartsWith("no ping: "));
  EXPECT_THAT(keeper_.pings(), IsEmpty());
  loop_->drive({.world_from_vehicle = pose_at(0)});
  keeper_.wait_for_all(2);
  loop_->drive({.world_from_vehicle = {Vec3(0, 0, 3), Eigen::Quaterniond::Identity()}});
  keeper_.wait_for_notes(2);
  loop_->drive({.world_from_vehicle = pose_at(1), .stamp = 8});
  keeper_.wait_for_pings(2);
  EXPECT_EQ(keeper_.pings().back().stamp, 8);
}

TEST_F(LiveDriveTest, SettingsActOnTheNextPing) {
  start({.threads = 1, .driven = true});
  loop_->drive({.world_from_vehicle = pose_at(0.7)});
  keeper_.wait_for_all(1);
  EXPECT_EQ(answer_to([&](auto done) { loop_->set({"max_range=9"}, done); }), "");
  keeper_.wait_for_pings(2);
  const LivePing last = keeper_.pings().back();
  EXPECT_EQ(last.world->sonars[0].max_range, 9);
  EXPECT_LT((last.world_from_vehicle.position - pose_at(0.7).position).norm(), 2e-5);
}

TEST_F(LiveDriveTest, WhatDoesNotFitIsRefused) {
  start({.threads = 1, .driven = true});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message_of([&] {
                loop_->drive({.world_from_vehicle = {Vec3(nan, 0, 0), Eigen::Quaterniond::Identity()}});
              }),
              HasSubstr("position"));
  EXPECT_THAT(message_of([&] { loop_->advance(1); }), HasSubstr("LiveOptions::clocked"));
  EXPECT_EQ(answer_to([&](auto done) { loop_->place(pose_at(0), done); }), "another program moves the vehicle");
  EXPECT_EQ(answer_to([&](auto done) { loop_->follow(true, done); }), "another program moves the vehicle");
  LiveLoop other("live.yaml", std::span<const std::string>(), {.threads = 1, .clocked = true});
  EXPECT_THAT(message_of([&] { other.drive({}); }), HasSubstr("LiveOptions::driven"));
  EXPECT_EQ(message_of([&] { other.advance(nan); }), "time = nan s must be finite");
}

}  // namespace
}  // namespace insonify::live_drive_test
