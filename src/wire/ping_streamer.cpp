// ping_streamer.cpp -- what streaming sonars of the ping protocol answer alike.

#include "insonify/wire/ping_streamer.h"

#include "insonify/error.h"
#include "wire/little_endian.h"
#include "wire/streamer_parts.h"

namespace insonify {
namespace {

// Ids of messages.
constexpr std::uint16_t kAckId = 1, kInformationId = 4, kVersionId = 5, kRequestId = 6;

// The message that a frame asks for, or its own.
std::uint16_t wanted_by(const PingFrame& frame) {
  if (frame.id != kRequestId) {
    return frame.id;
  }
  check_size(frame, sizeof(std::uint16_t));
  std::uint16_t id = 0;
  PacketReader(frame.payload).get(id);
  return id;
}

}  // namespace

PingFrame PingStreamer::refusal(std::uint16_t id, std::string_view reason) {
  PingFrame frame{.id = kPingNack, .source = 1};
  put(frame.payload, id);
  frame.payload.insert(frame.payload.end(), reason.begin(), reason.end());
  return frame;
}

StreamerAnswer PingStreamer::take(const PingFrame& frame) {
  try {
    const std::uint16_t id = wanted_by(frame);
    switch (id) {
      case kAckId:
      case kPingNack:
        return {};          // Answers are not answered.
      case kInformationId:  // Type 0: the published list has none for these. Revision and firmware are ours.
        return {.frames = {{.id = id, .source = 1, .payload = {0, 0, 1, 0, 0, 0}}}};
      case kVersionId:
        return {.frames = {{.id = id, .source = 1, .payload = {1, 0, 0, 0}}}};
      default:
        break;
    }
    if (frame.id == kRequestId || !command(frame)) {
      return {.frames = {refusal(id, "unknown message")}};
    }
    return {.accepted = true};
  } catch (const Error& error) {
    return {.frames = {refusal(frame.id, error.what())}};
  }
}

}  // namespace insonify
