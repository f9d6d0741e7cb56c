// ping_streamer.cpp -- what streaming sonars of the ping protocol answer alike.

#include "insonify/wire/ping_streamer.h"

#include "insonify/error.h"
#include "wire/little_endian.h"

namespace insonify {
namespace {

// Ids of messages.
constexpr std::uint16_t kAckId = 1, kNackId = 2, kInformationId = 4, kVersionId = 5, kRequestId = 6;

PingFrame refusal(std::uint16_t id, std::string_view reason) {
  PingFrame frame{.id = kNackId, .source = 1};
  put(frame.payload, id);
  frame.payload.insert(frame.payload.end(), reason.begin(), reason.end());
  return frame;
}

}  // namespace

std::vector<PingFrame> PingStreamer::take(const PingFrame& frame) {
  std::uint16_t id = frame.id;
  if (id == kRequestId && frame.payload.size() == 2) {
    id = static_cast<std::uint16_t>(frame.payload[0] | frame.payload[1] << 8);
  }
  switch (id) {
    case kAckId:
    case kNackId:
      return {};
    case kInformationId:  // Type 0: the published list has none for these. Revision and firmware are ours.
      return {{.id = id, .source = 1, .payload = {0, 0, 1, 0, 0, 0}}};
    case kVersionId:
      return {{.id = id, .source = 1, .payload = {1, 0, 0, 0}}};
    default:
      break;
  }
  try {
    return command(frame) ? std::vector<PingFrame>{} : std::vector<PingFrame>{refusal(frame.id, "unknown message")};
  } catch (const Error& error) {
    return {refusal(frame.id, error.what())};
  }
}

}  // namespace insonify
