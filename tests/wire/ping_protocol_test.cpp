// ping_protocol_test.cpp -- frames of the ping protocol, whole, damaged, in pieces and among other bytes.

#include "insonify/wire/ping_protocol.h"

#include <gmock/gmock.h>

#include <random>

namespace insonify::ping_protocol_test {
namespace {

using testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

std::vector<PingEvent> events_of(PingParser& parser) {
  std::vector<PingEvent> events;
  while (auto event = parser.last()) {
    events.push_back(*event);
  }
  return events;
}

std::vector<PingEvent> events_of(const Bytes& bytes) {
  PingParser parser;
  parser.add(bytes);
  return events_of(parser);
}

// A general request for message 2300 = 0x08fc. 66 + 82 + 2 + 6 + 3 + 0xfc + 8 = 419 = 0x01a3.
const Bytes kRequest = {'B', 'R', 2, 0, 6, 0, 0, 3, 0xfc, 0x08, 0xa3, 0x01};
const PingFrame kRequestFrame{.id = 6, .source = 0, .destination = 3, .payload = {0xfc, 0x08}};

TEST(PingProtocolTest, FramesHaveAHeaderAndTheSumOfTheirBytes) {
  EXPECT_EQ(encode(kRequestFrame), kRequest);
}

TEST(PingProtocolTest, FramesAreFoundBetweenOtherBytes) {
  Bytes bytes = {7, 'B', 'B', 'x', 'R'};
  bytes.insert(bytes.end(), kRequest.begin(), kRequest.end());
  bytes.insert(bytes.end(), kRequest.begin(), kRequest.end());
  const auto events = events_of(bytes);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].frame, kRequestFrame);
  EXPECT_EQ(events[1].frame, kRequestFrame);
}

TEST(PingProtocolTest, FramesMayArriveByteByByte) {
  PingParser parser;
  for (std::size_t i = 0; i < kRequest.size(); ++i) {
    EXPECT_FALSE(parser.next()) << i;
    parser.add({&kRequest[i], 1});
  }
  EXPECT_EQ(parser.next()->frame, kRequestFrame);
  EXPECT_FALSE(parser.next());
}

TEST(PingProtocolTest, DamagedFramesAreToldWithTheirIdAndWhatFollowsIsRead) {
  Bytes bytes = kRequest;
  bytes[8] ^= 1;
  bytes.insert(bytes.end(), kRequest.begin(), kRequest.end());
  const auto events = events_of(bytes);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, PingEvent::Kind::kDamaged);
  EXPECT_EQ(events[0].frame.id, 6);
  EXPECT_EQ(events[0].reason, "checksum");
  EXPECT_EQ(events[1].frame, kRequestFrame);
}

TEST(PingProtocolTest, FramesThatEndTooSoonOrClaimTooMuchAreDamaged) {
  const auto truncated = events_of(Bytes(kRequest.begin(), kRequest.end() - 1));
  ASSERT_EQ(truncated.size(), 1U);
  EXPECT_EQ(truncated[0].reason, "truncated");
  EXPECT_TRUE(events_of(Bytes(kRequest.begin(), kRequest.begin() + 7)).empty()) << "no id is known";
  Bytes long_one = kRequest;
  long_one[3] = 0xff;
  const auto claimed = events_of(long_one);
  ASSERT_EQ(claimed.size(), 1U);
  EXPECT_EQ(claimed[0].reason, "payload too long");
}

TEST(PingProtocolTest, ABreakIsToldOutsideOfFramesOnly) {
  PingFrame frame = kRequestFrame;
  frame.payload = {'U', 'U'};
  Bytes bytes = encode(frame);
  bytes.push_back('U');
  const auto events = events_of(bytes);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].frame, frame);
  EXPECT_EQ(events[1].kind, PingEvent::Kind::kBreak);
}

TEST(PingProtocolTest, AFrameIsFoundAfterAnyGarbageThatHasNoB) {
  std::mt19937 random(71);
  for (int round = 0; round < 2000; ++round) {
    Bytes bytes(random() % 90);
    for (std::uint8_t& byte : bytes) {
      byte = static_cast<std::uint8_t>(random() % 255);
      byte = byte == 'B' ? 'R' : byte;
    }
    bytes.insert(bytes.end(), kRequest.begin(), kRequest.end());
    const auto events = events_of(bytes);
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.back().frame, kRequestFrame);
  }
}

TEST(PingProtocolTest, MutatedFramesAreNeverReadAsWhole) {
  std::mt19937 random(72);
  int damaged = 0;
  for (int round = 0; round < 2000; ++round) {
    Bytes bytes = kRequest;
    const std::uint8_t flipped = static_cast<std::uint8_t>(1 + random() % 255);
    bytes[random() % bytes.size()] ^= flipped;  // One changed byte always changes the sum.
    for (const PingEvent& event : events_of(bytes)) {
      EXPECT_NE(event.kind, PingEvent::Kind::kFrame);
      ++damaged;
    }
  }
  EXPECT_GT(damaged, 1000);
}

}  // namespace
}  // namespace insonify::ping_protocol_test
