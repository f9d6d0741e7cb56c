// encode_gazebo.h -- encodes messages for Gazebo's transport: the types of gz.msgs, formerly ignition.msgs.

#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "io/message/encode.h"

namespace insonify::gazebo {

// Field numbers are those of gz-msgs, the same in ignition-msgs 8 (Fortress) and gz-msgs 11 (Ionic).

/// Formats of pixels in gz.msgs.Image.
enum class PixelFormat { kGrey8 = 1, kGrey16 = 2, kRgb8 = 3 };

/// StringMsg.
[[nodiscard]] std::vector<std::byte> encode_text(std::string_view text);
/// Pose.
[[nodiscard]] std::vector<std::byte> encode_pose(const MessageHeader& header, const Pose& pose);
/// Pose_V: each pose has the name of its frame, and that of its parent frame in its header.
[[nodiscard]] std::vector<std::byte> encode_transforms(std::span<const FramePose> frames);
/// Image.
/// @param step  Size of a row [bytes].
[[nodiscard]] std::vector<std::byte> encode_pixels(const MessageHeader& header, PixelFormat format, std::size_t width,
                                                   std::size_t step, std::span<const std::byte> bytes);
/// PointCloudPacked.
[[nodiscard]] std::vector<std::byte> encode_cloud(const MessageHeader& header, const Cloud& cloud);
/// Image with a row for each bin and a column for each beam; all other facts are in its header as texts:
/// frequency, sound_speed, azimuths, ranges, transmit_widths, receive_widths.
[[nodiscard]] std::vector<std::byte> encode_sonar_image(const MessageHeader& header, const SonarImageFacts& facts,
                                                        PixelFormat format, std::span<const std::byte> values);

}  // namespace insonify::gazebo
