// live_recording_test.cpp -- recording pings while they are steered and changed; what is saved repeats the flight.

#include <gmock/gmock.h>

#include <future>
#include <thread>

#include "io/h5_read.h"
#include "live/live_loop_fixture.h"

namespace insonify::live_recording_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class LiveRecordingTest : public LiveLoopFixture {};

class LiveMotionTest : public LiveRecordingTest, public testing::WithParamInterface<bool> {};
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

TEST_F(LiveRecordingTest, ChangesDuringARecordingBeginAnotherFile) {
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
TEST_F(LiveRecordingTest, RequestsAtOnceBeginOneRecordingAndDoTheOtherChanges) {
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

TEST_F(LiveRecordingTest, RecordingsReplaceNothing) {
  const auto loop = started(scenario_text(), {.threads = 2, .paused = true});
  folder_.write("out.yaml", "mine");
  EXPECT_EQ(answer_to([&](auto done) { loop->record("out.h5", done); }), "out.yaml exists already");
  folder_.write("other-head.h5", "mine");
  EXPECT_EQ(answer_to([&](auto done) { loop->record("other.h5", done); }), "other-head.h5 exists already");
  EXPECT_EQ(answer_to([&](auto done) { loop->record("out.png", done); }), "out.png: recordings end in .h5 or .mcap");
  EXPECT_EQ(answer_to([&](auto done) { loop->stop_recording(done); }), "nothing is being recorded");
}

// A recording begins in another thread than the one that ends it.
TEST_F(LiveRecordingTest, RequestsToRecordAndToStopAreCarriedOutInTheirOrder) {
  const auto loop = started(scenario_text(), {.threads = 2, .paused = true});
  std::vector<std::promise<std::string>> answers(4);
  const auto to = [&](std::size_t i) {
    return [&answers, i](const std::string& error) { answers[i].set_value(error); };
  };
  loop->record("a.h5", to(0));
  loop->stop_recording(to(1));
  loop->record("b.mcap", to(2));
  loop->stop_recording(to(3));
  for (std::promise<std::string>& answer : answers) {
    EXPECT_EQ(answer.get_future().get(), "");
  }
  EXPECT_EQ(loop->state().recording, "");
  EXPECT_EQ(keeper_.recordings().size(), 2U);
}

TEST_F(LiveRecordingTest, AnEndedRecordingIsToldWithFilesPingsAndBytes) {
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
  EXPECT_EQ(loop->state().recorded_pings, 0U) << "nothing is being recorded";
}

TEST_F(LiveRecordingTest, ValuesThatARecordingHasCutAreToldAtItsEnd) {
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
  EXPECT_THAT(keeper_.notes()[0], HasSubstr(" values of fls are above the highest level, -150 dB, and are clipped"));
  EXPECT_THAT(keeper_.notes()[1], HasSubstr(" values of head are above the highest level, -150 dB"));
}

// A session that is killed has what was written until then.
TEST_F(LiveRecordingTest, TheScenarioIsBesideARecordingFromItsFirstPingOn) {
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

TEST_F(LiveRecordingTest, ARecordingThatCannotBeginLeavesNoFile) {
  const std::string name(200, 'n'), stem(46, 'o');  // With the ending .new the name is longer than the system takes.
  const auto loop = started(scenario_text(), {.threads = 2}, {"sonars.head.name=" + name});
  const std::string error = answer_to([&](auto done) { loop->record(stem + ".h5", done); });
  EXPECT_THAT(error, HasSubstr("File name too long"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator("."), {}), 2) << "world and scenario";
}

// The tables of thousands of beams take seconds.
TEST_F(LiveRecordingTest, PingsGoOnWhileBeamsArePreparedAndTheEndDoesNotWaitForThem) {
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

// As many as a client can send in a second, each of which takes milliseconds to refuse.
TEST_F(LiveRecordingTest, RequestsThatWaitAreLimitedAndTheEndOnlyAnswersThem) {
  const auto loop = started(scenario_text());
  constexpr int kRequests = 4000;
  std::mutex mutex;
  std::map<std::string, int> answers;
  for (int i = 0; i < kRequests; ++i) {
    loop->set({"no_such_key=4"}, [&](const std::string& error) {
      const std::lock_guard lock(mutex);
      ++answers[error];
    });
  }
  loop->end();
  EXPECT_GT(answers["too many requests wait for an answer"], 0);
  EXPECT_GT(answers["the simulation ends"], 0);
  int all = 0;
  for (const auto& [error, count] : answers) {
    EXPECT_NE(error, "");
    all += count;
  }
  EXPECT_EQ(all, kRequests);
}

TEST_F(LiveRecordingTest, ARecordingReplacesOthersWhereThatIsAllowedAndNotWithoutAPing) {
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

// As a wrecked file on a SIGINT would be.
TEST_F(LiveRecordingTest, EndingClosesTheRecordingWhole) {
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
}  // namespace insonify::live_recording_test
