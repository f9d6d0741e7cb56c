// encode.cpp -- writes each message's fields in the order of its definition (message_channels.cpp); Gazebo's are
// written in encode_gazebo.cpp.

#include "io/message/encode.h"

#include "io/message/encode_gazebo.h"
#include "io/message/ros_writer.h"

namespace insonify {
namespace {

constexpr std::size_t kAroundData = 256;  // Approximate size of a message without its table [bytes].

void put(RosWriter& out, const MessageHeader& header) {
  if (!out.is_cdr()) {
    out.put(header.sequence);
  }
  constexpr std::uint64_t kNanoseconds = 1'000'000'000;
  out.put(static_cast<std::int32_t>(header.time_ns / kNanoseconds),
          static_cast<std::uint32_t>(header.time_ns % kNanoseconds), std::string_view(header.frame));
}

void put(RosWriter& out, const Vec3& vector) {
  for (const double value : vector) {
    out.put(value);
  }
}

void put(RosWriter& out, const Pose& pose) {
  put(out, pose.position);
  for (const double value : {pose.orientation.x(), pose.orientation.y(), pose.orientation.z(), pose.orientation.w()}) {
    out.put(value);
  }
}

std::span<const std::uint8_t> octets(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
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
std::vector<std::byte> encode_pixels(MessageForm form, const MessageHeader& header, gazebo::PixelFormat format,
                                     std::size_t width, std::size_t step, std::span<const std::byte> bytes) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_pixels(header, format, width, step, bytes);
  }
  RosWriter out(form, bytes.size() + kAroundData);
  put(out, header);
  out.put(static_cast<std::uint32_t>(bytes.size() / step), static_cast<std::uint32_t>(width));
  out.put(std::string_view(format == gazebo::PixelFormat::kRgb8    ? "rgb8"
                           : format == gazebo::PixelFormat::kGrey8 ? "mono8"
                                                                   : "mono16"));
  out.put(std::uint8_t{0});  // is_bigendian
  out.put(static_cast<std::uint32_t>(step), octets(bytes));
  return out.take();
}

template <typename Value>
std::vector<std::byte> encode_values(MessageForm form, const MessageHeader& header, const SonarImageFacts& facts,
                                     std::span<const Value> values) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_sonar_image(header, facts, format_of(Value{}), std::as_bytes(values));
  }
  const std::size_t beams = facts.directions.size();
  RosWriter out(form, values.size_bytes() + beams * (sizeof(double) * 3 + sizeof(float) * 2) +
                          facts.ranges.size() * sizeof(float) + kAroundData);
  put(out, header);
  out.put(facts.frequency, facts.sound_speed, std::span(facts.transmit_widths), std::span(facts.receive_widths));
  out.put_length(beams);
  for (const Vec3& direction : facts.directions) {
    put(out, direction);
  }
  out.put(std::span(facts.ranges));
  out.put(false);  // is_bigendian
  out.put(type_of(Value{}), static_cast<std::uint32_t>(beams), octets(std::as_bytes(values)));
  return out.take();
}

template <typename Value>
std::vector<std::byte> encode_samples(MessageForm form, const MessageHeader& header, const SonarImageFacts& facts,
                                      const RawImageFacts& raw, std::span<const Value> values) {
  const std::vector<float> none(raw.receive_angles.size());  // No beam is sent late, or steered along the track.
  RosWriter out(form, values.size_bytes() + none.size() * sizeof(float) * 5 + kAroundData);
  put(out, header);
  out.put(facts.frequency, facts.sound_speed, std::span(facts.transmit_widths), std::span(facts.receive_widths));
  out.put(raw.sample_rate, static_cast<std::uint32_t>(facts.ranges.size()), raw.first_sample);
  out.put(std::span(none), std::span(none), std::span(raw.receive_angles));
  out.put(false);  // is_bigendian
  out.put(type_of(Value{}), static_cast<std::uint32_t>(none.size()), octets(std::as_bytes(values)));
  return out.take();
}

}  // namespace

std::vector<std::byte> encode_text(MessageForm form, std::string_view text) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_text(text);
  }
  RosWriter out(form, text.size() + kAroundData);
  out.put(text);
  return out.take();
}

std::vector<std::byte> encode_pose(MessageForm form, const MessageHeader& header, const Pose& pose) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_pose(header, pose);
  }
  RosWriter out(form, kAroundData);
  put(out, header);
  put(out, pose);
  return out.take();
}

std::vector<std::byte> encode_transforms(MessageForm form, std::span<const FramePose> frames) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_transforms(frames);
  }
  RosWriter out(form, kAroundData);
  out.put_length(frames.size());
  for (const FramePose& frame : frames) {
    put(out, frame.parent);
    out.put(std::string_view(frame.child));
    put(out, frame.parent_from_child);
  }
  return out.take();
}

std::vector<std::byte> encode_image(MessageForm form, const MessageHeader& header, const Picture& picture) {
  const auto width = static_cast<std::size_t>(picture.width);
  return encode_pixels(form, header, gazebo::PixelFormat::kRgb8, width, 3 * width,
                       std::as_bytes(std::span(picture.rgb)));
}

std::vector<std::byte> encode_grey_image(MessageForm form, const MessageHeader& header, std::size_t width,
                                         std::span<const std::uint8_t> values) {
  return encode_pixels(form, header, format_of(std::uint8_t{}), width, width, std::as_bytes(values));
}

std::vector<std::byte> encode_grey_image(MessageForm form, const MessageHeader& header, std::size_t width,
                                         std::span<const std::uint16_t> values) {
  return encode_pixels(form, header, format_of(std::uint16_t{}), width, 2 * width, std::as_bytes(values));
}

std::vector<std::byte> encode_cloud(MessageForm form, const MessageHeader& header, const Cloud& cloud) {
  if (form == MessageForm::kGazebo) {
    return gazebo::encode_cloud(header, cloud);
  }
  RosWriter out(form, cloud.points.size() + kAroundData);
  put(out, header);
  out.put(std::uint32_t{1});  // height: the points have no order.
  out.put(static_cast<std::uint32_t>(cloud.count()));
  out.put_length(cloud.fields.size());
  for (const CloudField& field : cloud.fields) {
    out.put(field.name, field.offset, static_cast<std::uint8_t>(field.type), std::uint32_t{1});
  }
  out.put(false);  // is_bigendian
  out.put(static_cast<std::uint32_t>(cloud.step), static_cast<std::uint32_t>(cloud.points.size()),
          octets(cloud.points));
  out.put(true);  // is_dense: no point is NaN.
  return out.take();
}

std::vector<std::byte> encode_scan(MessageForm form, const MessageHeader& header, const LineScan& scan) {
  RosWriter out(form, 2 * scan.ranges.size() * sizeof(float) + kAroundData);
  put(out, header);
  const double last_angle = scan.first_angle + static_cast<double>(scan.ranges.size() - 1) * scan.step;
  for (const double value :
       {scan.first_angle, last_angle, scan.step, scan.interval, scan.duration, scan.least_range, scan.most_range}) {
    out.put(static_cast<float>(value));
  }
  out.put(std::span(scan.ranges), std::span(scan.intensities));
  return out.take();
}

std::vector<std::byte> encode_sonar_image(MessageForm form, const MessageHeader& header, const SonarImageFacts& facts,
                                          std::span<const std::uint8_t> values) {
  return encode_values(form, header, facts, values);
}

std::vector<std::byte> encode_sonar_image(MessageForm form, const MessageHeader& header, const SonarImageFacts& facts,
                                          std::span<const std::uint16_t> values) {
  return encode_values(form, header, facts, values);
}

std::vector<std::byte> encode_raw_sonar_image(MessageForm form, const MessageHeader& header,
                                              const SonarImageFacts& facts, const RawImageFacts& raw,
                                              std::span<const std::uint8_t> values) {
  return encode_samples(form, header, facts, raw, values);
}

std::vector<std::byte> encode_raw_sonar_image(MessageForm form, const MessageHeader& header,
                                              const SonarImageFacts& facts, const RawImageFacts& raw,
                                              std::span<const std::uint16_t> values) {
  return encode_samples(form, header, facts, raw, values);
}

std::vector<std::byte> encode_detections(MessageForm form, const MessageHeader& header, const SonarImageFacts& facts,
                                         const DetectionFacts& detections) {
  const std::vector<float> none(detections.flags.size());  // No beam is sent late, or steered along the track.
  RosWriter out(form, none.size() * (sizeof(float) * 7 + 1) + kAroundData);
  put(out, header);
  out.put(facts.frequency, facts.sound_speed, std::span(facts.transmit_widths), std::span(facts.receive_widths));
  out.put(std::span(detections.flags));  // Messages of one byte lie as bytes do.
  out.put(std::span(detections.travel_times), std::span(none), std::span(detections.intensities), std::span(none),
          std::span(detections.receive_angles));
  return out.take();
}

}  // namespace insonify
