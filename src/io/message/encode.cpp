// encode.cpp -- writes each message's fields in the order of its definition (definitions.cpp).

#include "io/message/encode.h"

#include "io/message/cdr_writer.h"

namespace insonify {
namespace {

constexpr std::size_t kAroundData = 256;  // Of a message beside its table [bytes], about.

void put(CdrWriter& out, const MessageHeader& header) {
  constexpr std::uint64_t kNanoseconds = 1'000'000'000;
  out.put(static_cast<std::int32_t>(header.time_ns / kNanoseconds));
  out.put(static_cast<std::uint32_t>(header.time_ns % kNanoseconds));
  out.put(std::string_view(header.frame));
}

void put(CdrWriter& out, const Vec3& vector) {
  for (const double value : {vector.x(), vector.y(), vector.z()}) {
    out.put(value);
  }
}

void put(CdrWriter& out, const Pose& pose) {
  put(out, pose.position);
  for (const double value : {pose.orientation.x(), pose.orientation.y(), pose.orientation.z(), pose.orientation.w()}) {
    out.put(value);
  }
}

constexpr std::uint32_t type_of(std::uint8_t) {
  return 0;  // DTYPE_UINT8
}
constexpr std::uint32_t type_of(std::uint16_t) {
  return 2;  // DTYPE_UINT16
}

template <typename Value>
std::vector<std::byte> encode_values(const MessageHeader& header, const SonarImageFacts& facts,
                                     std::span<const Value> values) {
  const std::size_t beams = facts.directions.size();
  CdrWriter out(values.size_bytes() + beams * (sizeof(double) * 3 + sizeof(float) * 2) +
                facts.ranges.size() * sizeof(float) + kAroundData);
  put(out, header);
  out.put(facts.frequency);
  out.put(facts.sound_speed);
  out.put(std::span(facts.transmit_widths));
  out.put(std::span(facts.receive_widths));
  out.put_length(beams);
  for (const Vec3& direction : facts.directions) {
    put(out, direction);
  }
  out.put(std::span(facts.ranges));
  out.put(false);  // is_bigendian
  out.put(type_of(Value{}));
  out.put(static_cast<std::uint32_t>(beams));
  const auto bytes = std::as_bytes(values);
  out.put(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
  return out.take();
}

}  // namespace

std::vector<std::byte> encode_text(std::string_view text) {
  CdrWriter out(text.size() + kAroundData);
  out.put(text);
  return out.take();
}

std::vector<std::byte> encode_pose(const MessageHeader& header, const Pose& pose) {
  CdrWriter out;
  put(out, header);
  put(out, pose);
  return out.take();
}

std::vector<std::byte> encode_transforms(std::span<const FramePose> frames) {
  CdrWriter out;
  out.put_length(frames.size());
  for (const FramePose& frame : frames) {
    put(out, frame.parent);
    out.put(std::string_view(frame.child));
    put(out, frame.parent_from_child);
  }
  return out.take();
}

std::vector<std::byte> encode_image(const MessageHeader& header, const Picture& picture) {
  constexpr std::uint32_t kChannels = 3;
  CdrWriter out(picture.rgb.size() + kAroundData);
  put(out, header);
  out.put(static_cast<std::uint32_t>(picture.height));
  out.put(static_cast<std::uint32_t>(picture.width));
  out.put(std::string_view("rgb8"));
  out.put(std::uint8_t{0});  // is_bigendian
  out.put(kChannels * static_cast<std::uint32_t>(picture.width));
  out.put(std::span(picture.rgb));
  return out.take();
}

std::vector<std::byte> encode_cloud(const MessageHeader& header, std::span<const CloudPoint> points) {
  constexpr std::uint8_t kFloat32 = 7;
  constexpr std::string_view kFields[] = {"x", "y", "z", "intensity"};
  CdrWriter out(points.size_bytes() + kAroundData);
  put(out, header);
  out.put(std::uint32_t{1});  // height: the points have no order.
  out.put(static_cast<std::uint32_t>(points.size()));
  out.put_length(std::size(kFields));
  std::uint32_t offset = 0;
  for (const std::string_view field : kFields) {
    out.put(field);
    out.put(offset);
    out.put(kFloat32);
    out.put(std::uint32_t{1});
    offset += sizeof(float);
  }
  out.put(false);  // is_bigendian
  out.put(static_cast<std::uint32_t>(sizeof(CloudPoint)));
  out.put(static_cast<std::uint32_t>(points.size_bytes()));
  const auto bytes = std::as_bytes(points);
  out.put(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
  out.put(true);  // is_dense: no point is NaN.
  return out.take();
}

std::vector<std::byte> encode_sonar_image(const MessageHeader& header, const SonarImageFacts& facts,
                                          std::span<const std::uint8_t> values) {
  return encode_values(header, facts, values);
}

std::vector<std::byte> encode_sonar_image(const MessageHeader& header, const SonarImageFacts& facts,
                                          std::span<const std::uint16_t> values) {
  return encode_values(header, facts, values);
}

}  // namespace insonify
