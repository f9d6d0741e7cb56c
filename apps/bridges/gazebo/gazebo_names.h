// gazebo_names.h -- names of types and services in both generations of Gazebo.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// "gz.msgs.Image" as "ignition.msgs.Image".
[[nodiscard]] std::string ignition_type_name(std::string_view gz_type);

/// The world of a service "/world/NAME/scene/info"; empty for any other.
[[nodiscard]] std::optional<std::string> world_of_service(std::string_view service);

/// What a world publishes and serves.
struct WorldTopics {
  explicit WorldTopics(const std::string& world)
      : scene("/world/" + world + "/scene/info"),
        deletion("/world/" + world + "/scene/deletion"),
        poses("/world/" + world + "/pose/info"),
        dynamic_poses("/world/" + world + "/dynamic_pose/info") {}
  std::string scene;                 ///< Scene: a service that gives all there is, and a topic with what is new.
  std::string deletion;              ///< UInt32_V: ids of models that are gone.
  std::string poses, dynamic_poses;  ///< Pose_V, each pose in its parent's frame; the second of what is not static.
};

}  // namespace insonify
