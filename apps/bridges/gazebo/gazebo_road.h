// gazebo_road.h -- publishes the messages of pings on Gazebo's topics, under both names of their types.

#pragma once

#include <cstddef>
#include <cstdint>
#include <ignition/transport/Node.hh>
#include <map>
#include <string>
#include <vector>

#include "road/bridge.h"

namespace insonify {

/// A subscriber of Gazebo Fortress asks for ignition.msgs.Image, a later one for gz.msgs.Image: each topic has a
/// publisher of both, and each sends where it has subscribers. The transport keeps no message for those who come later,
/// so the scenario is sent again when one comes.
class GazeboRoad : public Road {
 public:
  void open(std::size_t sonar, const std::vector<MessageChannel>& channels) override;
  [[nodiscard]] bool is_read(std::size_t sonar, std::size_t channel) const override;
  void send(std::size_t sonar, std::size_t channel, std::uint64_t time_ns,
            const std::vector<std::byte>& message) override;

 private:
  using Publisher = ignition::transport::Node::Publisher;
  struct Topic {
    std::string name, gz_type, ignition_type;
    MessageKind kind = MessageKind::kFan;
    mutable Publisher gz, ignition;
    [[nodiscard]] bool is_read() const { return gz.HasConnections() || ignition.HasConnections(); }
  };

  static void publish(Topic& topic, const std::string& bytes);
  void remind_of_scenario();

  ignition::transport::Node gz_node_, ignition_node_;  // A node has one type a topic.
  std::map<std::string, Topic> topics_;                // By name; stay when a sonar changes.
  std::vector<std::vector<Topic*>> channels_;          // By sonar and channel.
  Topic* scenario_ = nullptr;
  std::string scenario_message_;
  bool scenario_gz_read_ = false, scenario_ignition_read_ = false;
};

}  // namespace insonify
