// ros_pings.h -- the services ~ping: a ping for a pose, with its image as the answer.

#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/spinner.h>

#include <cstddef>
#include <string>
#include <vector>

#include "ros1/ros_topics.h"
#include "transport/bridge.h"

namespace insonify {

/// ~ping for a single sonar, ~NAME/ping for several; one request after another, in a thread of its own.
class RosPings {
 public:
  /// @param bridge       Makes pings on request; must be started, and outlive this.
  /// @param world_frame  Frame of poses; others are refused.
  RosPings(Bridge& bridge, const std::string& world_frame);
  ~RosPings() { end(); }
  RosPings(const RosPings&) = delete;
  RosPings& operator=(const RosPings&) = delete;

  /// To be called after Bridge::end(), which answers pending requests.
  void end() { spinner_.stop(); }

  /// Names of the services.
  [[nodiscard]] std::vector<std::string> services() const;

 private:
  [[nodiscard]] std::vector<std::byte> make(std::size_t sonar, const RosPlace& place) const;

  Bridge& bridge_;
  std::string world_frame_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_{"~"};
  std::vector<ros::ServiceServer> services_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

}  // namespace insonify
