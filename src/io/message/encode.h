// encode.h -- encodes the message types in use, as ROS 2, ROS 1 or Gazebo has them.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/geometry.h"
#include "insonify/messages.h"
#include "insonify/picture.h"
#include "io/message/clouds.h"

namespace insonify {

/// std_msgs/Header.
struct MessageHeader {
  std::uint64_t time_ns = 0;  ///< Below 2^31 s.
  std::string frame;
  std::uint32_t sequence = 0;  ///< ROS 1 only.
};

/// Pose of a frame in another one.
struct FramePose {
  MessageHeader parent;
  std::string child;
  Pose parent_from_child;
};

/// marine_acoustic_msgs/ProjectedSonarImage, without its values.
struct SonarImageFacts {
  float frequency = 0, sound_speed = 0;  ///< [Hz], [m/s]
  std::vector<float> transmit_widths;    ///< One per beam: some readers use the first without checking [rad].
  std::vector<float> receive_widths;     ///< One per beam [rad].
  std::vector<Vec3> directions;          ///< Unit vector of each beam, in the frame of the message.
  std::vector<float> ranges;             ///< Centre of each bin [m].
};

/// marine_acoustic_msgs/RawSonarImage beyond that: samples in time.
struct RawImageFacts {
  float sample_rate = 0;              ///< [Hz]; 0: unknown.
  std::uint32_t first_sample = 0;     ///< Samples from the transmission to the first one.
  std::vector<float> receive_angles;  ///< [beam] Angle across the track, from straight down to starboard [rad].
};

/// marine_acoustic_msgs/SonarDetections beyond its ping info: a value for each beam.
struct DetectionFacts {
  std::vector<std::uint8_t> flags;    ///< 0 (DETECT_OK) or 1 (DETECT_BAD_SONAR).
  std::vector<float> travel_times;    ///< There and back [s].
  std::vector<float> intensities;     ///< [dB]
  std::vector<float> receive_angles;  ///< Across the track, from straight down to starboard [rad].
};

/// sensor_msgs/LaserScan.
struct LineScan {
  double first_angle = 0, step = 0;        ///< Positive to port [rad].
  double interval = 0;                     ///< Between pings [s].
  double duration = 0;                     ///< From the first ping of a scan to that of the next [s].
  double least_range = 0, most_range = 0;  ///< [m]
  std::vector<float> ranges;               ///< Of each ping, infinite without a return [m].
  std::vector<float> intensities;          ///< [dB]
};

[[nodiscard]] std::vector<std::byte> encode_text(MessageForm form, std::string_view text);
[[nodiscard]] std::vector<std::byte> encode_pose(MessageForm form, const MessageHeader& header, const Pose& pose);
[[nodiscard]] std::vector<std::byte> encode_transforms(MessageForm form, std::span<const FramePose> frames);
[[nodiscard]] std::vector<std::byte> encode_image(MessageForm form, const MessageHeader& header,
                                                  const Picture& picture);
/// @param values  One per pixel, of 8 or 16 bits, row by row.
[[nodiscard]] std::vector<std::byte> encode_grey_image(MessageForm form, const MessageHeader& header, std::size_t width,
                                                       std::span<const std::uint8_t> values);
[[nodiscard]] std::vector<std::byte> encode_grey_image(MessageForm form, const MessageHeader& header, std::size_t width,
                                                       std::span<const std::uint16_t> values);
[[nodiscard]] std::vector<std::byte> encode_cloud(MessageForm form, const MessageHeader& header, const Cloud& cloud);

/// @param form  That of ROS 1 or 2.
[[nodiscard]] std::vector<std::byte> encode_scan(MessageForm form, const MessageHeader& header, const LineScan& scan);

/// @param values  One per cell, of 8 or 16 bits, range-major: a row holds all beams at one range. (The comment in the
///                .msg file says otherwise, but readers expect this order.)
[[nodiscard]] std::vector<std::byte> encode_sonar_image(MessageForm form, const MessageHeader& header,
                                                        const SonarImageFacts& facts,
                                                        std::span<const std::uint8_t> values);
[[nodiscard]] std::vector<std::byte> encode_sonar_image(MessageForm form, const MessageHeader& header,
                                                        const SonarImageFacts& facts,
                                                        std::span<const std::uint16_t> values);

/// The same values as samples of each beam in time, for ROS 1 or 2.
[[nodiscard]] std::vector<std::byte> encode_raw_sonar_image(MessageForm form, const MessageHeader& header,
                                                            const SonarImageFacts& facts, const RawImageFacts& raw,
                                                            std::span<const std::uint8_t> values);
[[nodiscard]] std::vector<std::byte> encode_raw_sonar_image(MessageForm form, const MessageHeader& header,
                                                            const SonarImageFacts& facts, const RawImageFacts& raw,
                                                            std::span<const std::uint16_t> values);

/// The soundings of a multibeam, for ROS 1 or 2.
/// @param facts  Those of its sonar image: frequency, sound speed and widths of beams.
[[nodiscard]] std::vector<std::byte> encode_detections(MessageForm form, const MessageHeader& header,
                                                       const SonarImageFacts& facts, const DetectionFacts& detections);

}  // namespace insonify
