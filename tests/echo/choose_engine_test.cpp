// choose_engine_test.cpp -- which engine `auto` takes, by the load alone and by what the machine has.

#include "echo/choose_engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "insonify/error.h"

namespace insonify::choose_engine_test {
namespace {

using testing::HasSubstr;

// As measured: bench/README.md, "On a graphics card".
constexpr PingLoad kMeasured{.beams = 256, .samples = 256 * 4 * 200, .triangles = 98454, .threads = 16};

PingLoad with_threads(int threads) {
  PingLoad load = kMeasured;
  load.threads = threads;
  return load;
}

// 256 x 4 x 200 samples, cube root of 98 454: 46.2. 3 ns x 46.2 x 204 800 / 16 = 1.77 ms; 0.4 ms + 3 ns x 204 800.
TEST(ChooseEngineTest, TimesAreThoseWorkedOutByHand) {
  const ExpectedTimes times = expected_times(kMeasured);
  EXPECT_NEAR(times.host, 1.77e-3, 0.01e-3);
  EXPECT_NEAR(times.device, 1.014e-3, 0.001e-3);
}

// Measured in the calibrated model: 186 pings a second and 206 with 98 454 triangles, 284 and 238 with 802.
TEST(ChooseEngineTest, ADeviceIsTakenWhereItWasMeasuredToBeFaster) {
  PingLoad load = kMeasured;
  EXPECT_EQ(against_device(load), std::nullopt);
  load.triangles = 991632;
  EXPECT_EQ(against_device(load), std::nullopt);
  load.triangles = 802;
  EXPECT_EQ(against_device(load).value_or(""),
            "16 threads make the samples of a ping in about 0.36 ms, a graphics card in 1 ms");
}

TEST(ChooseEngineTest, FewerThreadsSpeakForADevice) {
  PingLoad load = with_threads(2);
  load.triangles = 802;
  EXPECT_EQ(against_device(load), std::nullopt);
  EXPECT_EQ(against_device(with_threads(1)), std::nullopt);
  EXPECT_NE(against_device(with_threads(128)), std::nullopt);
}

TEST(ChooseEngineTest, ASingleBeamStaysOnTheHost) {
  PingLoad load = with_threads(1);
  load.beams = 1;
  EXPECT_EQ(against_device(load).value_or(""),
            "the single beam of a scanning head is too little work for a graphics card");
}

TEST(ChooseEngineTest, SmallFansStayOnTheHost) {
  const PingLoad load{.beams = 16, .samples = 16 * 4 * 50, .triangles = 98454, .threads = 2};
  EXPECT_EQ(against_device(load).value_or(""),
            "2 threads make the samples of a ping in about 0.22 ms, a graphics card in 0.41 ms");
}

// 1.77 - 1.01 ms are saved a ping: 0.3 s, which the start takes, by 395 of them.
TEST(ChooseEngineTest, FewPingsStayOnTheHost) {
  PingLoad load = kMeasured;
  load.pings = 390;
  EXPECT_EQ(against_device(load).value_or(""), "390 pings are too few to start a graphics card for");
  load.pings = 400;
  EXPECT_EQ(against_device(load), std::nullopt);
}

// Engines that say what they find.
int searches = 0;
constexpr EngineKind kNoCard{.name = "no card", .find_hardware = [](std::string_view) -> std::string {
                               ++searches;
                               throw Error("no card lies in the slot");
                             }};
constexpr EngineKind kCard{.name = "card", .find_hardware = [](std::string_view device) {
                             ++searches;
                             return "a card named " + std::string(device);
                           }};

// One after the other, as kinds cannot be taken away.
TEST(ChooseEngineTest, TheLineSaysWhatWasFound) {
  EXPECT_EQ(choose_engine(PingLoad{.beams = 1}, "").text,
            "engine: cpu, since the single beam of a scanning head is too little work for a graphics card");
  add_engine_kind(kNoCard);
  const EngineChoice without = choose_engine(kMeasured, "");
  EXPECT_EQ(without.kind->name, "cpu");
  EXPECT_THAT(without.text, HasSubstr("engine: cpu, since "));
  EXPECT_EQ(searches, 1);

  add_engine_kind(kCard);
  const EngineChoice with = choose_engine(kMeasured, "ACME");
  EXPECT_EQ(with.kind, &kCard);
  EXPECT_EQ(
      with.text,
      "engine: card on a card named ACME, expected to make the samples of a ping 1.7 times as fast as 16 threads");
}

TEST(ChooseEngineTest, NothingIsSearchedWhereTheLoadDecides) {
  add_engine_kind(kCard);
  searches = 0;
  PingLoad load = kMeasured;
  load.pings = 1;
  EXPECT_EQ(choose_engine(load, "").text, "engine: cpu, since 1 ping is too few to start a graphics card for");
  EXPECT_EQ(searches, 0);
}

}  // namespace
}  // namespace insonify::choose_engine_test
