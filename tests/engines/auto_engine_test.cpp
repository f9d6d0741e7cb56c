// auto_engine_test.cpp -- `engine: auto` on a card that fails: `cpu` goes on, and no ping is lost.

#include <gmock/gmock.h>

#include "engines/card_engine.h"
#include "support/message_of.h"

namespace insonify::auto_engine_test {
namespace {

using namespace testing_scenes;
using testing::ElementsAre;
using testing::StartsWith;

constexpr char kChosen[] = "engine: card on the card of the test, expected to make the samples of a ping";

TEST_F(AutoEngineTest, ACardComputesUntilTheEnd) {
  Simulator simulator = make(scenario("auto"));
  EXPECT_EQ(simulator.scenario().engine, "card");
  expect_pings_of_cpu(simulator);
  EXPECT_THAT(simulator.engine_choice(), StartsWith(kChosen));
  EXPECT_THAT(lines, ElementsAre());
  EXPECT_LT(card.batches, 1000);
}

TEST_F(AutoEngineTest, OnAMachineWithoutACardCpuComputes) {
  for (const std::string& device : device_texts()) {
    if (!device.starts_with("none: ") && device.find("computes on the processor") == std::string::npos) {
      GTEST_SKIP() << "there is a card: " << device;
    }
  }
  card.there = false;
  Simulator simulator = make(scenario("auto"));
  EXPECT_EQ(simulator.scenario().engine, "cpu");
  EXPECT_THAT(simulator.engine_choice(), StartsWith("engine: cpu, since "));
}

TEST_F(AutoEngineTest, FewPingsStartNoCard) {
  Simulator simulator = make(scenario("auto"), 2);
  EXPECT_EQ(simulator.scenario().engine, "cpu");
  EXPECT_EQ(card.starts, 1000);
  EXPECT_EQ(simulator.engine_choice(), "engine: cpu, since 2 pings are too few to start a graphics card for");
}

TEST_F(AutoEngineTest, CpuGoesOnInTheMiddleOfARun) {
  for (const EchoModel model : {EchoModel::kPaper, EchoModel::kCalibrated}) {
    for (const int batches : {0, 1}) {
      Simulator simulator = make(scenario("auto", model));
      card.batches = batches;
      expect_pings_of_cpu(simulator, model);
      EXPECT_EQ(simulator.scenario().engine, "cpu");
      EXPECT_THAT(lines, ElementsAre("device \"card\" was lost: a batch; engine cpu goes on"));
    }
  }
}

TEST_F(AutoEngineTest, CpuGoesOnWhereverElseTheCardFails) {
  const std::pair<int CardState::*, std::string> calls[] = {
      {&CardState::starts, "its start"}, {&CardState::scenes, "a scene"}, {&CardState::traces, "rays"}};
  for (const auto& [left, what] : calls) {
    card = {.there = true};
    card.*left = 0;
    Simulator simulator = make(scenario("auto"));
    expect_pings_of_cpu(simulator);
    EXPECT_EQ(simulator.scenario().engine, "cpu");
    EXPECT_THAT(lines, ElementsAre("device \"card\" was lost: " + what + "; engine cpu goes on"));
  }
}

// Cameras trace rays between pings.
TEST_F(AutoEngineTest, CamerasGoOnToo) {
  Simulator simulator = make(scenario("auto")), host = make(scenario("cpu"));
  PingRequest request;
  request.moved = {{.name = "ball", .world_from_object = {.position = {4, 0, 0}}}};
  const std::vector<Ray> ray = {{.origin = Vec3::Zero(), .direction = Vec3::UnitX()}};
  std::vector<Hit> hit(1), expected(1);
  simulator.place(0, request);
  host.place(0, request);
  card.traces = 0;
  simulator.engine().trace(ray, hit);
  host.engine().trace(ray, expected);
  EXPECT_EQ(hit[0].instance, kBall);
  EXPECT_EQ(hit[0].distance, expected[0].distance);
  expect_pings_of_cpu(simulator);
  EXPECT_EQ(simulator.scenario().engine, "cpu");
}

TEST_F(AutoEngineTest, TheEngineThatWasAskedForEndsWithTheError) {
  Simulator simulator = make(scenario("card"));
  card.batches = 1;
  (void)simulator.ping(0, {});
  EXPECT_EQ(message_of([&] { (void)simulator.ping(0, {}); }), "device \"card\" was lost: a batch");
  EXPECT_EQ(simulator.engine_choice(), "");
  EXPECT_THAT(lines, ElementsAre());
}

}  // namespace
}  // namespace insonify::auto_engine_test
