// message_channels.cpp -- topics and types of the messages about one sonar.

#include "io/message/message_channels.h"

#include <utility>

#include "io/message/definitions.h"

namespace insonify {
namespace {

std::string_view gazebo_type(MessageKind kind) {
  switch (kind) {
    case MessageKind::kPoints:
      return "gz.msgs.PointCloudPacked";
    case MessageKind::kPose:
      return "gz.msgs.Pose";
    case MessageKind::kTransforms:
      return "gz.msgs.Pose_V";
    case MessageKind::kScenario:
      return "gz.msgs.StringMsg";
    case MessageKind::kSonarImage:
    case MessageKind::kFan:
    case MessageKind::kRaw:
      break;
  }
  return "gz.msgs.Image";
}

}  // namespace

std::vector<MessageChannel> message_channels(const std::string& name, MessageForm form, bool raw) {
  const std::string at = "/" + name;
  const auto channel = [form](MessageKind kind, std::string topic, const std::string& package,
                              const std::string& type) -> MessageChannel {
    if (form == MessageForm::kGazebo) {
      return {kind, std::move(topic), std::string(gazebo_type(kind)), ""};
    }
    const std::string whole = package + "/" + type;
    const std::string definition = message_definition(whole, form);
    return form == MessageForm::kRos1
               ? MessageChannel{kind, std::move(topic), whole, definition, std::string(ros1_checksum(whole))}
               : MessageChannel{kind, std::move(topic), package + "/msg/" + type, definition};
  };
  std::vector<MessageChannel> channels = {
      channel(MessageKind::kSonarImage, at + "/sonar_image", "marine_acoustic_msgs", "ProjectedSonarImage"),
      channel(MessageKind::kFan, at + "/fan", "sensor_msgs", "Image"),
      channel(MessageKind::kPoints, at + "/points", "sensor_msgs", "PointCloud2"),
      channel(MessageKind::kPose, at + "/pose", "geometry_msgs", "PoseStamped"),
      channel(MessageKind::kTransforms, "/tf", "tf2_msgs", "TFMessage"),
      channel(MessageKind::kScenario, "/scenario", "std_msgs", "String")};
  if (raw) {
    channels.push_back(channel(MessageKind::kRaw, at + "/raw", "sensor_msgs", "Image"));
  }
  return channels;
}

}  // namespace insonify
