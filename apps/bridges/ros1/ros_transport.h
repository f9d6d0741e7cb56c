// ros_transport.h -- publishes the messages of pings on ROS 1 topics.

#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <topic_tools/shape_shifter.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "transport/bridge.h"

namespace insonify {

class RosTransport : public Transport {
 public:
  static constexpr int kMostWaiting = 1000;  ///< Messages of a topic, as many as poses may wait for their pings.

  /// @param transforms  Whether to publish the sonars' poses on /tf.
  /// @param lossless    Whether slow readers get every message, unless kMostWaiting wait.
  RosTransport(bool transforms, bool lossless) : transforms_(transforms), lossless_(lossless) {}

  /// Topics are ~image, ~fan ... for a single sonar, and ~NAME/image ... for several.
  void begin(const LiveWorld& world) override { several_ = world.sonars.size() > 1; }
  void open(std::size_t sonar, const std::vector<MessageChannel>& channels) override;
  [[nodiscard]] bool is_read(std::size_t sonar, std::size_t channel) const override;
  void send(std::size_t sonar, std::size_t channel, std::uint64_t time_ns,
            const std::vector<std::byte>& message) override;

 private:
  struct Topic {
    topic_tools::ShapeShifter message;
    ros::Publisher publisher;
  };

  [[nodiscard]] std::string topic_name(const MessageChannel& channel) const;

  ros::NodeHandle node_;
  bool transforms_, lossless_;
  bool several_ = false;
  std::map<std::string, Topic> topics_;        // By name; kept when a sonar changes.
  std::vector<std::vector<Topic*>> channels_;  // By sonar and channel; null: not published.
};

}  // namespace insonify
