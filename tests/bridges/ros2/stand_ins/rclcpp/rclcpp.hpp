// rclcpp.hpp -- stands for the part of ROS 2's rclcpp that ros2/src uses, with its signatures, in one process without
// middleware.

#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rcl_interfaces::msg {

struct ParameterDescriptor {
  std::string description;
  bool read_only = false;
};

struct SetParametersResult {
  bool successful = false;
  std::string reason;
};

}  // namespace rcl_interfaces::msg

struct rcl_serialized_message_t {
  std::uint8_t* buffer = nullptr;
  std::size_t buffer_length = 0;
};

namespace rclcpp {

class SerializedMessage {
 public:
  explicit SerializedMessage(std::size_t capacity) : bytes_(capacity) { raw_.buffer = bytes_.data(); }
  SerializedMessage(const SerializedMessage&) = delete;
  SerializedMessage(SerializedMessage&&) = default;
  rcl_serialized_message_t& get_rcl_serialized_message() { return raw_; }
  const rcl_serialized_message_t& get_rcl_serialized_message() const { return raw_; }

 private:
  std::vector<std::uint8_t> bytes_;
  rcl_serialized_message_t raw_;
};

class QoS {
 public:
  explicit QoS(std::size_t depth) : depth(depth) {}
  QoS& reliable() { return *this; }
  QoS& transient_local() {
    is_latched = true;
    return *this;
  }
  std::size_t depth;
  bool is_latched = false;
};

struct SensorDataQoS : QoS {
  SensorDataQoS() : QoS(5) {}
};

struct ClockQoS : QoS {
  ClockQoS() : QoS(1) {}
};

using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>>;

class Parameter {
 public:
  Parameter(std::string name, Value value) : name_(std::move(name)), value_(std::move(value)) {}
  const std::string& get_name() const { return name_; }
  const Value& value() const { return value_; }
  bool as_bool() const { return std::get<bool>(value_); }
  double as_double() const { return std::get<double>(value_); }
  std::string as_string() const { return std::get<std::string>(value_); }
  std::vector<std::string> as_string_array() const { return std::get<std::vector<std::string>>(value_); }

 private:
  std::string name_;
  Value value_;
};

class NodeOptions {
 public:
  std::vector<Parameter>& parameter_overrides() { return overrides_; }
  const std::vector<Parameter>& parameter_overrides() const { return overrides_; }

 private:
  std::vector<Parameter> overrides_;
};

/// What a test sees of the graph: messages by topic, and the topics that are read.
struct Graph {
  struct Topic {
    std::string type;
    bool is_latched = false;
    std::vector<std::vector<std::uint8_t>> messages;
  };
  std::mutex mutex;
  std::condition_variable changed;  // A message has been published.
  std::map<std::string, Topic> topics;
  std::map<std::string, std::function<void(const void*)>> subscribers;
  std::vector<std::string> warnings;
  std::string absent_package;  // Its types have no library.
};

inline Graph& graph() {
  static Graph all;
  return all;
}

class GenericPublisher {
 public:
  using SharedPtr = std::shared_ptr<GenericPublisher>;
  explicit GenericPublisher(std::string topic) : topic_(std::move(topic)) {}
  std::size_t get_subscription_count() const { return 1; }
  void publish(const SerializedMessage& message) {
    const rcl_serialized_message_t& raw = message.get_rcl_serialized_message();
    const std::lock_guard lock(graph().mutex);
    graph().topics[topic_].messages.emplace_back(raw.buffer, raw.buffer + raw.buffer_length);
    graph().changed.notify_all();
  }

 private:
  std::string topic_;
};

template <typename Message>
struct Subscription {
  using SharedPtr = std::shared_ptr<Subscription>;
};

struct Logger {};

struct Time {
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  }
};

namespace node_interfaces {
struct OnSetParametersCallbackHandle {
  using SharedPtr = std::shared_ptr<OnSetParametersCallbackHandle>;
};
}  // namespace node_interfaces

class Node {
 public:
  Node(const std::string& /*name*/, const NodeOptions& options) : overrides_(options.parameter_overrides()) {
    declare_parameter("use_sim_time", false, {});
  }
  virtual ~Node() = default;

  template <typename T>
  T declare_parameter(const std::string& name, const T& value, const rcl_interfaces::msg::ParameterDescriptor& is) {
    Value& now = parameters_[name] = Value(value);
    read_only_[name] = is.read_only;
    for (const Parameter& each : overrides_) {
      now = each.get_name() == name ? each.value() : now;
    }
    return std::get<T>(now);
  }
  Parameter get_parameter(const std::string& name) const { return {name, parameters_.at(name)}; }

  node_interfaces::OnSetParametersCallbackHandle::SharedPtr add_on_set_parameters_callback(
      std::function<rcl_interfaces::msg::SetParametersResult(const std::vector<Parameter>&)> call) {
    on_set_ = std::move(call);
    return std::make_shared<node_interfaces::OnSetParametersCallbackHandle>();
  }
  rcl_interfaces::msg::SetParametersResult set_parameters_atomically(const std::vector<Parameter>& given) {
    for (const Parameter& each : given) {
      if (!parameters_.count(each.get_name()) || read_only_.at(each.get_name())) {
        return {false, "not declared, or read-only"};
      }
    }
    const auto result = on_set_(given);
    for (const Parameter& each : given) {
      parameters_[each.get_name()] = result.successful ? each.value() : parameters_[each.get_name()];
    }
    return result;
  }

  GenericPublisher::SharedPtr create_generic_publisher(const std::string& topic, const std::string& type,
                                                       const QoS& qos) {
    if (!graph().absent_package.empty() && type.starts_with(graph().absent_package)) {
      throw std::runtime_error("package '" + graph().absent_package + "' not found");
    }
    const std::lock_guard lock(graph().mutex);
    graph().topics[topic].type = type;
    graph().topics[topic].is_latched = qos.is_latched;
    return std::make_shared<GenericPublisher>(topic);
  }
  template <typename Message, typename Call>
  typename Subscription<Message>::SharedPtr create_subscription(const std::string& topic, const QoS&, Call call) {
    graph().subscribers[topic] = [call](const void* message) { call(*static_cast<const Message*>(message)); };
    return std::make_shared<Subscription<Message>>();
  }
  Logger get_logger() const { return {}; }
  Time now() const { return {}; }

 private:
  std::vector<Parameter> overrides_;
  std::map<std::string, Value> parameters_;
  std::map<std::string, bool> read_only_;
  std::function<rcl_interfaces::msg::SetParametersResult(const std::vector<Parameter>&)> on_set_;
};

inline void log(Logger, const char* text, bool warns) {
  if (warns) {
    const std::lock_guard lock(graph().mutex);
    graph().warnings.emplace_back(text);
  }
}

}  // namespace rclcpp

#define RCLCPP_INFO(logger, format, text) rclcpp::log(logger, text, false)
#define RCLCPP_WARN(logger, format, text) rclcpp::log(logger, text, true)
