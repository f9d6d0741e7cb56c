// ros_transport.cpp -- makes a publisher for each topic; sends messages as encoded bytes.

#include "ros1/ros_transport.h"

#include <ros/serialization.h>
#include <ros/this_node.h>

#include <algorithm>
#include <string_view>

namespace insonify {
namespace {

const char* name_of(MessageKind kind) {
  switch (kind) {
    case MessageKind::kSonarImage:
      return "image";
    case MessageKind::kFan:
      return "fan";
    case MessageKind::kPoints:
      return "points";
    case MessageKind::kTruePoints:
      return "true_points";
    case MessageKind::kPose:
      return "pose";
    case MessageKind::kTransforms:
      return "tf";
    case MessageKind::kScenario:
      return "scenario";
    case MessageKind::kRaw:
      return "raw";
    case MessageKind::kLabels:
      return "labels";
    case MessageKind::kDescription:
      return "description";
    case MessageKind::kScan:
      return "scan";
    case MessageKind::kRawImage:
      return "raw_image";
    case MessageKind::kDetections:
      return "detections";
    case MessageKind::kSoundings:
      return "soundings";
  }
  return "";
}

// "fls" for "/fls/fan".
std::string_view sonar_of(std::string_view topic) {
  return topic.substr(1, topic.find('/', 1) - 1);
}

}  // namespace

// Absolute: sonar names may begin with "_", relative names may not.
std::string RosTransport::topic_name(const MessageChannel& channel) const {
  if (channel.kind == MessageKind::kTransforms) {
    return channel.topic;
  }
  const bool below_sonar = several_ && channel.kind != MessageKind::kScenario;
  return ros::this_node::getName() + "/" + (below_sonar ? std::string(sonar_of(channel.topic)) + "/" : "") +
         name_of(channel.kind);
}

void RosTransport::open(std::size_t sonar, const std::vector<MessageChannel>& channels) {
  // Queue lengths for slow readers. Messages wait there even where the reader is fast: ROS sends in a thread of its
  // own.
  constexpr int kKept = 4, kKeptTransforms = 100;
  channels_.resize(std::max(channels_.size(), sonar + 1));
  channels_[sonar].clear();
  for (const MessageChannel& channel : channels) {
    if (channel.kind == MessageKind::kTransforms && !transforms_) {
      channels_[sonar].push_back(nullptr);
      continue;
    }
    const std::string name = topic_name(channel);
    Topic& topic = topics_[name];
    if (!topic.publisher) {
      const int kept = channel.kind == MessageKind::kTransforms ? kKeptTransforms : kKept;
      topic.message.morph(channel.md5, channel.type, channel.definition, "");
      topic.publisher = topic.message.advertise(node_, name, lossless_ ? kMostWaiting : kept, channel.latched);
    }
    channels_[sonar].push_back(&topic);
  }
}

bool RosTransport::is_read(std::size_t sonar, std::size_t channel) const {
  const Topic* topic = channels_.at(sonar).at(channel);
  return topic != nullptr && topic->publisher.getNumSubscribers() > 0;
}

void RosTransport::send(std::size_t sonar, std::size_t channel, std::uint64_t /*time_ns*/,
                        const std::vector<std::byte>& message) {
  Topic* topic = channels_.at(sonar).at(channel);
  if (topic == nullptr) {
    return;  // Transforms are not wanted.
  }
  // The stream only reads.
  auto* bytes = reinterpret_cast<std::uint8_t*>(const_cast<std::byte*>(message.data()));
  ros::serialization::IStream stream(bytes, static_cast<std::uint32_t>(message.size()));
  topic->message.read(stream);
  topic->publisher.publish(topic->message);
}

}  // namespace insonify
