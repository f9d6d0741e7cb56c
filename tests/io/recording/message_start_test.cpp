// message_start_test.cpp -- times of ISO 8601 as starts of runs, and stamps of messages counted from them.

#include <gtest/gtest.h>

#include "insonify/messages.h"
#include "io/cdr_read.h"
#include "support/message_of.h"

namespace insonify::message_start_test {
namespace {

constexpr std::uint64_t kSecond = 1'000'000'000;

// 56 years of 365 days from 1970 on, the 14 leap days of 1972 to 2024, 31 + 28 + 31 + 30 + 31 days until June, 10
// hours.
constexpr std::uint64_t kJune = ((56 * 365 + 14 + 151) * 24 + 10) * 3600 * kSecond;

TEST(MessageStartTest, ReadsTimesWithTheirZones) {
  EXPECT_EQ(start_from_text("2026-06-01T10:00:00Z"), kJune);
  EXPECT_EQ(start_from_text("2026-06-01T10:00Z"), kJune);
  EXPECT_EQ(start_from_text("2026-06-01T12:00:00.25+02:00"), kJune + kSecond / 4);
  EXPECT_EQ(start_from_text("2026-06-01T06:30:00.000000001-03:30"), kJune + 1);
  EXPECT_EQ(start_from_text("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(start_from_text("2024-02-29T23:59:59Z") + kSecond, start_from_text("2024-03-01T00:00:00Z"));
  EXPECT_EQ(start_from_text("2038-01-19T03:14:07.999999999Z"), (kSecond << 31U) - 1);
}

TEST(MessageStartTest, WritesThemInUtc) {
  EXPECT_EQ(start_text(kJune), "2026-06-01T10:00:00Z");
  EXPECT_EQ(start_text(kJune + kSecond / 4), "2026-06-01T10:00:00.25Z");
  EXPECT_EQ(start_text(kJune + 1), "2026-06-01T10:00:00.000000001Z");
  EXPECT_EQ(start_text(0), "1970-01-01T00:00:00Z");
  for (const std::uint64_t start : {kJune + 123'456'789, (kSecond << 31U) - 1, kSecond}) {
    EXPECT_EQ(start_from_text(start_text(start)), start);
  }
}

TEST(MessageStartTest, RefusesWhatIsNoTime) {
  for (const char* text :
       {"", "now", "2026-06-01", "2026-06-01T10:00:00", "2026-06-01 10:00:00Z", "2026-13-01T10:00:00Z",
        "2026-02-29T10:00:00Z", "2026-06-01T24:00:00Z", "2026-06-01T10:60:00Z", "2026-06-01T10:00:00Zx",
        "2026-06-01T10:00:00.Z", "2026-06-01T10:00:00.1234567890Z", "2026-06-01T10:00:00+0200", "26-06-01T10:00:00Z",
        "2026-6-1T10:00:00Z", "2026-06--1T10:00:00Z"}) {
    EXPECT_EQ(message_of([&] { (void)start_from_text(text); }),
              std::string(text) + " must be a time with its zone, such as 2026-06-01T10:00:00Z");
  }
  for (const char* text :
       {"1969-12-31T23:59:59Z", "1970-01-01T00:30:00+01:00", "2038-01-19T03:14:08Z", "9999-01-01T00:00:00Z"}) {
    EXPECT_EQ(message_of([&] { (void)start_from_text(text); }),
              std::string(text) +
                  " must be from 1970-01-01T00:00:00Z to before 2038-01-19T03:14:08Z, as ROS messages hold it");
  }
}

SonarConfig small_sonar() {
  SonarConfig sonar;
  sonar.name = "fls";
  sonar.beam_count = 2;
  sonar.bin_count = 3;
  sonar.max_range = 9;
  sonar.assumed_sound_speed = 1500;
  return sonar;
}

Ping ping_at(double time) {
  Ping ping;
  ping.number = 7;
  ping.time = time;
  ping.bin_count = 3;
  ping.beam_count = 2;
  ping.intensity.assign(6, 1e-8F);
  return ping;
}

TEST(MessageStartTest, StampsCountFromTheStart) {
  SonarMessages messages({small_sonar(), EchoModel::kCalibrated, {}, ""}, {.start_ns = kJune + kSecond / 2});
  messages.take(ping_at(12.75));
  EXPECT_EQ(messages.time_ns(), kJune + 13 * kSecond + kSecond / 4);
  for (std::size_t channel = 0; channel < messages.channels().size(); ++channel) {
    if (messages.channels()[channel].kind == MessageKind::kSonarImage) {
      CdrRead in(messages.encode(channel));
      EXPECT_EQ(in.number<std::int32_t>(), static_cast<std::int32_t>(kJune / kSecond + 13));
      EXPECT_EQ(in.number<std::uint32_t>(), kSecond / 4);
    }
  }
}

TEST(MessageStartTest, TimesEndWhereThoseOfRosDo) {
  const std::uint64_t late = start_from_text("2038-01-19T03:14:00Z");  // 8 s before.
  SonarMessages messages({small_sonar(), EchoModel::kCalibrated, {}, ""}, {.start_ns = late});
  messages.take(ping_at(6.5));
  EXPECT_EQ(message_of([&] { messages.take(ping_at(8.5)); }),
            "ping 7 of fls: time = 8.5 s after 2038-01-19T03:14:00Z must be from 0 to below 2147483647 s after "
            "1970-01-01T00:00:00Z, as ROS messages hold it");
  EXPECT_EQ(message_of([] {
              SonarMessages({small_sonar(), EchoModel::kCalibrated, {}, ""}, {.start_ns = kSecond << 31U});
            }),
            "messages.start_ns = 2147483648000000000 ns must be below 2^31 s");
}

}  // namespace
}  // namespace insonify::message_start_test
