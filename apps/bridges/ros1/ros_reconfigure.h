// ros_reconfigure.h -- a dynamic_reconfigure server for numbers. For C++17 and C++20, as ros_topics.h.

#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace insonify {

/// One parameter, as rqt_reconfigure shows it.
struct RosSetting {
  std::string name, description;
  double value = 0;
  double least = 0, most = 0;  ///< Ends of the slider.
};

/// Serves ~set_parameters, and publishes ~parameter_descriptions and ~parameter_updates.
class RosReconfigure {
 public:
  using Read = std::function<std::vector<RosSetting>()>;
  using Set = std::function<void(const std::string& name, double value)>;

  /// @param node  Provides the namespace and the callback queue that handles requests.
  /// @param read  Returns the current settings.
  /// @param set   Changes one; exceptions are returned to the client.
  RosReconfigure(ros::NodeHandle& node, Read read, Set set);
  ~RosReconfigure();
  RosReconfigure(const RosReconfigure&) = delete;
  RosReconfigure& operator=(const RosReconfigure&) = delete;

  /// Name of the service.
  [[nodiscard]] std::string service() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
