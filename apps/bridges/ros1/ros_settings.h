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

#include "ros1/ros_reconfigure.h"
#include "transport/bridge.h"

namespace insonify {

/// Range and gain of one sonar, as parameters of dynamic_reconfigure.
class RosSonarSettings {
 public:
  /// @param node   Provides the namespace.
  /// @param sonar  Index into the world's sonars.
  RosSonarSettings(ros::NodeHandle node, std::size_t sonar, Bridge& bridge);

  /// @throws InputError for an invalid gain.
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
  bool has_gain_;      // Whether image values are decibels.
  double gain_db_ = 0;
  std::unique_ptr<RosReconfigure> server_;
};

/// The settings of all sonars, in a thread of its own: a change of range waits until the loop has applied it.
class RosSettings {
 public:
  /// Initial gains come from the parameters ~NAME/gain, or else ~gain.
  /// @param bridge  Must be started, and outlive this.
  /// @throws InputError for an invalid parameter.
  explicit RosSettings(Bridge& bridge);
  ~RosSettings() { end(); }
  RosSettings(const RosSettings&) = delete;
  RosSettings& operator=(const RosSettings&) = delete;

  /// To be called after Bridge::end(), which answers pending requests.
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
