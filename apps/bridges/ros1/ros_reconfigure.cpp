// ros_reconfigure.cpp -- translates settings into the messages of dynamic_reconfigure.

#include "ros1/ros_reconfigure.h"

#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>

#include <stdexcept>
#include <utility>

namespace insonify {
namespace {

using dynamic_reconfigure::Config;

// Clients require each parameter to be in a group.
constexpr const char* kGroup = "Default";

template <typename Value>
Config config_of(const std::vector<RosSetting>& settings, Value value) {
  Config config;
  for (const RosSetting& setting : settings) {
    dynamic_reconfigure::DoubleParameter parameter;
    parameter.name = setting.name;
    parameter.value = value(setting);
    config.doubles.push_back(parameter);
  }
  dynamic_reconfigure::GroupState group;
  group.name = kGroup;
  group.state = 1;
  config.groups.push_back(group);
  return config;
}

Config values_of(const std::vector<RosSetting>& settings) {
  return config_of(settings, [](const RosSetting& setting) { return setting.value; });
}

dynamic_reconfigure::ConfigDescription description_of(const std::vector<RosSetting>& settings) {
  dynamic_reconfigure::Group group;
  group.name = kGroup;
  for (const RosSetting& setting : settings) {
    dynamic_reconfigure::ParamDescription parameter;
    parameter.name = setting.name;
    parameter.type = "double";
    parameter.description = setting.description;
    group.parameters.push_back(parameter);
  }
  dynamic_reconfigure::ConfigDescription description;
  description.groups.push_back(group);
  description.dflt = values_of(settings);
  description.min = config_of(settings, [](const RosSetting& setting) { return setting.least; });
  description.max = config_of(settings, [](const RosSetting& setting) { return setting.most; });
  return description;
}

template <typename Parameters>
void refuse(const Parameters& parameters) {
  if (!parameters.empty()) {
    throw std::runtime_error("parameter " + parameters.front().name + " must be a number");
  }
}

}  // namespace

struct RosReconfigure::State {
  bool change(dynamic_reconfigure::Reconfigure::Request& request,
              dynamic_reconfigure::Reconfigure::Response& response) {
    refuse(request.config.bools);
    refuse(request.config.strs);
    for (const auto& each : request.config.doubles) {
      set(each.name, each.value);
    }
    for (const auto& each : request.config.ints) {
      set(each.name, each.value);
    }
    response.config = values_of(read());
    updates.publish(response.config);
    return true;
  }

  Read read;
  Set set;
  ros::Publisher descriptions, updates;
  ros::ServiceServer service;
};

RosReconfigure::RosReconfigure(ros::NodeHandle& node, Read read, Set set) : state_(std::make_unique<State>()) {
  state_->read = std::move(read);
  state_->set = std::move(set);
  const std::vector<RosSetting> settings = state_->read();
  state_->descriptions = node.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  state_->updates = node.advertise<Config>("parameter_updates", 1, true);
  state_->descriptions.publish(description_of(settings));
  state_->updates.publish(values_of(settings));
  state_->service = node.advertiseService("set_parameters", &State::change, state_.get());
}

RosReconfigure::~RosReconfigure() = default;

std::string RosReconfigure::service() const {
  return state_->service.getService();
}

}  // namespace insonify
