// encode.cpp -- writes each message's fields in the order of its definition (definitions.cpp); Gazebo's are written in
// encode_gazebo.cpp.

#include "io/message/encode.h"

#include "io/message/cdr_writer.h"
#include "io/message/encode_gazebo.h"
#include "io/message/ros1_writer.h"

namespace insonify {
namespace {

constexpr std::size_t kAroundData = 256;  // Approximate size of a message without its table [bytes].

// What `write(out)` writes, in the requested form.
template <typename Write>
std::vector<std::byte> encoded(MessageForm form, std::size_t bytes, Write&& write) {
  if (form == MessageForm::kRos1) {
    Ros1Writer out(bytes);
    write(out);
    return out.take();
  }
  CdrWriter out(bytes);
  write(out);
  return out.take();
}

template <typename Writer>
void put(Writer& out, const MessageHeader& header) {
  if constexpr (std::is_same_v<Writer, Ros1Writer>) {
    out.put(header.sequence);
  }
  constexpr std::uint64_t kNanoseconds = 1'000'000'000;
  out.put(static_cast<std::int32_t>(header.time_ns / kNanoseconds));
  out.put(static_cast<std::uint32_t>(header.time_ns % kNanoseconds));
  out.put(std::string_view(header.frame));
}

template <typename Writer>
void put(Writer& out, const Vec3& vector) {
  for (const double value : {vector.x(), vector.y(), vector.z()}) {
    out.put(value);
  }
}

template <typename Writer>
void put(Writer& out, const Pose& pose) {
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

constexpr gazebo::PixelFormat format_of(std::uint8_t) {
  return gazebo::PixelFormat::kGrey8;
}
constexpr gazebo::PixelFormat format_of(std::uint16_t) {
  return gazebo::PixelFormat::kGrey16;
}

// sensor_msgs/Image.
// @param step  Of a row [bytes].
std::vector<std::byte> encode_pixels(MessageForm form, const MessageHeader& header, std::string_view encoding,
                                     std::size_t width, std::size_t step, std::span<const std::uint8_t> bytes) {
  return encoded(form, bytes.size() + kAroundData, [&](auto& out) {
    put(out, header);
    out.put(static_cast<std::uint32_t>(bytes.size() / step));
    out.put(static_cast<std::uint32_t>(width));
    out.put(encoding);
    out.put(std::uint8_t{0});  // is_bigendian
    out.put(static_cast<std::uint32_t>(step));
    out.put(bytes);
  });
}

template <typename Value>
std::vector<std::byte> encode_values(MessageForm form, const MessageHeader& header, const SonarImageFacts& facts,
                                     std::span<const Value> values) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_sonar_image(header, facts, format_of(Value{}), std::as_bytes(values));
  }
  const std::size_t beams = facts.directions.size();
  return encoded(form,
                 values.size_bytes() + beams * (sizeof(double) * 3 + sizeof(float) * 2) +
                     facts.ranges.size() * sizeof(float) + kAroundData,
                 [&](auto& out) {
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
                 });
}

}  // namespace

std::vector<std::byte> encode_text(MessageForm form, std::string_view text) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_text(text);
  }
  return encoded(form, text.size() + kAroundData, [&](auto& out) { out.put(text); });
}

std::vector<std::byte> encode_pose(MessageForm form, const MessageHeader& header, const Pose& pose) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_pose(header, pose);
  }
  return encoded(form, kAroundData, [&](auto& out) {
    put(out, header);
    put(out, pose);
  });
}

std::vector<std::byte> encode_transforms(MessageForm form, std::span<const FramePose> frames) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_transforms(frames);
  }
  return encoded(form, kAroundData, [&](auto& out) {
    out.put_length(frames.size());
    for (const FramePose& frame : frames) {
      put(out, frame.parent);
      out.put(std::string_view(frame.child));
      put(out, frame.parent_from_child);
    }
  });
}

std::vector<std::byte> encode_image(MessageForm form, const MessageHeader& header, const Picture& picture) {
  const std::span<const std::uint8_t> rgb(picture.rgb);
  const auto width = static_cast<std::size_t>(picture.width);
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_pixels(header, gazebo::PixelFormat::kRgb8, width, 3 * width, std::as_bytes(rgb));
  }
  return encode_pixels(form, header, "rgb8", width, 3 * width, rgb);
}

std::vector<std::byte> encode_grey_image(MessageForm form, const MessageHeader& header, std::size_t width,
                                         std::span<const std::uint8_t> values) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_pixels(header, gazebo::PixelFormat::kGrey8, width, width, std::as_bytes(values));
  }
  return encode_pixels(form, header, "mono8", width, width, values);
}

std::vector<std::byte> encode_grey_image(MessageForm form, const MessageHeader& header, std::size_t width,
                                         std::span<const std::uint16_t> values) {
  const auto bytes = std::as_bytes(values);
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_pixels(header, gazebo::PixelFormat::kGrey16, width, 2 * width, bytes);
  }
  return encode_pixels(form, header, "mono16", width, 2 * width,
                       std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

std::vector<std::byte> encode_cloud(MessageForm form, const MessageHeader& header, std::span<const CloudPoint> points) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_cloud(header, points);
  }
  constexpr std::uint8_t kFloat32 = 7;
  constexpr std::string_view kFields[] = {"x", "y", "z", "intensity"};
  return encoded(form, points.size_bytes() + kAroundData, [&](auto& out) {
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
  });
}

std::vector<std::byte> encode_sonar_image(MessageForm form, const MessageHeader& header, const SonarImageFacts& facts,
                                          std::span<const std::uint8_t> values) {
  return encode_values(form, header, facts, values);
}

std::vector<std::byte> encode_sonar_image(MessageForm form, const MessageHeader& header, const SonarImageFacts& facts,
                                          std::span<const std::uint16_t> values) {
  return encode_values(form, header, facts, values);
}

}  // namespace insonify
