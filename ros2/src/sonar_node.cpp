// sonar_node.cpp -- parameters and inputs of the component; publish_pings.cpp has its outputs.

#include "sonar_node.h"

#include <algorithm>
#include <array>
#include <future>
#include <rclcpp_components/register_node_macro.hpp>
#include <utility>

namespace insonify_ros2 {
namespace {

using insonify::Error;

rcl_interfaces::msg::ParameterDescriptor described(const std::string& text, bool read_only) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description = text;
  descriptor.read_only = read_only;
  return descriptor;
}

// Waits until the loop has applied them. @return "" or why they are refused.
std::string set_now(insonify::LiveLoop& loop, std::vector<std::string> settings) {
  const auto answer = std::make_shared<std::promise<std::string>>();
  loop.set(std::move(settings), [answer](const std::string& error) { answer->set_value(error); });
  return answer->get_future().get();
}

template <typename From>
insonify::Vec3 vector(const From& from) {
  return {from.x, from.y, from.z};
}

double seconds(const builtin_interfaces::msg::Time& time) {
  return time.sec + 1e-9 * time.nanosec;
}

std::string topic_name(const insonify::LiveWorld& world, const insonify::SonarConfig& sonar) {
  return insonify::message_source(world.scenario, sonar).name;
}

// The settings that a change of parameters asks for. @throws Error for gains out of limits.
struct Change {
  std::vector<std::string> settings;
  std::map<std::size_t, double> gains_db;  // By sonar.
};

Change change_of(const std::vector<rclcpp::Parameter>& parameters, const insonify::LiveWorld& world) {
  constexpr double kHighestGain = 100;  // [dB]
  Change change;
  for (const rclcpp::Parameter& parameter : parameters) {
    if (parameter.get_name() == "settings") {
      const std::vector<std::string> settings = parameter.as_string_array();
      change.settings.insert(change.settings.end(), settings.begin(), settings.end());
    }
    for (std::size_t i = 0; i < world.sonars.size(); ++i) {
      const std::string name = topic_name(world, world.sonars[i]);
      if (parameter.get_name() == name + ".max_range") {
        change.settings.push_back("sonars[" + std::to_string(i) +
                                  "].max_range=" + std::to_string(parameter.as_double()));
      } else if (parameter.get_name() == name + ".gain_db") {
        if (!(std::abs(parameter.as_double()) <= kHighestGain)) {
          throw Error(parameter.get_name() + " must be from -100 to 100 dB");
        }
        change.gains_db[i] = parameter.as_double();
      }
    }
  }
  return change;
}

}  // namespace

SonarNode::SonarNode(const rclcpp::NodeOptions& options) : rclcpp::Node("insonify", options) {
  const insonify::LiveSenderOptions sender_options = declare_constants();
  insonify::Transport& topics = *this;
  sender_ = std::make_unique<insonify::LiveSender>(get_parameter("scenario").as_string(),
                                                   get_parameter("settings").as_string_array(), sender_options, topics,
                                                   [this](insonify::Severity severity, const std::string& text) {
                                                     if (severity == insonify::Severity::kWarning) {
                                                       warn(text);
                                                     } else {
                                                       RCLCPP_INFO(get_logger(), "%s", text.c_str());
                                                     }
                                                   });
  try {
    sender_->start();
    declare_settings();
    on_change_ = add_on_set_parameters_callback(
        [this](const std::vector<rclcpp::Parameter>& parameters) { return change(parameters); });
    subscribe();
  } catch (...) {
    end();
    throw;
  }
}

SonarNode::~SonarNode() {
  end();
}

void SonarNode::end() {
  odometry_.reset();
  asked_.reset();
  clock_.reset();
  sender_->end();
}

insonify::LiveSenderOptions SonarNode::declare_constants() {
  declare_parameter("scenario", std::string(), described("Scenario file", true));
  declare_parameter("settings", std::vector<std::string>(),
                    described("Changes of the scenario's keys, KEY=VALUE each", false));
  declare_parameter("rate", 0.0, described("Most pings a second of each sonar; 0: those of the sonar [Hz]", true));
  declare_parameter("odometry", std::string(), described("Topic of nav_msgs/Odometry with the vehicle's pose", true));
  declare_parameter("ping_at", std::string(), described("Topic of geometry_msgs/PoseStamped, a ping for each", true));
  declare_parameter("at_once", false, described("Whether pings do not wait for their last echo", true));
  insonify::LiveSenderOptions options;
  options.messages.bits = static_cast<int>(
      declare_parameter("bits", std::int64_t{8}, described("Bits of a value of an image: 8 or 16", true)));
  options.messages.world_frame =
      declare_parameter("world_frame", std::string("world"), described("Frame of the world", true));
  options.messages.vehicle_frame =
      declare_parameter("vehicle_frame", std::string(), described("Frame of the vehicle, for /tf_static", true));
  options.messages.raw = options.messages.live = true;
  options.at_once = get_parameter("at_once").as_bool();
  const bool on_request = !get_parameter("ping_at").as_string().empty();
  const bool follows = !get_parameter("odometry").as_string().empty();
  if (on_request && follows) {
    throw Error("ping_at and odometry exclude each other");
  }
  clocked_ = !on_request && get_parameter("use_sim_time").as_bool();
  options.live.on_request = options.lossless = on_request;
  options.live.driven = on_request || follows;
  options.live.clocked = clocked_;
  if (const double rate = get_parameter("rate").as_double(); rate > 0) {
    options.live.rate_limit = rate;
  }
  options.on_note = [this](const std::string& text) { warn(text); };
  return options;
}

// Values that were given at the start are applied.
void SonarNode::declare_settings() {
  const auto world = sender_->loop().world();
  std::vector<rclcpp::Parameter> given;
  for (const insonify::SonarConfig& sonar : world->sonars) {
    const std::string range = topic_name(*world, sonar) + ".max_range", gain = topic_name(*world, sonar) + ".gain_db";
    if (declare_parameter(range, sonar.max_range, described("Far edge of the last bin [m]", false)) !=
        sonar.max_range) {
      given.push_back(get_parameter(range));
    }
    if (declare_parameter(gain, 0.0, described("Raises the levels of images [dB]", false)) != 0) {
      given.push_back(get_parameter(gain));
    }
  }
  if (const auto applied = change(given); !applied.successful) {
    throw Error(applied.reason);
  }
}

void SonarNode::subscribe() {
  constexpr std::size_t kAll = 1000;
  if (const std::string topic = get_parameter("odometry").as_string(); !topic.empty()) {
    odometry_ = create_subscription<nav_msgs::msg::Odometry>(
        topic, rclcpp::SensorDataQoS(), [this](const nav_msgs::msg::Odometry& message) {
          const auto& twist = message.twist.twist;
          drive(message.pose.pose, {vector(twist.linear), vector(twist.angular)}, seconds(message.header.stamp));
        });
  }
  if (!get_parameter("ping_at").as_string().empty()) {
    asked_ = create_subscription<geometry_msgs::msg::PoseStamped>(
        get_parameter("ping_at").as_string(), rclcpp::QoS(kAll).reliable(),
        [this](const geometry_msgs::msg::PoseStamped& message) {
          drive(message.pose, {}, seconds(message.header.stamp));
        });
  }
  if (clocked_) {
    clock_ = create_subscription<rosgraph_msgs::msg::Clock>(
        "/clock", rclcpp::ClockQoS(),
        [this](const rosgraph_msgs::msg::Clock& message) { sender_->loop().advance(seconds(message.clock)); });
  }
}

// A message without a stamp counts as current.
void SonarNode::drive(const geometry_msgs::msg::Pose& pose, const insonify::Twist& twist_in_vehicle, double stamp) {
  const auto& turn = pose.orientation;
  const Eigen::Quaterniond orientation(turn.w, turn.x, turn.y, turn.z);
  std::string refusal;
  try {
    sender_->loop().drive({.world_from_vehicle = {vector(pose.position), orientation},
                           .twist = {orientation * twist_in_vehicle.linear, orientation * twist_in_vehicle.angular},
                           .stamp = stamp != 0 || clocked_ ? stamp : now().seconds()});
  } catch (const Error& error) {
    refusal = error.what();
  }
  if (!refusal.empty() && refusal != last_refusal_) {
    warn(refusal);
  }
  last_refusal_ = refusal;
}

// All parameters are applied or none.
rcl_interfaces::msg::SetParametersResult SonarNode::change(const std::vector<rclcpp::Parameter>& parameters) {
  rcl_interfaces::msg::SetParametersResult result;
  try {
    const Change change = change_of(parameters, *sender_->loop().world());
    result.reason = change.settings.empty() ? "" : set_now(sender_->loop(), change.settings);
    if (result.reason.empty()) {
      for (const auto& [sonar, gain] : change.gains_db) {
        sender_->set_gain(sonar, gain);
      }
    }
  } catch (const std::exception& error) {
    result.reason = error.what();
  }
  result.successful = result.reason.empty();
  return result;
}

void SonarNode::warn(const std::string& text) {
  RCLCPP_WARN(get_logger(), "%s", text.c_str());
}

}  // namespace insonify_ros2

RCLCPP_COMPONENTS_REGISTER_NODE(insonify_ros2::SonarNode)
