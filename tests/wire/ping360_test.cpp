// ping360_test.cpp -- commands of a Ping360: what they set, what they are answered with, and what is refused.

#include "insonify/wire/ping360.h"

#include <gmock/gmock.h>

#include <random>

namespace insonify::ping360_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Bytes = std::vector<std::uint8_t>;

// transducer: mode 1, gain 2, angle 313 = 0x139, 45 us, period 91, 755 kHz = 0x2f3, 260 = 0x104 samples, transmit.
const PingFrame kTransducer{.id = 2601, .payload = {1, 2, 0x39, 1, 45, 0, 91, 0, 0xf3, 2, 4, 1, 1, 0}};
// auto_transmit: the same, from 390 = 0x186 to 9, steps of 4, 7 ms between pings.
const PingFrame kScan{.id = 2602, .payload = {1, 2, 45, 0, 91, 0, 0xf3, 2, 4, 1, 0x86, 1, 9, 0, 4, 7}};

PingFrame request(std::uint16_t id) {
  return {.id = 6, .payload = {static_cast<std::uint8_t>(id & 255), static_cast<std::uint8_t>(id >> 8)}};
}

std::string nack_of(const Ping360Answer& answer) {
  if (answer.frames.size() != 1 || answer.frames[0].id != 2) {
    return "no NACK";
  }
  return {answer.frames[0].payload.begin() + 2, answer.frames[0].payload.end()};
}

TEST(Ping360Test, TellsWhatItIsWhenAsked) {
  Ping360 sonar;
  for (const PingFrame& asked : {request(4), PingFrame{.id = 4}}) {
    const Ping360Answer answer = sonar.take(asked);
    ASSERT_EQ(answer.frames.size(), 1U);
    EXPECT_EQ(answer.frames[0].id, 4);
    EXPECT_THAT(answer.frames[0].payload, ElementsAre(2, 0, 3, 3, 8, 0));
  }
  EXPECT_THAT(sonar.take(request(5)).frames.at(0).payload, ElementsAre(1, 0, 0, 0));
  EXPECT_EQ(sonar.take(request(2300)).frames.at(0).id, 2300);
  EXPECT_EQ(nack_of(sonar.take(request(1211))), "unknown message");
}

TEST(Ping360Test, IntroducesItselfInFourLines) {
  EXPECT_EQ(ping360_introduction({192, 168, 2, 45}),
            "SONAR PING360\r\nBlue Robotics\r\nMAC Address:- 02-00-00-00-00-01\r\nIP Address:- 192.168.002.045\r\n");
}

TEST(Ping360Test, ATransducerMessageSetsAllAndTransmits) {
  Ping360 sonar;
  const Ping360Answer answer = sonar.take(kTransducer);
  EXPECT_TRUE(answer.transmit);
  EXPECT_THAT(answer.frames, IsEmpty());
  EXPECT_EQ(sonar.settings(), (Ping360Settings{1, 2, 313, 45, 91, 755, 260}));
  // 91 x 25 ns = 2.275 us.
  EXPECT_DOUBLE_EQ(sonar.settings().sample_interval(), 2.275e-6);
  const PingFrame data = sonar.data(Bytes{8, 9});
  EXPECT_EQ(data.id, 2300);
  EXPECT_THAT(data.payload, ElementsAre(1, 2, 0x39, 1, 45, 0, 91, 0, 0xf3, 2, 4, 1, 2, 0, 8, 9));
}

TEST(Ping360Test, WithoutTransmitTheDataAreEmpty) {
  Ping360 sonar;
  PingFrame quiet = kTransducer;
  quiet.payload[12] = 0;
  const Ping360Answer answer = sonar.take(quiet);
  EXPECT_FALSE(answer.transmit);
  ASSERT_EQ(answer.frames.size(), 1U);
  EXPECT_THAT(answer.frames[0].payload, ElementsAre(1, 2, 0x39, 1, 45, 0, 91, 0, 0xf3, 2, 4, 1, 0, 0));
}

TEST(Ping360Test, ValuesOutOfLimitsAreRefusedAndChangeNothing) {
  struct Case {
    std::size_t at;
    std::uint8_t low, high;
    const char* reason;
  };
  for (const Case& wrong :
       {Case{1, 3, 0x39, "gain_setting = 3 must be from 0 to 2"}, Case{2, 0x90, 1, "angle = 400 must be from 0 to 399"},
        Case{4, 0, 0, "transmit_duration = 0 must be from 1 to 1000"},
        Case{6, 79, 0, "sample_period = 79 must be from 80 to 40000"},
        Case{8, 0xe9, 3, "transmit_frequency = 1001 must be from 500 to 1000"},
        Case{10, 199, 0, "number_of_samples = 199 must be from 200 to 1200"},
        Case{10, 0xb1, 4, "number_of_samples = 1201 must be from 200 to 1200"},
        Case{12, 2, 0, "transmit = 2 must be from 0 to 1"}}) {
    Ping360 sonar;
    PingFrame frame = kTransducer;
    frame.payload[wrong.at] = wrong.low;
    frame.payload[wrong.at + 1] = wrong.high;
    EXPECT_EQ(nack_of(sonar.take(frame)), wrong.reason);
    EXPECT_EQ(sonar.settings(), Ping360Settings());
  }
  Ping360 sonar;
  PingFrame frame = kTransducer;
  frame.payload.pop_back();
  EXPECT_EQ(nack_of(sonar.take(frame)), "payload has 13 bytes, must have 14");
}

TEST(Ping360Test, AScanTellsItsSectorAndEndsWithTheMotor) {
  Ping360 sonar;
  EXPECT_TRUE(sonar.take(kScan).scan_changed);
  sonar.turn_to(1);
  EXPECT_EQ(sonar.take(request(2300)).frames.at(0).id, 2300);
  EXPECT_EQ(sonar.take(request(2301)).frames.at(0).id, 2301);
  const PingFrame data = sonar.data({});
  EXPECT_EQ(data.id, 2301);
  EXPECT_THAT(data.payload, ElementsAre(1, 2, 394 & 255, 1, 45, 0, 91, 0, 0xf3, 2, 0x86, 1, 9, 0, 4, 7, 4, 1, 0, 0));
  const Ping360Answer answer = sonar.take(PingFrame{.id = 2903});
  EXPECT_TRUE(answer.scan_changed);
  EXPECT_EQ(answer.frames.at(0).id, 1);
  EXPECT_THAT(answer.frames.at(0).payload, ElementsAre(2903 & 255, 2903 >> 8));
  EXPECT_FALSE(sonar.sector());
  EXPECT_EQ(nack_of(sonar.take(request(2301))), "the sonar is not scanning");
  EXPECT_FALSE(sonar.take(PingFrame{.id = 2903}).scan_changed);
}

TEST(Ping360Test, ABreakATransducerMessageAndAResetEndAScan) {
  for (const PingEvent& event : {PingEvent{.kind = PingEvent::Kind::kBreak}, PingEvent{.frame = kTransducer},
                                 PingEvent{.frame = {.id = 2600, .payload = {0, 0}}}}) {
    Ping360 sonar;
    ASSERT_TRUE(sonar.take(kScan).scan_changed);
    EXPECT_TRUE(sonar.take(event).scan_changed);
    EXPECT_FALSE(sonar.sector());
  }
}

TEST(Ping360Test, ASectorIsSweptToAndFroAcrossZero) {
  // From 390 to 9 are 19 gradians: whole steps of 4 up to 6.
  const Ping360Sector sector{.start_angle = 390, .stop_angle = 9, .step = 4};
  std::vector<int> angles;
  for (std::uint64_t ping = 0; ping < 10; ++ping) {
    angles.push_back(sector.angle_at(ping));
  }
  EXPECT_THAT(angles, ElementsAre(390, 394, 398, 2, 6, 2, 398, 394, 390, 394));
}

TEST(Ping360Test, ASectorOfMoreThanHalfATurnIsSweptOneWay) {
  // From 300 to 150 are 250 gradians: whole steps of 100 up to 100. From 300 to 100 are 200, half a turn.
  const Ping360Sector wide{.start_angle = 300, .stop_angle = 150, .step = 100};
  const Ping360Sector half{.start_angle = 300, .stop_angle = 100, .step = 100};
  std::vector<int> wide_angles, half_angles;
  for (std::uint64_t ping = 0; ping < 5; ++ping) {
    wide_angles.push_back(wide.angle_at(ping));
    half_angles.push_back(half.angle_at(ping));
  }
  EXPECT_THAT(wide_angles, ElementsAre(300, 0, 100, 300, 0));
  EXPECT_THAT(half_angles, ElementsAre(300, 0, 100, 0, 300));
}

// Time of `pings` pings of a scan of the whole circle [s]: turning, listening and reading out.
double time_of_scan(int pings, std::uint8_t step, double range) {
  // 1000 samples; sound travels 1500 m/s, there and back.
  const Ping360Settings settings{.sample_period = static_cast<std::uint16_t>(2 * range / 1500 / 1000 / 25e-9),
                                 .sample_count = 1000};
  const Ping360Sector circle{.start_angle = 0, .stop_angle = 399, .step = step};
  double time = 0;
  for (int ping = 1; ping <= pings; ++ping) {
    const auto n = static_cast<std::uint64_t>(ping);
    time +=
        ping360_turn_time(circle.angle_at(n - 1), circle.angle_at(n)) + settings.listening_time() + kPing360ReadoutTime;
  }
  return time;
}

TEST(Ping360Test, ATurnTakesTheTimeOfTheInstrument) {
  // Timed by a user, discuss.bluerobotics.com 8328. One turn was timed each; 1.5 % covers the three.
  constexpr double kShare = 0.015;
  EXPECT_NEAR(time_of_scan(400, 1, 2), 10.74, kShare * 10.74);
  EXPECT_NEAR(time_of_scan(400, 1, 20), 20.57, kShare * 20.57);
  EXPECT_NEAR(time_of_scan(40, 10, 2), 3.29, kShare * 3.29);
}

TEST(Ping360Test, TheHeadTurnsTheShorterWay) {
  EXPECT_EQ(ping360_turn_time(7, 7), 0);
  // 390 to 10 are 20 gradians across 0; nothing is further than half a turn.
  EXPECT_DOUBLE_EQ(ping360_turn_time(390, 10), 20 * kPing360StepTime);
  EXPECT_DOUBLE_EQ(ping360_turn_time(10, 390), 20 * kPing360StepTime);
  EXPECT_DOUBLE_EQ(ping360_turn_time(0, 201), 199 * kPing360StepTime);
}

TEST(Ping360Test, AFullCircleGoesOn) {
  const Ping360Sector sector{.start_angle = 0, .stop_angle = 399, .step = 3};
  // 133 x 3 = 399, and then 402 = 2.
  EXPECT_EQ(sector.angle_at(133), 399);
  EXPECT_EQ(sector.angle_at(134), 2);
  EXPECT_EQ(sector.angle_at(400), 0);
  EXPECT_EQ((Ping360Sector{.start_angle = 17, .stop_angle = 17, .step = 2}).angle_at(5), 17);
}

TEST(Ping360Test, TheDeviceIdDecidesWhichFramesAreAnswered) {
  Ping360 sonar;
  EXPECT_EQ(sonar.take(PingFrame{.id = 2000, .payload = {42, 0}}).frames.at(0).id, 1);
  EXPECT_THAT(sonar.take(request(2000)).frames.at(0).payload, ElementsAre(42, 0));
  PingFrame asked = request(5);
  asked.destination = 41;
  EXPECT_THAT(sonar.take(asked).frames, IsEmpty());
  for (const std::uint8_t destination : {42, 0, 255}) {
    asked.destination = destination;
    EXPECT_EQ(sonar.take(asked).frames.at(0).source, 42);
  }
  EXPECT_EQ(nack_of(sonar.take(PingFrame{.id = 2000, .payload = {255, 0}})), "id = 255 must be from 1 to 254");
}

TEST(Ping360Test, AnswersOfOthersAreNotAnswered) {
  Ping360 sonar;
  EXPECT_THAT(sonar.take(sonar.refusal(2601, "x")).frames, IsEmpty());
}

TEST(Ping360Test, RandomPayloadsLeaveSettingsWithinLimits) {
  std::mt19937 random(73);
  Ping360 sonar;
  int refused = 0, accepted = 0;
  for (int round = 0; round < 20000; ++round) {
    PingFrame frame = round % 2 == 0 ? kTransducer : kScan;
    for (std::uint32_t change = random() % 3; change > 0; --change) {
      frame.payload[random() % frame.payload.size()] = static_cast<std::uint8_t>(random());
    }
    const Ping360Answer answer = sonar.take(frame);
    nack_of(answer) == "no NACK" ? ++accepted : ++refused;
    const Ping360Settings& now = sonar.settings();
    ASSERT_LT(now.angle, 400);
    ASSERT_LE(now.gain_setting, 2);
    ASSERT_GE(now.sample_period, 80);
    ASSERT_TRUE(now.sample_count >= 200 && now.sample_count <= 1200);
    if (sonar.sector()) {
      sonar.turn_to(random());
      ASSERT_LT(now.angle, 400);
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(accepted, 1000);
}

}  // namespace
}  // namespace insonify::ping360_test
