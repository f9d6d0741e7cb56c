// oculus_messages_test.cpp -- layouts of Oculus messages byte by byte, and what is refused.

#include "insonify/wire/oculus_messages.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>

#include "insonify/error.h"
#include "support/message_of.h"

namespace insonify::oculus_messages_test {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using Bytes = std::vector<std::uint8_t>;

template <typename Number>
Number at(const Bytes& bytes, std::size_t offset) {
  Number number = 0;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

Bytes part(const Bytes& bytes, std::size_t from, std::size_t size) {
  return {bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.begin() + static_cast<std::ptrdiff_t>(from + size)};
}

void add(Bytes& bytes, double value) {
  std::uint8_t raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.insert(bytes.end(), std::begin(raw), std::end(raw));
}

// Mode 2, 15 Hz, network speed 200, gamma 127, flags; 2.5 m, 62.5 %, 1487.25 m/s, 31.5 PSU.
OculusMessage fire_message(std::uint8_t flags = 0x4b, double range = 2.5, double gain = 62.5) {
  OculusMessage message{.id = 0x15, .destination = 7, .payload = {2, 1, 200, 127, flags}};
  for (const double value : {range, gain, 1487.25, 31.5}) {
    add(message.payload, value);
  }
  return message;
}

OculusMessage second_layout(OculusMessage message) {
  message.version = 2;
  for (std::uint8_t word = 1; word <= 9; ++word) {
    message.payload.insert(message.payload.end(), {word, 0, 0, 1});
  }
  return message;
}

std::string refusal_of(const OculusMessage& message) {
  try {
    static_cast<void>(decode_fire(message));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(OculusMessagesTest, HeadersHaveSixteenBytes) {
  EXPECT_THAT(encode(OculusMessage{.id = 0x55, .version = 2, .source = 0x102, .destination = 0x304, .payload = {9, 8}}),
              ElementsAre(0x53, 0x4f, 2, 1, 4, 3, 0x55, 0, 2, 0, 2, 0, 0, 0, 0, 0, 9, 8));
}

TEST(OculusMessagesTest, MessagesAreFoundInAnyPiecesAndBetweenOtherBytes) {
  const OculusMessage first = fire_message(), second{.id = 0xff};
  Bytes stream = {1, 'S', 'O', 'S'};
  for (const OculusMessage& message : {first, second, first}) {
    const Bytes bytes = encode(message);
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    stream.push_back('O');
  }
  stream.resize(stream.size() + kOculusHeaderSize);  // Zeros: the last message is looked for behind them.
  for (const std::size_t size : {std::size_t{1}, std::size_t{7}, stream.size()}) {
    OculusParser parser;
    std::vector<OculusMessage> found;
    for (std::size_t from = 0; from < stream.size(); from += size) {
      parser.add(std::span(stream).subspan(from, std::min(size, stream.size() - from)));
      while (const auto message = parser.next()) {
        found.push_back(*message);
      }
    }
    EXPECT_THAT(found, ElementsAre(first, second, first));
    EXPECT_EQ(parser.skipped(), 4 + 3 + 1);  // The last 15 of the zeros may begin a header.
  }
}

TEST(OculusMessagesTest, APayloadThatIsTooLongIsNoMessage) {
  OculusParser parser;
  Bytes bytes = encode(OculusMessage{.id = 0x15});
  bytes[10] = 1;
  bytes[11] = 4;  // 1025 bytes.
  parser.add(bytes);
  const OculusMessage longest{.id = 0x15, .payload = Bytes(1024)};
  parser.add(encode(longest));
  EXPECT_EQ(parser.next(), longest);
  EXPECT_EQ(parser.skipped(), kOculusHeaderSize);
}

TEST(OculusMessagesTest, FireMessagesOfBothLayoutsAreDecoded) {
  const OculusFire expected{.mode = 2,
                            .ping_rate = 1,
                            .network_speed = 200,
                            .gamma = 127,
                            .flags = 0x4b,
                            .range = 2.5,
                            .gain = 62.5,
                            .sound_speed = 1487.25,
                            .salinity = 31.5};
  EXPECT_EQ(decode_fire(fire_message()), expected);
  OculusFire second = expected;
  second.layout = 2;
  second.extended_flags = 0x1000001;
  for (std::uint32_t i = 0; i < 8; ++i) {
    second.reserved[i] = 0x1000002 + i;
  }
  EXPECT_EQ(decode_fire(second_layout(fire_message())), second);
  OculusMessage unmarked = second_layout(fire_message());
  unmarked.version = 0;  // The size tells the layout.
  EXPECT_EQ(decode_fire(unmarked), second);
}

TEST(OculusMessagesTest, WrongFireMessagesAreRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal_of(fire_message(0x4b, kNan)), "range = nan must be greater than 0, at most 100000");
  EXPECT_EQ(refusal_of(fire_message(0x4a, 100.5)), "range = 100.5 must be greater than 0, at most 100");
  EXPECT_EQ(refusal_of(fire_message(0x4b, 2, 100.01)), "gain = 100.01 must be from 0 to 100");
  EXPECT_EQ(refusal_of(fire_message(0x43)),
            "flags = 0x43 ask for the full return message, whose format is not public; 0x4b asks for the simple one");
  OculusMessage message = fire_message();
  message.payload[0] = 0;
  EXPECT_EQ(refusal_of(message), "mode = 0 must be from 1 to 2");
  message = fire_message();
  message.payload[1] = 6;
  EXPECT_EQ(refusal_of(message), "ping rate = 6 must be from 0 to 5");
  message = fire_message();
  message.payload.pop_back();
  EXPECT_EQ(refusal_of(message), "fire message of version 0 has a payload of 36 bytes and must have 37 or 73");
  message = fire_message();
  message.version = 2;
  EXPECT_EQ(refusal_of(message), "fire message of version 2 has a payload of 37 bytes and must have 73");
  EXPECT_EQ(refusal_of({.id = 0x15}), "fire message of version 0 has a payload of 0 bytes and must have 37 or 73");
}

// A driver that halves and doubles what the sonar repeats may end up a hair below 0.
TEST(OculusMessagesTest, AGainMayBeRounded) {
  EXPECT_EQ(decode_fire(fire_message(0x4b, 2, -1e-14)).gain, 0);
  EXPECT_EQ(decode_fire(fire_message(0x4b, 2, 100 + 1e-12)).gain, 100);
}

TEST(OculusMessagesTest, PingRatesAreThoseOfTheInstrument) {
  std::vector<double> rates;
  for (std::uint8_t rate = 0; rate < 8; ++rate) {
    rates.push_back(oculus_ping_rate(rate));
  }
  EXPECT_THAT(rates, ElementsAre(10, 15, 40, 5, 2, 0, 0, 0));
}

OculusPing ping_of_two_beams() {
  return {.fire = decode_fire(second_layout(fire_message())),
          .device = 5,
          .number = 77,
          .frequency = 1.2e6,
          .temperature_c = 11,
          .pressure_bar = 2.5,
          .heading_deg = 311,
          .pitch_deg = -3,
          .roll_deg = 4,
          .sound_speed = 1490,
          .start_time = 5000.25,  // Beyond 2^32 us, which are 4294.967296 s.
          .range_resolution = 0.0125,
          .range_count = 1,
          .bearings = {-3210, 3210},
          .image = {1, 2, 3, 4}};
}

// Offsets: header 16, fire 37, then u32 u32 f64 f64 f64 f64 u32 u8 f64 u16 u16 u32 u32 u32 = 69.
TEST(OculusMessagesTest, PingResultsOfLayout1HaveTheirFieldsInPlace) {
  OculusPing ping = ping_of_two_beams();
  ping.fire.layout = 1;
  const Bytes bytes = encode(ping);
  ASSERT_EQ(bytes.size(), 122 + 4 + 4);
  EXPECT_THAT(part(bytes, 0, 16), ElementsAre(0x53, 0x4f, 5, 0, 0, 0, 0x23, 0, 1, 0, 114, 0, 0, 0, 0, 0));
  EXPECT_THAT(part(bytes, 16, 37), ElementsAreArray(fire_message().payload));
  EXPECT_EQ(at<std::uint32_t>(bytes, 53), 77U);
  EXPECT_EQ(at<double>(bytes, 61), 1.2e6);
  EXPECT_EQ(at<double>(bytes, 69), 11);
  EXPECT_EQ(at<double>(bytes, 77), 2.5);
  EXPECT_EQ(at<double>(bytes, 85), 1490);
  EXPECT_EQ(at<std::uint32_t>(bytes, 93), 5000250000 - 4294967296);
  EXPECT_EQ(bytes[97], 1);  // 16 bits.
  EXPECT_EQ(at<double>(bytes, 98), 0.0125);
  EXPECT_THAT(part(bytes, 106, 4), ElementsAre(1, 0, 2, 0));
  EXPECT_EQ(at<std::uint32_t>(bytes, 110), 126U);
  EXPECT_EQ(at<std::uint32_t>(bytes, 114), 4U);
  EXPECT_EQ(at<std::uint32_t>(bytes, 118), 130U);
  EXPECT_EQ(at<std::int16_t>(bytes, 122), -3210);
  EXPECT_EQ(at<std::int16_t>(bytes, 124), 3210);
  EXPECT_THAT(part(bytes, 126, 4), ElementsAre(1, 2, 3, 4));
}

TEST(OculusMessagesTest, PingResultsOfLayout2HaveTheirFieldsInPlace) {
  const Bytes bytes = encode(ping_of_two_beams());
  ASSERT_EQ(bytes.size(), 202 + 4 + 4);
  EXPECT_EQ(bytes[8], 2);
  EXPECT_EQ(at<std::uint32_t>(bytes, 10), 194U);
  EXPECT_THAT(part(bytes, 16, 73), ElementsAreArray(second_layout(fire_message()).payload));
  EXPECT_EQ(at<std::uint32_t>(bytes, 89), 77U);
  EXPECT_EQ(at<double>(bytes, 113), 2.5);
  EXPECT_EQ(at<double>(bytes, 121), 311);
  EXPECT_EQ(at<double>(bytes, 129), -3);
  EXPECT_EQ(at<double>(bytes, 137), 4);
  EXPECT_EQ(at<double>(bytes, 145), 1490);
  EXPECT_EQ(at<double>(bytes, 153), 5000.25);
  EXPECT_EQ(bytes[161], 1);
  EXPECT_EQ(at<double>(bytes, 162), 0.0125);
  EXPECT_THAT(part(bytes, 170, 4), ElementsAre(1, 0, 2, 0));
  EXPECT_EQ(at<std::uint32_t>(bytes, 190), 206U);
  EXPECT_EQ(at<std::uint32_t>(bytes, 194), 4U);
  EXPECT_EQ(at<std::uint32_t>(bytes, 198), 210U);
  EXPECT_EQ(at<std::int16_t>(bytes, 202), -3210);
  EXPECT_THAT(part(bytes, 206, 4), ElementsAre(1, 2, 3, 4));
}

TEST(OculusMessagesTest, StatusMessagesHave142Bytes) {
  const OculusStatus status{.device = 0x102,
                            .part_number = 1042,
                            .address = {192, 168, 2, 3},
                            .mask = {255, 255, 0, 0},
                            .client = {192, 168, 2, 9},
                            .temperature_c = 7.5,
                            .pressure_bar = 3.25};
  const Bytes bytes = encode(status);
  ASSERT_EQ(bytes.size(), 142U);
  EXPECT_THAT(part(bytes, 0, 28), ElementsAre(0x53, 0x4f, 2, 1, 0, 0, 1, 0, 0, 0, 126, 0, 0, 0, 0, 0,  //
                                              2, 1, 0, 0, 1, 0, 0x12, 4, 3, 0, 0, 0));
  EXPECT_THAT(part(bytes, 52, 12), ElementsAre(192, 168, 2, 3, 255, 255, 0, 0, 192, 168, 2, 9));
  EXPECT_EQ(at<double>(bytes, 70), 7.5);
  EXPECT_EQ(at<double>(bytes, 126), 7.5);
  EXPECT_EQ(at<double>(bytes, 134), 3.25);
  EXPECT_THAT(oculus_user_config(status).payload, ElementsAre(192, 168, 2, 3, 255, 255, 0, 0, 0, 0, 0, 0));
}

TEST(OculusMessagesTest, PingsAreDecodedAsTheyWereEncoded) {
  for (const int layout : {1, 2}) {
    OculusPing ping;
    ping.device = 9;
    ping.number = 77;
    ping.frequency = 1.2e6;
    ping.fire.layout = layout;
    ping.fire.flags = kOculusRangeInMetres | kOculus16Bits | kOculusGainSent;
    ping.fire.range = 20;
    ping.sound_speed = 1480;
    ping.start_time = 12.5;
    ping.range_resolution = 0.25;
    ping.range_count = 2;
    ping.bearings = {-3000, 0, 3000};
    ping.image.resize(2 * (4 + 3 * 2));
    std::iota(ping.image.begin(), ping.image.end(), std::uint8_t{1});
    const Bytes bytes = encode(ping);
    const OculusPing back = decode_ping(bytes);
    EXPECT_EQ(back.fire, ping.fire);
    EXPECT_EQ(back.device, 9);
    EXPECT_EQ(back.number, 77U);
    EXPECT_EQ(back.frequency, 1.2e6);
    EXPECT_EQ(back.sound_speed, 1480);
    EXPECT_EQ(back.start_time, 12.5);
    EXPECT_EQ(back.range_resolution, 0.25);
    EXPECT_EQ(back.range_count, 2);
    EXPECT_EQ(back.bearings, ping.bearings);
    EXPECT_EQ(back.image, ping.image);
    EXPECT_EQ(message_of([&] { static_cast<void>(decode_ping(std::span(bytes).first(50))); }),
              "header of 122 bytes from byte 0 on must lie in the message of 50 bytes");
    EXPECT_EQ(message_of([&] { static_cast<void>(decode_ping(std::span(bytes).first(bytes.size() - 1))); }),
              fmt::format("image of 20 bytes from byte {} on must lie in the message of {} bytes", bytes.size() - 20,
                          bytes.size() - 1));
  }
}

// Whatever arrives, what is obeyed is within its limits.
TEST(OculusMessagesTest, RandomlyChangedMessagesAreWithinLimitsOrRefused) {
  std::mt19937 chance(52100);
  const auto up_to = [&](std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most)(chance); };
  int obeyed = 0, refused = 0;
  OculusParser parser;
  for (int round = 0; round < 20000; ++round) {
    Bytes bytes = encode(round % 2 == 0 ? fire_message() : second_layout(fire_message()));
    for (std::size_t changes = up_to(3); changes > 0; --changes) {
      bytes[up_to(bytes.size() - 1)] = static_cast<std::uint8_t>(up_to(255));
    }
    if (up_to(9) == 0) {
      bytes.resize(up_to(bytes.size()));
    }
    parser.add(bytes);
    while (const std::optional<OculusMessage> message = parser.next()) {
      ASSERT_LE(message->payload.size(), kLongestOculusPayload);
      try {
        const OculusFire fire = decode_fire(*message);
        ASSERT_TRUE(fire.range > 0 && fire.range <= 1e5) << fire.range;
        ASSERT_TRUE(fire.gain >= 0 && fire.gain <= 100) << fire.gain;
        ASSERT_TRUE(fire.sound_speed == 0 || std::abs(fire.sound_speed - 1500) <= 200) << fire.sound_speed;
        ASSERT_TRUE(fire.salinity >= 0 && fire.salinity <= 50) << fire.salinity;
        ++obeyed;
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(obeyed, 2000);
  EXPECT_GT(refused, 2000);
}

}  // namespace
}  // namespace insonify::oculus_messages_test
