// ros_parameters.cpp -- reads parameters from roscore and turns them into command-line arguments.

#include "ros1/ros_parameters.h"

#include <fmt/format.h>
#include <ros/param.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string_view>

#include "console/console.h"
#include "console/outcome.h"
#include "insonify/files.h"
#include "insonify/messages.h"
#include "insonify/printable.h"
#include "transport/bridge_program.h"

namespace insonify {
namespace {

using XmlRpc::XmlRpcValue;

std::string text_of(const std::string& name, XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "true" : "false";
    case XmlRpcValue::TypeInt:
      return fmt::format("{}", static_cast<int>(value));
    case XmlRpcValue::TypeDouble:
      return fmt::format("{}", static_cast<double>(value));
    case XmlRpcValue::TypeString:
      return static_cast<std::string>(value);
    default:
      throw InputError(fmt::format("parameter {}/{} must be a number, a text or true or false",
                                   ros::this_node::getName(), printable(name)));
  }
}

std::vector<std::string> texts_of(const std::string& name, XmlRpcValue value) {
  std::vector<std::string> texts;
  if (value.getType() != XmlRpcValue::TypeArray) {
    return {text_of(name, value)};
  }
  for (int i = 0; i < value.size(); ++i) {
    texts.push_back(text_of(name, value[i]));
  }
  return texts;
}

void warn_of(const std::string& name) {
  complain(fmt::format("warning: nothing reads the parameter {}/{}", ros::this_node::getName(), printable(name)));
}

// Settings of the scenario from "range", and "fls/range" of sonar fls. Gains are read elsewhere.
std::vector<std::string> range_settings(XmlRpcValue& parameters, const BridgeOptions& options) {
  std::vector<std::string> settings;
  if (parameters.hasMember("range")) {
    settings.push_back("max_range=" + text_of("range", parameters["range"]));
  }
  std::map<std::string, std::size_t> sonars;  // By topic name.
  for (auto& [name, value] : parameters) {
    if (value.getType() != XmlRpcValue::TypeStruct) {
      continue;
    }
    if (sonars.empty()) {
      const Scenario scenario = scenario_of(options);
      for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
        sonars[message_source(scenario, scenario.filled_in(scenario.sonars[i])).name] = i;
      }
    }
    for (auto& [key, of_sonar] : value) {
      const std::string path = name + "/" + key;
      if (!sonars.contains(name) || (key != "range" && key != "gain")) {
        warn_of(path);
      } else if (key == "range") {
        settings.push_back(fmt::format("sonars[{}].max_range={}", sonars[name], text_of(path, of_sonar)));
      }
    }
  }
  return settings;
}

}  // namespace

Scenario scenario_of(const BridgeOptions& options) {
  try {
    return load_scenario(options.scenario, options.settings);
  } catch (const Error& error) {
    throw InputError(error.what());
  }
}

RosParameters with_parameters(const std::vector<std::string>& words) {
  XmlRpcValue parameters;
  if (!ros::param::get(ros::this_node::getName(), parameters) || parameters.getType() != XmlRpcValue::TypeStruct) {
    parameters = XmlRpcValue();
    parameters["publish_tf"] = true;
  }
  std::set<std::string> known = {"publish_tf", "range", "gain"};
  RosParameters result;
  std::map<std::string, std::string> taken;  // Parameter names by their option.
  const auto value_of = [&](const std::string& option) {
    std::string name = option;
    std::ranges::replace(name, '-', '_');
    known.insert(name);
    if (!parameters.hasMember(name)) {
      return std::vector<std::string>();
    }
    taken[option] = name;
    return texts_of(name, parameters[name]);
  };
  try {
    result.request = parsed_bridge(bridge_kind("ros1"), words, value_of);
  } catch (const InputError& error) {
    for (const auto& [option, name] : taken) {
      if (std::string_view(error.what()).starts_with("--" + option)) {
        throw InputError(fmt::format("parameter {0}/{1}: {2}; rosparam delete {0}/{1} removes it",
                                     ros::this_node::getName(), name, error.what()));
      }
    }
    throw;
  }
  const std::vector<std::string> ranges = range_settings(parameters, result.request.bridge);
  std::vector<std::string>& settings = result.request.bridge.settings;
  settings.insert(settings.begin(), ranges.begin(), ranges.end());
  if (parameters.hasMember("publish_tf")) {
    const std::string text = text_of("publish_tf", parameters["publish_tf"]);
    if (text != "true" && text != "false") {
      throw InputError(fmt::format("parameter {}/publish_tf = {} must be true or false", ros::this_node::getName(),
                                   printable(text)));
    }
    result.transforms = text == "true";
  }
  for (auto& [name, value] : parameters) {
    if (!known.contains(name) && value.getType() != XmlRpcValue::TypeStruct) {
      warn_of(name);
    }
  }
  return result;
}

}  // namespace insonify
