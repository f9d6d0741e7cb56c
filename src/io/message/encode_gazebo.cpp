// encode_gazebo.cpp -- writes the fields of gz.msgs by their numbers.

#include "io/message/encode_gazebo.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "io/message/protobuf_writer.h"

namespace insonify::gazebo {
namespace {

constexpr std::size_t kAroundData = 512;  // Approximate size of a message without its table [bytes].

using Texts = std::vector<std::string>;
using Entry = std::pair<std::string_view, Texts>;

// Header: the time of transmission, frame and number, and further entries.
void put(ProtobufWriter& out, const MessageHeader& header, std::span<const Entry> entries = {}) {
  constexpr std::uint32_t kHeader = 1, kStamp = 1, kData = 2;
  constexpr std::uint64_t kNanoseconds = 1'000'000'000;
  out.put_message(kHeader, [&](ProtobufWriter& inner) {
    inner.put_message(kStamp, [&](ProtobufWriter& time) {
      time.put(1, header.time_ns / kNanoseconds);
      time.put(2, header.time_ns % kNanoseconds);
    });
    const auto put_entry = [&](std::string_view key, std::span<const std::string> values) {
      inner.put_message(kData, [&](ProtobufWriter& entry) {
        entry.put(1, key);
        for (const std::string& value : values) {
          entry.put_element(2, value);
        }
      });
    };
    put_entry("frame_id", Texts{header.frame});
    put_entry("seq", Texts{fmt::to_string(header.sequence)});
    for (const auto& [key, values] : entries) {
      put_entry(key, values);
    }
  });
}

// Fields 4 and 5 of Pose.
void put(ProtobufWriter& out, const Pose& pose) {
  out.put_message(4, [&](ProtobufWriter& position) {
    position.put(2, pose.position.x());
    position.put(3, pose.position.y());
    position.put(4, pose.position.z());
  });
  out.put_message(5, [&](ProtobufWriter& orientation) {
    orientation.put(2, pose.orientation.x());
    orientation.put(3, pose.orientation.y());
    orientation.put(4, pose.orientation.z());
    orientation.put(5, pose.orientation.w());
  });
}

template <typename Values>
Texts texts_of(const Values& values) {
  Texts texts;
  for (const auto value : values) {
    texts.push_back(fmt::format("{:.7g}", value));
  }
  return texts;
}

std::vector<std::byte> encode_image(const MessageHeader& header, std::span<const Entry> entries, PixelFormat format,
                                    std::size_t width, std::size_t step, std::span<const std::byte> bytes,
                                    std::size_t more) {
  ProtobufWriter out(bytes.size() + more + kAroundData);
  put(out, header, entries);
  out.put(2, std::uint64_t{width});
  out.put(3, std::uint64_t{bytes.size() / step});
  out.put(4, std::uint64_t{step});
  out.put(5, bytes);
  out.put(6, static_cast<std::uint64_t>(format));
  return out.take();
}

}  // namespace

std::vector<std::byte> encode_text(std::string_view text) {
  ProtobufWriter out(text.size() + kAroundData);
  out.put(2, text);
  return out.take();
}

std::vector<std::byte> encode_pose(const MessageHeader& header, const Pose& pose) {
  ProtobufWriter out;
  put(out, header);
  put(out, pose);
  return out.take();
}

std::vector<std::byte> encode_transforms(std::span<const FramePose> frames) {
  ProtobufWriter out;
  if (!frames.empty()) {
    put(out, frames.front().parent);
  }
  for (const FramePose& frame : frames) {
    out.put_message(2, [&](ProtobufWriter& pose) {
      put(pose, frame.parent);
      pose.put(2, std::string_view(frame.child));
      put(pose, frame.parent_from_child);
    });
  }
  return out.take();
}

std::vector<std::byte> encode_pixels(const MessageHeader& header, PixelFormat format, std::size_t width,
                                     std::size_t step, std::span<const std::byte> bytes) {
  return encode_image(header, {}, format, width, step, bytes, 0);
}

std::vector<std::byte> encode_cloud(const MessageHeader& header, const Cloud& cloud) {
  ProtobufWriter out(cloud.points.size() + kAroundData);
  put(out, header);
  for (const CloudField& each : cloud.fields) {
    out.put_message(2, [&](ProtobufWriter& field) {
      field.put(1, each.name);
      field.put(2, std::uint64_t{each.offset});
      field.put(3, static_cast<std::uint64_t>(each.type) - 1);  // Gazebo's types begin at 0.
      field.put(4, std::uint64_t{1});
    });
  }
  out.put(3, std::uint64_t{1});  // height: the points have no order.
  out.put(4, std::uint64_t{cloud.count()});
  out.put(6, std::uint64_t{cloud.step});
  out.put(7, std::uint64_t{cloud.points.size()});
  out.put(8, cloud.points);
  out.put(9, std::uint64_t{1});  // is_dense: no point is NaN.
  return out.take();
}

std::vector<std::byte> encode_sonar_image(const MessageHeader& header, const SonarImageFacts& facts, PixelFormat format,
                                          std::span<const std::byte> values) {
  std::vector<double> azimuths;
  for (const Vec3& direction : facts.directions) {
    azimuths.push_back(std::atan2(direction.y(), direction.z()));
  }
  const Entry entries[] = {{"frequency", texts_of(std::vector{facts.frequency})},
                           {"sound_speed", texts_of(std::vector{facts.sound_speed})},
                           {"azimuths", texts_of(azimuths)},
                           {"ranges", texts_of(facts.ranges)},
                           {"transmit_widths", texts_of(facts.transmit_widths)},
                           {"receive_widths", texts_of(facts.receive_widths)}};
  constexpr std::size_t kText = 14;  // Largest length of a number as text [bytes].
  const std::size_t width = facts.directions.size();
  const std::size_t step = width * (format == PixelFormat::kGrey16 ? 2 : 1);
  return encode_image(header, entries, format, width, step, values, kText * (3 * width + facts.ranges.size()));
}

}  // namespace insonify::gazebo
