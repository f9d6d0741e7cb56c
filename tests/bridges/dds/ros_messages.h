// ros_messages.h -- messages that a vehicle of ROS 2 writes, encoded, and what it reads of a sonar image.

#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "bridges/dds/fast_node.h"
#include "io/message/cdr_reader.h"
#include "io/message/ros_writer.h"

namespace insonify {

inline void put_time(RosWriter& cdr, double time) {
  cdr.put(static_cast<std::int32_t>(time));
  cdr.put(static_cast<std::uint32_t>((time - std::floor(time)) * 1e9));
}

/// rosgraph_msgs/msg/Clock.
inline Bytes clock_message(double time) {
  RosWriter cdr;
  put_time(cdr, time);
  return cdr.take();
}

/// nav_msgs/msg/Odometry.
/// @param yaw    Heading, from x to y [rad].
/// @param speed  Along the vehicle's own x axis [m/s].
inline Bytes odometry(double time, double x, double y, double yaw = 0, double speed = 0) {
  RosWriter cdr;
  put_time(cdr, time);
  cdr.put(std::string_view("world"));
  cdr.put(std::string_view("base_link"));
  for (const double value : {x, y, 0.0, 0.0, 0.0, std::sin(yaw / 2), std::cos(yaw / 2)}) {
    cdr.put(value);
  }
  const auto put_zeros = [&cdr](int count) {
    for (int i = 0; i < count; ++i) {
      cdr.put(0.0);
    }
  };
  put_zeros(36);  // Covariance.
  cdr.put(speed);
  put_zeros(5 + 36);
  return cdr.take();
}

/// geometry_msgs/msg/PoseStamped.
/// @param yaw  Heading, from x to y [rad].
inline Bytes pose_stamped(double time, double x, double y, double yaw = 0) {
  RosWriter cdr;
  put_time(cdr, time);
  cdr.put(std::string_view("world"));
  for (const double value : {x, y, 0.0, 0.0, 0.0, std::sin(yaw / 2), std::cos(yaw / 2)}) {
    cdr.put(value);
  }
  return cdr.take();
}

/// marine_acoustic_msgs/msg/ProjectedSonarImage with 16 bits a value.
struct SonarImage {
  double time = 0;  // [s]
  std::string frame;
  std::vector<double> azimuths;       // Positive to starboard [rad].
  std::vector<double> ranges;         // [m]
  std::vector<std::uint16_t> values;  // Range-major.

  [[nodiscard]] std::uint16_t value(std::size_t bin, std::size_t beam) const {
    return values.at(bin * azimuths.size() + beam);
  }
};

/// @throws Error for a message that is too short or has another kind of values.
inline SonarImage sonar_image(const Bytes& message) {
  SonarImage image;
  CdrReader cdr(message);
  image.time = cdr.get<std::int32_t>();
  image.time += 1e-9 * cdr.get<std::uint32_t>();
  image.frame = cdr.text();
  (void)cdr.get<float>();  // Frequency.
  (void)cdr.get<float>();  // Sound speed.
  (void)cdr.sequence<float>();
  (void)cdr.sequence<float>();
  for (auto count = cdr.get<std::uint32_t>(); count > 0; --count) {
    (void)cdr.get<double>();
    const double y = cdr.get<double>(), z = cdr.get<double>();
    image.azimuths.push_back(std::atan2(-y, z));
  }
  for (auto count = cdr.get<std::uint32_t>(); count > 0; --count) {
    image.ranges.push_back(cdr.get<float>());
  }
  const auto is_bigendian = cdr.get<std::uint8_t>();
  const auto dtype = cdr.get<std::uint32_t>();
  const auto beams = cdr.get<std::uint32_t>();
  if (is_bigendian != 0 || dtype != 2 || beams != image.azimuths.size()) {
    throw Error("a sonar image without values of 16 bits for each beam");
  }
  const std::span<const std::byte> data = cdr.sequence<std::uint8_t>();
  image.values.resize(data.size() / sizeof(std::uint16_t));
  std::memcpy(image.values.data(), data.data(), image.values.size() * sizeof(std::uint16_t));
  return image;
}

}  // namespace insonify
