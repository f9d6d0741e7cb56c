// live_loop_test.cpp -- steering and changing pings while they are made.

#include <gmock/gmock.h>

#include <future>
#include <thread>

#include "live/live_loop_fixture.h"
#include "support/message_of.h"

namespace insonify::live_loop_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class LiveLoopTest : public LiveLoopFixture {};

TEST_F(LiveLoopTest, FollowsTheTrajectoryAsARunDoes) {
  const auto loop = started(scenario_text(kTrack), {.threads = 2});
  keeper_.wait_for_pings(12);
  loop->end();
  Simulator simulator(load_scenario("live.yaml"), load_scene(load_scenario("live.yaml")), 2);
  for (const LivePing& ping : keeper_.pings()) {
    expect_same(ping.ping, simulator.make_ping(ping.sonar, ping.ping.number));
  }
  expect_repeats(loop->saved_scenario(), keeper_.pings());
}

TEST_F(LiveLoopTest, FliesAPatternAsARunDoes) {
  // The floor's upper side is at z = -2.9.
  const auto loop = started(scenario_text("pattern: {lines: {center: [1, 0], length: 6, altitude: 2.5, speed: 2}}\n"),
                            {.threads = 2});
  keeper_.wait_for_pings(12);
  EXPECT_NEAR(loop->world()->trajectory.at(1).position.x(), 0, 1e-9);
  EXPECT_NEAR(loop->world()->trajectory.at(1).position.z(), -0.4, 1e-6);
  EXPECT_EQ(answer_to([&](auto done) { loop->set({"pattern.lines.speed=1"}, done); }), "");
  EXPECT_NEAR(loop->world()->trajectory.at(1).position.x(), -1, 1e-9);
  EXPECT_EQ(answer_to([&](auto done) { loop->set({"pattern.lines.length=80"}, done); }),
            "live.yaml:9:11: pattern.lines: line 1 leaves the terrain at x = -39 m, y = 0 m");
  loop->end();
  expect_repeats(loop->saved_scenario(), pings_of(*loop));
}

TEST_F(LiveLoopTest, AChangeShowsAlsoWhereAPauseComesBeforeItsFirstPing) {
  const auto loop = started(scenario_text());
  keeper_.wait_for_pings(3);
  for (int i = 0; i < 20; ++i) {
    std::promise<void> changed;
    loop->set({"seed=" + std::to_string(20 + i)}, [&](const std::string& error) {  // Before the first ping of it.
      EXPECT_EQ(error, "");
      loop->pause(true);
      changed.set_value();
    });
    changed.get_future().wait();
    keeper_.wait_for_change(static_cast<std::uint64_t>(i) + 1, 2);
    loop->pause(false);
  }
}

TEST_F(LiveLoopTest, ASonarInsideOfAnObjectIsTold) {
  const auto loop = started(scenario_text(kTrack), {.threads = 2});
  keeper_.wait_for_pings(3);
  EXPECT_THAT(keeper_.notes(), IsEmpty());
  EXPECT_EQ(answer_to([&](auto done) { loop->place({Vec3(7, 1, -1.2), Eigen::Quaterniond::Identity()}, done); }), "");
  keeper_.wait_for_notes(2);  // One note of each sonar.
  keeper_.wait_for_pings(20);
  EXPECT_THAT(keeper_.notes(),
              testing::UnorderedElementsAre("fls is inside of ball::link::ball, and receives its inner surface",
                                            "head is inside of ball::link::ball, and receives its inner surface"));
}

TEST_F(LiveLoopTest, SettingsAreAllOrNothingWithTheMessagesOfTheCommandLine) {
  const auto loop = started(scenario_text(), {.threads = 2}, {"seed=3"});
  const std::vector<std::string> wrong = {"sonars.fls.max_range=9", "sonars.fls.min_range=13"};
  const std::string expected = message_of([&] {
    (void)load_scenario("live.yaml", std::vector<std::string>{"seed=3", wrong[0], wrong[1]});
  });
  EXPECT_THAT(expected, HasSubstr("--set sonars.fls.m"));
  EXPECT_EQ(answer_to([&](auto done) { loop->set(wrong, done); }), expected);
  EXPECT_EQ(loop->world()->sonars[0].max_range, 12);
  EXPECT_EQ(answer_to([&](auto done) { loop->set({"maxrange=3"}, done); }),
            "--set maxrange=3: maxrange is not a known key; did you mean max_range?");
  EXPECT_EQ(answer_to([&](auto done) { loop->set({"sonars.fls.max_range=9"}, done); }), "");
  EXPECT_EQ(loop->world()->sonars[0].max_range, 9);
  EXPECT_EQ(loop->world()->scenario.seed, 3U) << "settings of before hold on";
}

// A change of sonars alone, which a simulator takes in; and of the model, for which it is rebuilt.
TEST_F(LiveLoopTest, ChangedSettingsMakeThePingsOfAScenarioThatHadThem) {
  const auto loop = started(scenario_text(kTrack));
  for (const std::vector<std::string>& settings :
       {std::vector<std::string>{"sonars.fls.max_range=9.5", "sonars[0].beam_count=17"},
        std::vector<std::string>{"receiver.speckle=false"}, std::vector<std::string>{"model=paper"},
        std::vector<std::string>{"model=calibrated", "surface.level=2"}}) {
    EXPECT_EQ(answer_to([&](auto done) { loop->set(settings, done); }), "");
    keeper_.wait_for_pings(6);
  }
  loop->end();
  EXPECT_EQ(loop->world()->sonars[0].beam_count, 17);
  EXPECT_EQ(loop->world()->scene.instances.size(), 3U) << "the surface";
  const std::vector<LivePing> all = keeper_.pings();
  for (const LivePing& ping : all) {
    const Scenario& scenario = ping.world->scenario;
    Simulator simulator(scenario, load_scene(scenario), 2);
    if (ping.ping.number < 2) {
      expect_same(ping.ping, simulator.make_ping(ping.sonar, ping.ping.number));
    }
  }
  expect_repeats(loop->saved_scenario(), pings_of(*loop));
}

TEST_F(LiveLoopTest, AChangeOfSettingsGoesOnAlongTheTrajectory) {
  const auto loop = started(scenario_text(kTrack), {.threads = 2, .paused = true});
  keeper_.wait_for_all(2);
  for (int i = 0; i < 20; ++i) {
    loop->step();
  }
  keeper_.wait_for_all(22);
  const double before = keeper_.pings().back().world_from_vehicle.position.x();
  EXPECT_GT(before, -0.9);
  EXPECT_EQ(answer_to([&](auto done) { loop->set({"sonars.fls.beam_count=9"}, done); }), "");
  keeper_.wait_for_change(1, 2);
  const LivePing ping = keeper_.last(0);
  EXPECT_EQ(ping.ping.number, 0U);
  EXPECT_EQ(ping.ping.beam_count, 9);
  EXPECT_GT(ping.world_from_vehicle.position.x(), before - 1e-9);
  EXPECT_LT(ping.world_from_vehicle.position.x(), before + 0.1);
  EXPECT_EQ(answer_to([&](auto done) { loop->follow(true, done); }), "");
  keeper_.wait_for_change(2, 2);
  EXPECT_EQ(keeper_.last(0).world_from_vehicle.position.x(), -1) << "back to the start";
}

TEST_F(LiveLoopTest, PausesStepsAndGoesOn) {
  const auto loop = started(scenario_text(), {.threads = 2, .paused = true});
  EXPECT_TRUE(loop->state().paused);
  keeper_.wait_for_all(2);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(keeper_.pings().size(), 2U) << "the first of both, to have something to show";
  loop->step();
  keeper_.wait_for_all(3);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(keeper_.pings().size(), 3U) << "of the fls alone, at 0.03 s";
  EXPECT_EQ(keeper_.pings().back().ping.time, 0.03);
  loop->pause(false);
  keeper_.wait_for_pings(5);
}

// 0.03 s a ping: at most 33 pings a second of the fls at speed 1, and 20 with a limit.
TEST_F(LiveLoopTest, KeepsThePaceOfTheClockAndTheLimitOfTheRate) {
  for (const auto& [limit, speed, most] :
       {std::tuple(std::optional<double>(), 1.0, 33.3), std::tuple(std::optional(20.0), 1.0, 20.0),
        std::tuple(std::optional<double>(), 0.25, 8.4)}) {
    LiveKeeper keeper;
    folder_.write("pace.yaml", scenario_text());
    LiveLoop loop("pace.yaml", {}, {.threads = 2, .rate_limit = limit});
    loop.set_speed(speed);
    const auto begin = std::chrono::steady_clock::now();
    loop.start(keeper);
    keeper.wait_for_all(16);
    loop.end();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const std::vector<LivePing> pings = keeper.pings();
    const auto made = std::ranges::count(pings, 0, &LivePing::sonar);
    EXPECT_LE(made, seconds * most + 2.5);  // One at the start and one of rounding.
    EXPECT_GE(made, 2);
  }
}

TEST_F(LiveLoopTest, MaterialsOfObjectsChange) {
  const auto loop = started(scenario_text());
  EXPECT_EQ(answer_to([&](auto done) { loop->set_material("ball::link::ball", "steel", done); }), "");
  const Instance& ball = loop->world()->scene.instances[1];
  EXPECT_EQ(loop->world()->scene.materials[ball.materials[0]].density, find_material("steel")->density);
  EXPECT_THAT(answer_to([&](auto done) { loop->set_material("ball::link::ball", "stel", done); }), HasSubstr("steel"));
  EXPECT_THAT(answer_to([&](auto done) { loop->set_material("bell", "steel", done); }), HasSubstr("bell"));
  keeper_.wait_for_pings(3);
  loop->end();
  expect_repeats(loop->saved_scenario(), pings_of(*loop));
}

TEST_F(LiveLoopTest, VehicleStopsBelowTheSurfaceWithANote) {
  const auto loop = started(scenario_text("surface: {level: 1.5}\n"));
  loop->fly({{0, 0, 40}, {}});
  keeper_.wait_for_notes(1);
  EXPECT_THAT(keeper_.notes(),
              ElementsAre(HasSubstr("the vehicle stops: surface.level = 1.5 m must be above the sonars")));
  loop->fly({{1, 0, -0.1}, {}});
  keeper_.wait_for_pings(4);
  loop->end();
  const std::vector<LivePing> pings = pings_of(*loop);
  EXPECT_LT(pings.back().world_from_vehicle.position.z(), 1.5);
  expect_repeats(loop->saved_scenario(), pings);
}

TEST_F(LiveLoopTest, RefusesWhatIsOutOfLimits) {
  const auto loop = started(scenario_text(), {.threads = 2, .paused = true});
  EXPECT_EQ(message_of([&] { loop->set_speed(0); }), "speed = 0 must be from 0.01 to 100");
  EXPECT_EQ(message_of([&] { loop->fly({{0, -51, 0}, {}}); }), "fly.linear[1] = -51 m/s must be from -50 to 50 m/s");
  EXPECT_EQ(message_of([&] {
              loop->fly({{}, {0, 0, std::numbers::pi}});
            }),
            "fly.angular_deg[2] = 180 deg must be from -90 to 90 deg");
  EXPECT_EQ(message_of([&] {
              loop->place({{0, 0, 1e9}, Eigen::Quaterniond::Identity()});
            }),
            "world_from_vehicle.position[2] = 1000000000 m must be from -10000000 to 10000000 m");
}

}  // namespace
}  // namespace insonify::live_loop_test
