// publish_pings.cpp -- publishes messages on topics.

#include <algorithm>
#include <cstring>

#include "sonar_node.h"

namespace insonify_ros2 {
namespace {

using insonify::MessageChannel;
using insonify::MessageKind;

// Matches readers that request less, such as those of sensor data.
rclcpp::QoS qos_of(const MessageChannel& channel) {
  constexpr std::size_t kKept = 10, kKeptTransforms = 100;
  rclcpp::QoS qos(channel.latched ? 1 : channel.kind == MessageKind::kTransforms ? kKeptTransforms : kKept);
  qos.reliable();
  if (channel.latched) {
    qos.transient_local();
  }
  return qos;
}

// The bytes are CDR with its header, as rmw has them.
rclcpp::SerializedMessage serialized(const std::vector<std::byte>& bytes) {
  rclcpp::SerializedMessage message(bytes.size());
  rcl_serialized_message_t& raw = message.get_rcl_serialized_message();
  std::memcpy(raw.buffer, bytes.data(), bytes.size());
  raw.buffer_length = bytes.size();
  return message;
}

}  // namespace

// A type whose package is not installed is not published.
rclcpp::GenericPublisher::SharedPtr SonarNode::publisher(const MessageChannel& channel) {
  const auto [found, is_new] = publishers_.try_emplace(channel.topic);
  if (is_new) {
    try {
      found->second = create_generic_publisher(channel.topic, channel.type, qos_of(channel));
    } catch (const std::exception& error) {
      warn(channel.topic + " is not published: " + error.what());
    }
  }
  return found->second;
}

void SonarNode::open(std::size_t sonar, const std::vector<MessageChannel>& channels) {
  channels_.resize(std::max(channels_.size(), sonar + 1));
  channels_[sonar].clear();
  for (const MessageChannel& channel : channels) {
    channels_[sonar].push_back(publisher(channel));
  }
}

bool SonarNode::is_read(std::size_t sonar, std::size_t channel) const {
  const auto& to = channels_[sonar][channel];
  return to && to->get_subscription_count() > 0;
}

void SonarNode::send(std::size_t sonar, std::size_t channel, std::uint64_t /*time_ns*/,
                     const std::vector<std::byte>& message) {
  if (const auto& to = channels_[sonar][channel]) {
    to->publish(serialized(message));
  }
}

}  // namespace insonify_ros2
