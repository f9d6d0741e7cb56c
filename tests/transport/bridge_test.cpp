// bridge_test.cpp -- pings of a live scenario as messages on a transport that records them.

#include "transport/bridge.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <future>
#include <map>
#include <mutex>
#include <utility>

#include "console/outcome.h"
#include "support/message_of.h"
#include "transport/bridge_kit.h"

namespace insonify::bridge_test {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST_F(BridgeTest, SendsEveryPingInOrder) {
  const auto bridge = this->bridge();
  bridge->start();
  const std::vector<Sent> images = transport_.wait_for(MessageKind::kSonarImage, 20);
  bridge->end();
  for (std::size_t i = 0; i < images.size(); ++i) {
    EXPECT_EQ(sequence(images[i]), i);
    EXPECT_TRUE(i == 0 || images[i].time_ns > images[i - 1].time_ns);
  }
  EXPECT_THAT(bridge->report().text(), AllOf(HasSubstr("Hz"), Not(HasSubstr("dropped"))));
}

TEST_F(BridgeTest, OpensAndTellsTheScenarioBeforeThereIsAPing) {
  const auto bridge = this->bridge({.driven = true});
  bridge->start();
  EXPECT_EQ(transport_.wait_for(MessageKind::kScenario, 1).size(), 1U);
  EXPECT_EQ(transport_.opened(), 1);
  bridge->end();
  EXPECT_EQ(transport_.all().size(), 1U);
}

TEST_F(BridgeTest, WhatNobodyReadsIsNotSent) {
  transport_.read.reset();
  const auto bridge = this->bridge();
  bridge->start();
  wait_for_pings(*bridge, 3);
  bridge->end();
  EXPECT_EQ(transport_.all().size(), 1U);  // The scenario.
}

// A ping takes 60 ms to be sent, and one comes each 10 ms: five wait at most, and all others are counted. With a queue,
// what is sent would fall behind for ever.
TEST_F(BridgeTest, ATransportThatIsTooSlowMakesNoQueue) {
  transport_.takes = std::chrono::milliseconds(60);
  const auto bridge = this->bridge();
  bridge->start();
  std::vector<Sent> images = transport_.wait_for(MessageKind::kSonarImage, 8);
  std::uint64_t made = bridge->loop().state().pings_made;
  while (made - sequence(images.back()) > LiveSender::kMostWaiting + 8 && images.size() < 100) {
    images = transport_.wait_for(MessageKind::kSonarImage, images.size() + 1);
    made = bridge->loop().state().pings_made;
  }
  bridge->end();
  EXPECT_LE(made - sequence(images.back()), LiveSender::kMostWaiting + 8);
  EXPECT_GT(sequence(images.back()), 12U);
  const std::string text = bridge->report().text();
  const std::size_t end = text.find(" pings dropped");
  ASSERT_NE(end, std::string::npos) << text;
  const double dropped = std::stod(text.substr(text.rfind(' ', end - 1)));
  EXPECT_GE(dropped, sequence(images.back()) + 1.0 - static_cast<double>(images.size()));
}

TEST_F(BridgeTest, NoPingIsMadeWhileChannelsAreOpened) {
  const auto bridge = this->bridge();
  std::uint64_t made = 1;
  transport_.on_open = [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // 30 pings.
    made = bridge->loop().state().pings_made;
  };
  bridge->start();
  (void)transport_.wait_for(MessageKind::kSonarImage, 1);
  bridge->end();
  EXPECT_EQ(made, 0U);
}

TEST_F(BridgeTest, SurvivesATransportThatFails) {
  transport_.fails = 3;
  const auto bridge = this->bridge();
  testing::internal::CaptureStderr();
  bridge->start();
  const std::vector<Sent> images = transport_.wait_for(MessageKind::kSonarImage, 2);
  bridge->end();
  EXPECT_GE(sequence(images.front()), 3U);  // More where pings are dropped, which a busy machine has no time to send.
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "insonify: the transport is closed\n");  // Once.
}

TEST_F(BridgeTest, WhatIsLatchedIsSentOnceBeforeThePings) {
  BridgeOptions options{.scenario = "dive.yaml", .quiet = true};
  options.messages.live = true;
  options.messages.vehicle_frame = "base_link";
  Bridge bridge(options, transport_, MessageForm::kRos1);
  bridge.start();
  (void)transport_.wait_for(MessageKind::kSonarImage, 3);
  bridge.end();
  const std::vector<Sent> sent = transport_.all();
  for (const MessageKind kind : {MessageKind::kScenario, MessageKind::kDescription, MessageKind::kTransforms}) {
    EXPECT_EQ(transport_.wait_for(kind, 1).size(), 1U);
  }
  ASSERT_GE(sent.size(), 6U);
  EXPECT_EQ(transport_.wait_for(MessageKind::kSonarImage, 3).front().message, sent[3].message);
}

TEST_F(BridgeTest, MessagesHaveTheStampOfThePose) {
  const auto bridge = this->bridge({.driven = true});
  bridge->start();
  const Pose pose{Vec3(0.5, 0, 0), Eigen::Quaterniond::Identity()};
  bridge->loop().drive({.world_from_vehicle = pose, .stamp = 70});
  const std::vector<Sent> images = transport_.wait_for(MessageKind::kSonarImage, 3);
  EXPECT_EQ(images[0].time_ns, 70'000'000'000U);
  for (std::size_t i = 1; i < images.size(); ++i) {  // From the same pose, later.
    EXPECT_NEAR(1e-9 * static_cast<double>(images[i].time_ns), 70.0 + 0.01 * static_cast<double>(i), 2.0);
    EXPECT_GT(images[i].time_ns, images[i - 1].time_ns);
  }
}

TEST_F(BridgeTest, NoPingIsSentBeforeItsLastEchoIsBack) {
  folder_.write("dive.yaml", std::string("water: {sound_speed: 1500}\n") + kScenario);
  const auto bridge = this->bridge({.clocked = true});
  bridge->start();
  bridge->loop().advance(70);
  wait_for_pings(*bridge, 1);
  // 6 m and back at 1500 m/s are 8 ms.
  bridge->loop().advance(70.0079);
  EXPECT_TRUE(transport_.wait_for(MessageKind::kSonarImage, 0).empty());
  bridge->loop().advance(70.0081);
  EXPECT_EQ(transport_.wait_for(MessageKind::kSonarImage, 1).back().time_ns, 70'000'000'000U);
  // A clock that is set back releases what would wait for long.
  bridge->loop().advance(70.0101);
  wait_for_pings(*bridge, 2);
  bridge->loop().advance(3);
  EXPECT_EQ(transport_.wait_for(MessageKind::kSonarImage, 2).size(), 2U);
}

// A sonar that hears up to 100 m.
constexpr const char* kFar = R"(world: none
sonars:
  - {name: fls, beam_count: 4, bin_count: 30, max_range: 100, assumed_sound_speed: 1500, ping_period: 0.2,
     sampling: {columns_per_beam: 1, rows: 4}}
)";

// Mean time from transmission to message [ms].
double latency(const Bridge& bridge) {
  const std::string text = bridge.report().text();
  return std::stod(text.substr(text.find("; ") + 2));
}

TEST_F(BridgeTest, ByTheWallClockPingsWaitToo) {
  folder_.write("dive.yaml", kFar);
  const auto bridge = this->bridge();
  bridge->start();
  transport_.wait_for(MessageKind::kSonarImage, 1);
  bridge->end();
  EXPECT_GT(latency(*bridge), 133.3);  // 200 m.
}

TEST_F(BridgeTest, AtOncePingsDoNotWait) {
  folder_.write("dive.yaml", kFar);
  const auto bridge = this->bridge({}, true);
  bridge->start();
  transport_.wait_for(MessageKind::kSonarImage, 1);
  bridge->end();
  EXPECT_LT(latency(*bridge), 133.3);  // 1 ms on an idle machine.
}

TEST_F(BridgeTest, StampsBeginAfterZero) {
  const auto bridge = this->bridge({.driven = true, .clocked = true}, true);
  bridge->start();
  bridge->loop().drive({.world_from_vehicle = {}, .stamp = 0});
  bridge->loop().advance(0);
  EXPECT_EQ(transport_.wait_for(MessageKind::kSonarImage, 1).back().time_ns, 1U);
}

TEST_F(BridgeTest, WithAClockMessagesHaveItsTime) {
  const auto bridge = this->bridge({.clocked = true}, true);
  bridge->start();
  for (int i = 0; i < 3; ++i) {
    bridge->loop().advance(500 + 0.01 * i);
    EXPECT_NEAR(
        1e-9 * static_cast<double>(
                   transport_.wait_for(MessageKind::kSonarImage, static_cast<std::size_t>(i) + 1).back().time_ns),
        500 + 0.01 * i, 1e-6);
  }
}

TEST_F(BridgeTest, GainLowersTheLevelsOfValues) {
  const auto bridge = this->bridge();
  bridge->start();
  const std::vector<std::byte> before = transport_.wait_for(MessageKind::kSonarImage, 1).back().message;
  bridge->set_gain(0, 12);
  const std::size_t so_far = transport_.all().size();
  const std::vector<std::byte> after = transport_.wait_for(MessageKind::kSonarImage, so_far + 6).back().message;
  ASSERT_EQ(after.size(), before.size());
  const auto sum = [](const std::vector<std::byte>& message) {  // Sum of the values, the last field.
    double all = 0;
    for (std::size_t i = message.size() - 2 * 12 * 30; i < message.size(); i += 2) {
      std::uint16_t value = 0;
      std::memcpy(&value, &message[i], sizeof value);
      all += value;
    }
    return all;
  };
  EXPECT_GT(sum(after), sum(before));
}

TEST_F(BridgeTest, EndsWhileAPingIsMade) {
  folder_.write("dive.yaml",
                "world: wall.obj\nsonars:\n  - {name: slow, beam_count: 1024, bin_count: 2000, max_range: 40, "
                "sampling: {columns_per_beam: 64, rows: 4096}}\n");
  folder_.write("wall.obj", "v 5 -90 -90\nv 5 90 -90\nv 5 0 90\nf 1 2 3\n");
  const auto bridge = this->bridge();
  bridge->start();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(bridge->loop().state().pings_made, 0U);
  const Clock::time_point start = Clock::now();
  bridge->end();
  EXPECT_LT(seconds_since(start), 10);  // The ping takes longer; 0.1 s on an idle machine.
}

TEST_F(BridgeTest, WrongInputIsToldAsSuch) {
  folder_.write("dive.yaml", "world: none\nsonars: [{name: fls, max_rnage: 3}]\n");
  EXPECT_THROW((void)bridge(), InputError);
  EXPECT_THAT(message_of([&] { (void)bridge(); }), HasSubstr("max_rnage"));
}

}  // namespace
}  // namespace insonify::bridge_test
