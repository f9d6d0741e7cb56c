// gazebo_transport.h -- publishes the messages of pings on Gazebo topics, under both names of their types.

#pragma once

#include <cstddef>
#include <cstdint>
#include <ignition/transport/Node.hh>
#include <map>
#include <string>
#include <vector>

#include "transport/bridge.h"

namespace insonify {

/// Subscribers of Gazebo Fortress request ignition.msgs.Image, later ones gz.msgs.Image: each topic has a publisher of
/// either type, which sends if it has subscribers. Gazebo's transport stores no message for late subscribers, so the
/// scenario is sent again when one appears.
class GazeboTransport : public Transport {
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

  ignition::transport::Node gz_node_, ignition_node_;  // A node has one type per topic.
  std::map<std::string, Topic> topics_;                // By name; kept when a sonar changes.
  std::vector<std::vector<Topic*>> channels_;          // By sonar and channel.
  Topic* scenario_ = nullptr;
  std::string scenario_message_;
  bool scenario_gz_read_ = false, scenario_ignition_read_ = false;
};

}  // namespace insonify
