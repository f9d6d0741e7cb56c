// ros_settings.h -- changes of settings while the node runs: dynamic_reconfigure, and a topic.

#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "road/bridge.h"
#include "ros1/ros_reconfigure.h"

namespace insonify {

/// Range and gain of one sonar, as parameters of dynamic_reconfigure.
class RosSonarSettings {
 public:
  /// @param node   Its namespace holds them.
  /// @param sonar  Index into the world's sonars.
  RosSonarSettings(ros::NodeHandle node, std::size_t sonar, Bridge& bridge);

  /// @throws InputError for a gain that is wrong.
  void start(double gain_db);

  [[nodiscard]] std::string service() const { return server_->service(); }

 private:
  [[nodiscard]] std::vector<RosSetting> read() const;
  void set(const std::string& name, double value);
  [[nodiscard]] SonarConfig sonar_now() const { return bridge_.loop().world()->sonars[sonar_]; }

  ros::NodeHandle node_;
  std::size_t sonar_;
  Bridge& bridge_;
  SonarConfig given_;  // At the start.
  bool has_gain_;      // Whether values are decibels.
  double gain_db_ = 0;
  std::unique_ptr<RosReconfigure> server_;
};

/// The settings of all sonars, in a thread of their own: a change of range waits until the loop has done it.
class RosSettings {
 public:
  /// The parameters ~NAME/gain, or else ~gain, tell the gains at the start.
  /// @param bridge  Must be started, and outlive this.
  /// @throws InputError for a parameter that is wrong.
  explicit RosSettings(Bridge& bridge);
  ~RosSettings() { end(); }
  RosSettings(const RosSettings&) = delete;
  RosSettings& operator=(const RosSettings&) = delete;

  /// After Bridge::end(), which answers what waits.
  void end() { spinner_.stop(); }

  /// Names of the services.
  [[nodiscard]] std::vector<std::string> services() const;

 private:
  Bridge& bridge_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_{"~"};
  std::vector<std::unique_ptr<RosSonarSettings>> sonars_;
  std::function<void(const std::string&)> answer_;
  ros::Subscriber settings_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

}  // namespace insonify
