// message_channels.cpp -- topics of messages, the field lists of their types, and the order in which a definition lists
// these.

#include "io/message/message_channels.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "io/message/ros1_texts.h"

namespace insonify {
namespace {

constexpr std::pair<std::string_view, std::string_view> kTypes[] = {
    {"builtin_interfaces/Time",
     "int32 sec\n"
     "uint32 nanosec\n"},
    {"std_msgs/Header",
     "builtin_interfaces/Time stamp\n"
     "string frame_id\n"},
    {"std_msgs/String", "string data\n"},
    {"geometry_msgs/Point",
     "float64 x\n"
     "float64 y\n"
     "float64 z\n"},
    {"geometry_msgs/Vector3",
     "float64 x\n"
     "float64 y\n"
     "float64 z\n"},
    {"geometry_msgs/Quaternion",
     "float64 x\n"
     "float64 y\n"
     "float64 z\n"
     "float64 w\n"},
    {"geometry_msgs/Pose",
     "geometry_msgs/Point position\n"
     "geometry_msgs/Quaternion orientation\n"},
    {"geometry_msgs/PoseStamped",
     "std_msgs/Header header\n"
     "geometry_msgs/Pose pose\n"},
    {"geometry_msgs/Transform",
     "geometry_msgs/Vector3 translation\n"
     "geometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\n"
     "string child_frame_id\n"
     "geometry_msgs/Transform transform\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"sensor_msgs/Image",
     "std_msgs/Header header\n"
     "uint32 height\n"
     "uint32 width\n"
     "string encoding\n"
     "uint8 is_bigendian\n"
     "uint32 step\n"
     "uint8[] data\n"},
    {"sensor_msgs/PointField",
     "uint8 INT8=1\n"
     "uint8 UINT8=2\n"
     "uint8 INT16=3\n"
     "uint8 UINT16=4\n"
     "uint8 INT32=5\n"
     "uint8 UINT32=6\n"
     "uint8 FLOAT32=7\n"
     "uint8 FLOAT64=8\n"
     "string name\n"
     "uint32 offset\n"
     "uint8 datatype\n"
     "uint32 count\n"},
    {"sensor_msgs/PointCloud2",
     "std_msgs/Header header\n"
     "uint32 height\n"
     "uint32 width\n"
     "sensor_msgs/PointField[] fields\n"
     "bool is_bigendian\n"
     "uint32 point_step\n"
     "uint32 row_step\n"
     "uint8[] data\n"
     "bool is_dense\n"},
    {"sensor_msgs/LaserScan",
     "std_msgs/Header header\n"
     "float32 angle_min\n"
     "float32 angle_max\n"
     "float32 angle_increment\n"
     "float32 time_increment\n"
     "float32 scan_time\n"
     "float32 range_min\n"
     "float32 range_max\n"
     "float32[] ranges\n"
     "float32[] intensities\n"},
    {"marine_acoustic_msgs/PingInfo",
     "float32 frequency\n"
     "float32 sound_speed\n"
     "float32[] tx_beamwidths\n"
     "float32[] rx_beamwidths\n"},
    {"marine_acoustic_msgs/SonarImageData",
     "bool is_bigendian\n"
     "uint32 DTYPE_UINT8=0\n"
     "uint32 DTYPE_INT8=1\n"
     "uint32 DTYPE_UINT16=2\n"
     "uint32 DTYPE_INT16=3\n"
     "uint32 DTYPE_UINT32=4\n"
     "uint32 DTYPE_INT32=5\n"
     "uint32 DTYPE_UINT64=6\n"
     "uint32 DTYPE_INT64=7\n"
     "uint32 DTYPE_FLOAT32=8\n"
     "uint32 DTYPE_FLOAT64=9\n"
     "uint32 dtype\n"
     "uint32 beam_count\n"
     "uint8[] data\n"},
    {"marine_acoustic_msgs/ProjectedSonarImage",
     "std_msgs/Header header\n"
     "marine_acoustic_msgs/PingInfo ping_info\n"
     "geometry_msgs/Vector3[] beam_directions\n"
     "float32[] ranges\n"
     "marine_acoustic_msgs/SonarImageData image\n"},
    {"marine_acoustic_msgs/RawSonarImage",
     "std_msgs/Header header\n"
     "marine_acoustic_msgs/PingInfo ping_info\n"
     "float32 sample_rate\n"
     "uint32 samples_per_beam\n"
     "uint32 sample0\n"
     "float32[] tx_delays\n"
     "float32[] tx_angles\n"
     "float32[] rx_angles\n"
     "marine_acoustic_msgs/SonarImageData image\n"},
    {"marine_acoustic_msgs/DetectionFlag",
     "uint8 DETECT_OK=0\n"
     "uint8 DETECT_BAD_SONAR=1\n"
     "uint8 DETECT_BAD_FILTER=2\n"
     "uint8 DETECT_BAD_USER=4\n"
     "uint8 flag\n"},
    {"marine_acoustic_msgs/SonarDetections",
     "std_msgs/Header header\n"
     "marine_acoustic_msgs/PingInfo ping_info\n"
     "marine_acoustic_msgs/DetectionFlag[] flags\n"
     "float32[] two_way_travel_times\n"
     "float32[] tx_delays\n"
     "float32[] intensities\n"
     "float32[] tx_angles\n"
     "float32[] rx_angles\n"},
};

// Where ROS 1 differs.
constexpr std::pair<std::string_view, std::string_view> kRos1Header = {"std_msgs/Header",
                                                                       "uint32 seq\n"
                                                                       "time stamp\n"
                                                                       "string frame_id\n"};

// MD5 of a definition with each type in it as the MD5 of its own.
constexpr std::pair<std::string_view, std::string_view> kRos1Checksums[] = {
    {"geometry_msgs/PoseStamped", "d3812c3cbc69362b77dc0b19b345f8f5"},
    {"marine_acoustic_msgs/ProjectedSonarImage", "c72fc8e29ab227a547720a36666022fd"},
    {"marine_acoustic_msgs/RawSonarImage", "84d7210aa67320a9262e0908f3e466c5"},
    {"marine_acoustic_msgs/SonarDetections", "588993519ccaab99fb0df80256b440ff"},
    {"sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743"},
    {"sensor_msgs/LaserScan", "90c7ef2dc6895d81024acba2ac42f369"},
    {"sensor_msgs/PointCloud2", "1158d486dd51d683ce2f1be655c3c181"},
    {"std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1"},
    {"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec"},
};

// nullptr for a type that is not in the list, such as float64.
const std::pair<std::string_view, std::string_view>* find(std::string_view type, MessageForm form) {
  if (form == MessageForm::kRos1 && type == kRos1Header.first) {
    return &kRos1Header;
  }
  const auto* const found = std::ranges::find_if(kTypes, [&](const auto& entry) { return entry.first == type; });
  return found == std::end(kTypes) ? nullptr : found;
}

// Adds a type and, after it, those of its fields; each once.
void collect(std::string_view type, MessageForm form, std::vector<std::string_view>& types) {
  const auto* const entry = find(type, form);
  if (entry == nullptr || std::ranges::find(types, type) != types.end()) {
    return;
  }
  types.push_back(type);
  for (std::string_view rest = entry->second; !rest.empty(); rest.remove_prefix(rest.find('\n') + 1)) {
    collect(rest.substr(0, rest.find_first_of(" [")), form, types);
  }
}

// A type's part of a definition. An empty line follows it in ROS 1.
std::string text_of(std::string_view type, MessageForm form) {
  const std::string_view fields = find(type, form)->second;
  if (form != MessageForm::kRos1) {
    return std::string(fields);
  }
  const std::string_view text = ros1_text(type);
  return std::string(text.empty() ? fields : text) + "\n";
}

std::string_view gazebo_type(MessageKind kind) {
  switch (kind) {
    case MessageKind::kPoints:
    case MessageKind::kTruePoints:
    case MessageKind::kSoundings:
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
    case MessageKind::kLabels:  // These are ROS's alone.
    case MessageKind::kDescription:
    case MessageKind::kScan:
    case MessageKind::kRawImage:
    case MessageKind::kDetections:
      break;
  }
  return "gz.msgs.Image";
}

}  // namespace

std::string message_definition(std::string_view type, MessageForm form) {
  assert(find(type, form) != nullptr);
  std::vector<std::string_view> types;
  collect(type, form, types);
  std::string text;
  for (const std::string_view each : types) {
    if (!text.empty()) {
      text.append(80, '=').append("\nMSG: ").append(each).append("\n");
    }
    text.append(text_of(each, form));
  }
  return text;
}

std::string_view ros1_checksum(std::string_view type) {
  const auto* const found =
      std::ranges::find_if(kRos1Checksums, [&](const auto& entry) { return entry.first == type; });
  assert(found != std::end(kRos1Checksums));
  return found->second;
}

std::vector<MessageChannel> message_channels(const std::string& name, MessageForm form, const MessageOptions& options,
                                             const SonarConfig& sonar) {
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
      channel(MessageKind::kTruePoints, at + "/true_points", "sensor_msgs", "PointCloud2"),
      channel(MessageKind::kPose, at + "/pose", "geometry_msgs", "PoseStamped"),
      channel(MessageKind::kTransforms, options.vehicle_frame.empty() ? "/tf" : "/tf_static", "tf2_msgs", "TFMessage"),
      channel(MessageKind::kScenario, "/scenario", "std_msgs", "String")};
  if (options.raw) {
    channels.push_back(channel(MessageKind::kRaw, at + "/raw", "sensor_msgs", "Image"));
  }
  if (options.live) {
    channels.push_back(channel(MessageKind::kLabels, at + "/labels", "sensor_msgs", "Image"));
    channels.push_back(channel(MessageKind::kDescription, at + "/description", "std_msgs", "String"));
  }
  if (options.live && sonar.scans()) {
    channels.push_back(channel(MessageKind::kScan, at + "/scan", "sensor_msgs", "LaserScan"));
  }
  if (sonar.is_side_scan() && form != MessageForm::kGazebo) {
    channels.push_back(
        channel(MessageKind::kRawImage, at + "/raw_sonar_image", "marine_acoustic_msgs", "RawSonarImage"));
  }
  if (sonar.is_multibeam() && form != MessageForm::kGazebo) {
    channels.push_back(
        channel(MessageKind::kDetections, at + "/detections", "marine_acoustic_msgs", "SonarDetections"));
  }
  if (sonar.is_multibeam()) {
    channels.push_back(channel(MessageKind::kSoundings, at + "/soundings", "sensor_msgs", "PointCloud2"));
  }
  for (MessageChannel& each : channels) {
    each.latched =
        each.kind == MessageKind::kScenario || each.kind == MessageKind::kDescription || each.topic == "/tf_static";
  }
  return channels;
}

}  // namespace insonify
