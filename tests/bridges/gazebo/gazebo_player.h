// gazebo_player.h -- stands in for Gazebo's SceneBroadcaster, which publishes a world.

#pragma once

#include <ignition/msgs/pose_v.pb.h>
#include <ignition/msgs/scene.pb.h>

#include <cstdint>
#include <ignition/transport/Node.hh>
#include <mutex>
#include <string>

#include "insonify/geometry.h"

namespace insonify {

/// A model has one link called "link", whose id is the next, with one visual called "visual", whose id is the one
/// after.
class GazeboPlayer {
 public:
  /// @param newer  Whether types are called gz.msgs, as since Garden, or ignition.msgs.
  GazeboPlayer(const std::string& world, bool newer);

  /// Adds a model, and announces it on the topic scene/info.
  /// @param geometry  "box 1 2 3", "sphere 0.5", "mesh FILE", "cylinder 0.5 2", "empty".
  void add(std::uint32_t id, const std::string& name, const Pose& pose, bool is_static, const std::string& geometry);
  /// The same without a message: as one that was lost.
  void add_in_silence(std::uint32_t id, const std::string& name, const Pose& pose, bool is_static,
                      const std::string& geometry);
  /// Removes a model, and announces it on the topic scene/deletion.
  void remove(std::uint32_t id);
  void remove_in_silence(std::uint32_t id);
  /// Moves a model, or its link or visual.
  void move(std::uint32_t id, const Pose& pose);
  /// Publishes all poses, and those of models that are not static.
  void tell_poses(double time);

  /// Whether somebody reads the poses.
  [[nodiscard]] bool is_followed() const { return poses_.HasConnections() && dynamic_poses_.HasConnections(); }

 private:
  using Publisher = ignition::transport::Node::Publisher;
  Publisher advertise(const std::string& topic, const std::string& type);
  template <typename Message>
  void publish(Publisher& publisher, const Message& message);

  bool newer_;
  std::mutex mutex_;
  ignition::msgs::Scene scene_;
  Publisher poses_, dynamic_poses_, new_models_, deletions_;
  ignition::transport::Node node_;  // Last: its callbacks use the others.
};

}  // namespace insonify
