// gazebo_player.h -- stands in for Gazebo's SceneBroadcaster, which publishes a world.

#pragma once

#include <ignition/msgs/pose_v.pb.h>
#include <ignition/msgs/scene.pb.h>

#include <cstdint>
#include <ignition/transport/Node.hh>
#include <mutex>
#include <string>
#include <thread>

#include "insonify/geometry.h"

namespace insonify {

/// A model has one link called "link", whose id is the next, with one visual called "visual", whose id is the one
/// after.
class GazeboPlayer {
 public:
  /// @param newer  Whether types are called gz.msgs, as since Garden, or ignition.msgs.
  GazeboPlayer(const std::string& world, bool newer);
  GazeboPlayer(const GazeboPlayer&) = delete;
  GazeboPlayer& operator=(const GazeboPlayer&) = delete;

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

  /// Publishes poses all the time from now on, as a paused world does, and makes steps when the world's control service
  /// is called.
  /// @param id     Model that moves along x.
  /// @param step   [s]
  /// @param speed  [m/s]
  void live(std::uint32_t id, double step, double speed);

  /// Whether somebody reads the poses.
  [[nodiscard]] bool is_followed() const { return poses_.HasConnections() && dynamic_poses_.HasConnections(); }

 private:
  using Publisher = ignition::transport::Node::Publisher;
  Publisher advertise(const std::string& topic, const std::string& type);
  void tell_poses();
  void serve_control(const std::string& service);
  bool make_steps(unsigned count);
  template <typename Message>
  void publish(Publisher& publisher, const Message& message);

  bool newer_;
  std::mutex mutex_;
  ignition::msgs::Scene scene_;
  std::uint32_t moving_ = 0;                // Model, with live().
  double time_ = 1, step_ = 0, speed_ = 0;  // [s], [m/s]
  Publisher poses_, dynamic_poses_, new_models_, deletions_;
  ignition::transport::Node node_;  // Behind those that its callbacks use.
  std::jthread living_;
};

}  // namespace insonify
