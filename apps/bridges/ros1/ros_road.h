// ros_road.h -- publishes the messages of pings as topics of ROS 1.

#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <topic_tools/shape_shifter.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "road/bridge.h"

namespace insonify {

class RosRoad : public Road {
 public:
  /// @param transforms  Whether /tf has where the sonars are.
  explicit RosRoad(bool transforms) : transforms_(transforms) {}

  /// The topics of a single sonar are ~image, ~fan ...; those of several are ~NAME/image ...
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
  bool transforms_;
  bool several_ = false;
  std::map<std::string, Topic> topics_;        // By name; stay when a sonar changes.
  std::vector<std::vector<Topic*>> channels_;  // By sonar and channel; null for what is not published.
};

}  // namespace insonify
