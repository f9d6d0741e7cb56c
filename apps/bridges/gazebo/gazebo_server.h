// gazebo_server.h -- finds a running Gazebo and asks it for its scene.

#pragma once

#include <ignition/msgs/scene.pb.h>

#include <ignition/transport/Node.hh>
#include <optional>
#include <string>
#include <vector>

namespace insonify {

/// A world that Gazebo serves.
struct ServedWorld {
  std::string name;
  std::string process;      ///< Differs after each start of Gazebo.
  bool newer = false;       ///< Whether its types are called gz.msgs.
  std::size_t servers = 1;  ///< Processes that serve a world of this name, one that died some seconds ago included.
};

class GazeboServer {
 public:
  explicit GazeboServer(ignition::transport::Node& node) : node_(node) {}

  /// Worlds that run now, in alphabetical order.
  [[nodiscard]] std::vector<ServedWorld> worlds() const;

  /// The scene of a world; empty without an answer within half a second.
  [[nodiscard]] std::optional<ignition::msgs::Scene> scene(const ServedWorld& world);

  /// Has a world make some steps of its physics and then pause.
  /// @return  Whether it will.
  [[nodiscard]] bool step(const ServedWorld& world, unsigned steps);

 private:
  ignition::transport::Node& node_;
};

}  // namespace insonify
