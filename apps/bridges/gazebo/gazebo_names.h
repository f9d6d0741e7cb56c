// gazebo_names.h -- names of types, services and environment variables in Gazebo Fortress and later.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// "ignition.msgs.Image" for "gz.msgs.Image".
[[nodiscard]] std::string ignition_type_name(std::string_view gz_type);

/// The world of a service "/world/NAME/scene/info"; empty for any other.
[[nodiscard]] std::optional<std::string> world_of_service(std::string_view service);

/// Topics and services of a world.
struct WorldTopics {
  explicit WorldTopics(const std::string& world)
      : scene("/world/" + world + "/scene/info"),
        deletion("/world/" + world + "/scene/deletion"),
        poses("/world/" + world + "/pose/info"),
        dynamic_poses("/world/" + world + "/dynamic_pose/info"),
        control("/world/" + world + "/control") {}
  std::string scene;     ///< Scene: a service for the whole scene, and a topic of additions.
  std::string deletion;  ///< UInt32_V: ids of removed models.
  std::string poses,
      dynamic_poses;    ///< Pose_V, each pose in its parent's frame; dynamic: of entities that are not static.
  std::string control;  ///< WorldControl: a service that pauses and steps.
};

/// Makes the transport honour the variables of newer Gazebo releases: GZ_PARTITION etc. where IGN_PARTITION etc. is not
/// set. To be called before the first node is made.
void copy_gz_environment();

/// The partition of the nodes; "": the default one.
[[nodiscard]] std::string gazebo_partition();

}  // namespace insonify
