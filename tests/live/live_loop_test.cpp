// live_loop_test.cpp -- steering, changing and recording pings while they are made.

#include "insonify/live_loop.h"

#include <gmock/gmock.h>

#include <future>
#include <thread>

#include "insonify/files.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "io/h5_read.h"
#include "live/live_pings.h"
#include "support/message_of.h"
#include "support/same_pings.h"
#include "support/working_folder.h"

namespace insonify {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kWorld = R"(<?xml version="1.0"?>
<sdf version="1.9"><world name="pool">
  <model name="floor"><static>true</static><pose>0 0 -3 0 0 0</pose><link name="link"><visual name="sand">
    <geometry><box><size>60 60 0.2</size></box></geometry></visual></link></model>
  <model name="ball"><static>true</static><pose>7 1 -1.2 0 0 0</pose><link name="link"><visual name="ball">
    <geometry><sphere><radius>0.6</radius></sphere></geometry></visual></link></model>
</world></sdf>)";

// Two sonars whose pings meet at some times only.
std::string scenario_text(const std::string& more = "") {
  return R"(world: pool.sdf
seed: 11
ground_truth: labels
sonars:
  - {name: fls, beam_count: 24, bin_count: 90, azimuth_aperture_deg: 70, elevation_aperture_deg: 25, max_range: 12,
     ping_period: 0.03, position: [0.4, 0, -0.1], orientation_deg: [0, 11, 0], sampling: {columns_per_beam: 2, rows: 40}}
  - {name: head, type: msis, beam_count: 1, bin_count: 70, azimuth_aperture_deg: 4, elevation_aperture_deg: 30,
     max_range: 14, step_deg: 7, ping_period: 0.07, orientation_deg: [0, 5, 0], sampling: {columns_per_beam: 4, rows: 60}}
)" + more;
}

constexpr const char* kTrack = R"(trajectory:
  - {time: 0, position: [-1, 0.3, 0.2], orientation_deg: [0, 0, 3]}
  - {time: 7, position: [2, -0.4, 0.1], orientation_deg: [1, -2, 17]}
)";

// Velocities off every axis.
const LiveVelocity kAhead{{0.8, 0.1, -0.05}, {0.02, -0.03, 0.3}};
const LiveVelocity kAround{{-0.5, 0.6, 0.1}, {0, 0.1, -0.7}};

class LiveLoopTest : public testing::Test {
 protected:
  LiveLoopTest() { folder_.write("pool.sdf", kWorld); }

  std::unique_ptr<LiveLoop> started(const std::string& text, const LiveOptions& options = {.threads = 2},
                                    const std::vector<std::string>& settings = {}) {
    folder_.write("live.yaml", text);
    auto loop = std::make_unique<LiveLoop>("live.yaml", settings, options);
    loop->start(keeper_);
    return loop;
  }

  // Every ping that a saved scenario asks for is the one that was made live.
  static void expect_repeats(const std::string& yaml, const std::vector<LivePing>& live) {
    const Scenario scenario = parse_scenario(yaml);
    const ScenarioRequests requests(scenario);
    Simulator simulator(scenario, load_scene(scenario), 2);
    std::vector<std::uint64_t> numbers(scenario.sonars.size(), 0);
    for (const LivePing& ping : live) {
      const std::uint64_t number = numbers[static_cast<std::size_t>(ping.sonar)]++;
      EXPECT_EQ(ping.ping.number, number);
      expect_same(ping.ping, simulator.make_ping(ping.sonar, number));
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      EXPECT_EQ(requests.ping_count(static_cast<int>(i)), numbers[i]) << scenario.sonars[i].name;
    }
  }

  // Those of the last world that the loop has had.
  [[nodiscard]] std::vector<LivePing> pings_of(const LiveLoop& loop) const {
    std::vector<LivePing> pings = keeper_.pings();
    std::erase_if(pings, [&](const LivePing& ping) { return ping.world != loop.world(); });
    return pings;
  }

  WorkingFolder folder_;
  LiveKeeper keeper_;
};

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
              testing::UnorderedElementsAre("fls is inside of ball::link::ball, whose surface it hears from within",
                                            "head is inside of ball::link::ball, whose surface it hears from within"));
}

class LiveMotionTest : public LiveLoopTest, public testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(MotionInPing, LiveMotionTest, testing::Bool(),
                         [](const auto& test) { return test.param ? "On" : "Off"; });

TEST_P(LiveMotionTest, SavedScenarioRepeatsTheFlight) {
  const auto loop = started(scenario_text(std::string(kTrack) + "motion_in_ping: " + (GetParam() ? "true" : "false")));
  keeper_.wait_for_pings(3);
  EXPECT_TRUE(loop->state().follows);
  loop->fly(kAhead);
  keeper_.wait_for_pings(25);
  loop->fly(kAround);
  keeper_.wait_for_pings(25);
  loop->fly({});
  keeper_.wait_for_pings(10);
  EXPECT_FALSE(loop->state().follows);
  loop->end();
  const std::vector<LivePing> pings = pings_of(*loop);
  EXPECT_GT(pings.size(), 40U);
  EXPECT_GT((pings.back().world_from_vehicle.position - pings.front().world_from_vehicle.position).norm(), 0.1);
  expect_repeats(loop->saved_scenario(), pings);
}

TEST_P(LiveMotionTest, RecordingIsRepeatedByTheScenarioBesideIt) {
  const auto loop = started(scenario_text(std::string("motion_in_ping: ") + (GetParam() ? "true" : "false")));
  loop->place({{0.2, -0.5, 0.3}, orientation_from_rpy(0.02, 0.05, 0.2)});
  EXPECT_EQ(answer_to([&](auto done) { loop->record("out.h5", done); }), "");
  loop->fly(kAhead);
  keeper_.wait_for_pings(20);
  EXPECT_THAT(loop->state().recording, "out-fls.h5, out-head.h5");
  EXPECT_EQ(answer_to([&](auto done) { loop->stop_recording(done); }), "");
  EXPECT_EQ(loop->state().recording, "");
  loop->end();

  const Scenario scenario = load_scenario("out.yaml");
  const ScenarioRequests requests(scenario);
  Simulator simulator(scenario, load_scene(scenario), 2);
  for (const int sonar : {0, 1}) {
    const H5Reader file(sonar == 0 ? "out-fls.h5" : "out-head.h5");
    EXPECT_GT(file.shape("intensity")[0], 3U);
    ASSERT_EQ(file.shape("intensity")[0], requests.ping_count(sonar));
    for (std::uint64_t number = 0; number < requests.ping_count(sonar); ++number) {
      const Ping ping = simulator.make_ping(sonar, number);
      EXPECT_TRUE(file.row<float>("intensity", number) == ping.intensity) << "ping " << number;
      EXPECT_TRUE(file.row<std::uint16_t>("instance", number) == ping.instance);
    }
  }
}

TEST_F(LiveLoopTest, ChangesDuringARecordingBeginAnotherFile) {
  const auto loop = started(scenario_text());
  EXPECT_EQ(answer_to([&](auto done) { loop->record("a/b.mcap", done); }),
            "a/b.mcap: cannot create: No such file or directory");
  EXPECT_EQ(answer_to([&](auto done) { loop->record("b.mcap", done); }), "");
  keeper_.wait_for_pings(4);
  EXPECT_EQ(answer_to([&](auto done) { loop->record("c.mcap", done); }), "b.mcap is being recorded already");
  EXPECT_EQ(answer_to([&](auto done) { loop->set({"seed=12"}, done); }), "");
  keeper_.wait_for_pings(4);
  EXPECT_EQ(loop->state().recording, "b-2.mcap");
  loop->end();
  for (const char* name : {"b.mcap", "b.yaml", "b-2.mcap", "b-2.yaml"}) {
    EXPECT_TRUE(std::filesystem::exists(name)) << name;
  }
  EXPECT_EQ(load_scenario("b.yaml").seed, 11U);
  EXPECT_EQ(load_scenario("b-2.yaml").seed, 12U);
}

// Requests that come while another is prepared are done together; a second recording is refused all the same, and what
// was asked for beside it is done.
TEST_F(LiveLoopTest, RequestsAtOnceBeginOneRecordingAndDoTheOtherChanges) {
  const auto loop = started(scenario_text());
  std::array<std::promise<std::string>, 5> answers;
  const auto to = [&](std::size_t i) {
    return [&answers, i](const std::string& error) { answers[i].set_value(error); };
  };
  loop->set({"seed=7"}, to(0));
  loop->record("b.mcap", to(1));
  loop->record("c.h5", to(2));
  loop->set({"seed=8"}, to(3));
  loop->record("d.mcap", to(4));
  std::vector<std::string> errors;
  for (std::promise<std::string>& answer : answers) {
    errors.push_back(answer.get_future().get());
  }
  EXPECT_THAT(errors,
              ElementsAre("", "", "b.mcap is being recorded already", "", "b-2.mcap is being recorded already"));
  EXPECT_EQ(loop->world()->scenario.seed, 8U);
}

TEST_F(LiveLoopTest, RecordingsReplaceNothing) {
  const auto loop = started(scenario_text(), {.threads = 2, .paused = true});
  folder_.write("out.yaml", "mine");
  EXPECT_EQ(answer_to([&](auto done) { loop->record("out.h5", done); }), "out.yaml is there already");
  folder_.write("other-head.h5", "mine");
  EXPECT_EQ(answer_to([&](auto done) { loop->record("other.h5", done); }), "other-head.h5 is there already");
  EXPECT_EQ(answer_to([&](auto done) { loop->record("out.png", done); }), "out.png: recordings end in .h5 or .mcap");
  EXPECT_EQ(answer_to([&](auto done) { loop->stop_recording(done); }), "nothing is being recorded");
}

TEST_F(LiveLoopTest, AnEndedRecordingIsToldWithFilesPingsAndBytes) {
  const auto loop = started(scenario_text());
  EXPECT_EQ(answer_to([&](auto done) { loop->record("out.h5", done); }), "");
  keeper_.wait_for_pings(7);
  EXPECT_EQ(answer_to([&](auto done) { loop->stop_recording(done); }), "");
  const std::vector<LiveRecording> told = keeper_.recordings();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0].files, ElementsAre("out-fls.h5", "out-head.h5"));
  EXPECT_EQ(told[0].scenario, "out.yaml");
  EXPECT_GE(told[0].pings, 5U);
  EXPECT_EQ(told[0].bytes, std::filesystem::file_size("out-fls.h5") + std::filesystem::file_size("out-head.h5"));
}

TEST_F(LiveLoopTest, ValuesThatARecordingHasCutAreToldAtItsEnd) {
  LiveOptions options{.threads = 2};
  options.messages.low_db = -200;
  options.messages.high_db = -150;
  const auto loop = started(scenario_text(), options);
  EXPECT_EQ(answer_to([&](auto done) { loop->record("out.mcap", done); }), "");
  keeper_.wait_for_pings(5);
  EXPECT_THAT(keeper_.notes(), IsEmpty());
  EXPECT_EQ(answer_to([&](auto done) { loop->stop_recording(done); }), "");
  ASSERT_EQ(keeper_.notes().size(), 2U);
  EXPECT_THAT(keeper_.notes()[0], testing::StartsWith("warning: out.mcap: "));
  EXPECT_THAT(keeper_.notes()[0], HasSubstr(" values of fls are above the highest level, -150 dB, and are cut there"));
  EXPECT_THAT(keeper_.notes()[1], HasSubstr(" values of head are above the highest level, -150 dB"));
}

// A session that is killed has what was written until then.
TEST_F(LiveLoopTest, TheScenarioIsBesideARecordingFromItsFirstPingOn) {
  const auto loop = started(scenario_text());
  loop->place({{0.2, -0.5, 0.3}, orientation_from_rpy(0, 0, 0.1)});
  EXPECT_EQ(answer_to([&](auto done) { loop->record("out.h5", done); }), "");
  keeper_.wait_for_pings(6);
  const Scenario scenario = load_scenario("out.yaml");
  EXPECT_NEAR(scenario.trajectory.at(0).position.y(), -0.5, 1e-6);
  EXPECT_GE(ScenarioRequests(scenario).ping_count(0), 1U);
  // Earlier files that are to be replaced stay until the end, with their scenario.
  EXPECT_EQ(answer_to([&](auto done) { loop->stop_recording(done); }), "");
  const auto size = std::filesystem::file_size("out.yaml");
  folder_.write("out-fls.h5", "mine");
  EXPECT_EQ(answer_to([&](auto done) { loop->record("out.h5", done, true); }), "");
  keeper_.wait_for_pings(6);
  EXPECT_EQ(std::filesystem::file_size("out.yaml"), size);
  int beside = 0;
  for (const auto& entry : std::filesystem::directory_iterator(".")) {
    const std::string name = entry.path().filename();
    beside += name.starts_with("out-fls.h5.") && name.ends_with(".yaml") ? 1 : 0;
  }
  EXPECT_EQ(beside, 1);
  EXPECT_EQ(answer_to([&](auto done) { loop->stop_recording(done); }), "");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator("."), {}), 5) << "nothing else is left";
}

TEST_F(LiveLoopTest, ARecordingThatCannotBeginLeavesNoFile) {
  const std::string name(200, 'n'), stem(46, 'o');  // Of the name with its ending .new, more than the system takes.
  const auto loop = started(scenario_text(), {.threads = 2}, {"sonars.head.name=" + name});
  const std::string error = answer_to([&](auto done) { loop->record(stem + ".h5", done); });
  EXPECT_THAT(error, HasSubstr("File name too long"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator("."), {}), 2) << "world and scenario";
}

// Of thousands of beams, whose tables take seconds.
TEST_F(LiveLoopTest, PingsGoOnWhileBeamsArePreparedAndTheEndDoesNotWaitForThem) {
  const auto loop = started(scenario_text());
  keeper_.wait_for_pings(2);
  const auto answer = std::make_shared<std::promise<std::string>>();
  std::future<std::string> told = answer->get_future();
  loop->set({"sonars.fls.beam_count=4000"}, [answer](const std::string& error) { answer->set_value(error); });
  for (int i = 0; i < 500 && !loop->state().preparing; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  keeper_.wait_for_pings(8);
  EXPECT_TRUE(loop->state().preparing);
  EXPECT_EQ(keeper_.last(0).ping.beam_count, 24);
  loop->end();
  EXPECT_EQ(told.get(), "the simulation ends");
}

TEST_F(LiveLoopTest, ARecordingReplacesOthersWhereThatIsAllowedAndNotWithoutAPing) {
  const auto loop = started(scenario_text());
  for (const char* name : {"out.yaml", "out.mcap", "none.yaml", "none-fls.h5", "none-head.h5"}) {
    folder_.write(name, "mine");
  }
  EXPECT_EQ(answer_to([&](auto done) { loop->record("out.mcap", done, true); }), "");
  EXPECT_EQ(std::filesystem::file_size("out.mcap"), 4U) << "the earlier one stays until the end";
  keeper_.wait_for_pings(4);
  EXPECT_EQ(answer_to([&](auto done) { loop->stop_recording(done); }), "");
  EXPECT_GT(std::filesystem::file_size("out.mcap"), 4U);
  EXPECT_GT(std::filesystem::file_size("out.yaml"), 4U);
  // It ends before its first ping: requests go before pings.
  const std::string stopped = answer_to([&](auto done) {
    loop->record(
        "none.h5", [&loop, done](const std::string& /*error*/) { loop->stop_recording(done); }, true);
  });
  EXPECT_EQ(stopped, "");
  const std::vector<LiveRecording> told = keeper_.recordings();
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].bytes, std::filesystem::file_size("out.mcap"));
  EXPECT_EQ(told[1].pings + told[1].bytes, 0U);
  for (const char* name : {"none.yaml", "none-fls.h5", "none-head.h5"}) {
    EXPECT_EQ(std::filesystem::file_size(name), 4U) << name << " stays";
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator("."), {}), 7) << "nothing else is left";
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

// A change of sonars alone, which a simulator takes in; and of the model, for which it is built anew.
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
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(keeper_.pings().size(), 2U) << "the first of both, to have something to show";
  loop->step();
  keeper_.wait_for_pings(1);
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
    loop.start(keeper);
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    loop.end();
    const std::vector<LivePing> pings = keeper.pings();
    const auto made = std::ranges::count(pings, 0, &LivePing::sonar);
    EXPECT_LE(made, 0.6 * most + 2.5);  // One at the start and one of rounding.
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

// As a wrecked file on a SIGINT would be.
TEST_F(LiveLoopTest, EndingClosesTheRecordingWhole) {
  const auto loop = started(scenario_text());
  EXPECT_EQ(answer_to([&](auto done) { loop->record("out.h5", done); }), "");
  keeper_.wait_for_pings(7);
  loop->end();
  EXPECT_EQ(loop->state().pings_made, keeper_.pings().size());
  const H5Reader file("out-fls.h5");
  const auto pings = pings_of(*loop);
  EXPECT_EQ(file.shape("intensity")[0], static_cast<hsize_t>(std::ranges::count(pings, 0, &LivePing::sonar)));
  EXPECT_EQ(answer_to([&](auto done) { loop->set({"seed=4"}, done); }), "the simulation ends");
}

}  // namespace
}  // namespace insonify
