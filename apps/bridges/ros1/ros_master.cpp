// ros_master.cpp -- queries roscore by XML-RPC.

#include "ros1/ros_master.h"

#include <fmt/format.h>
#include <ros/init.h>
#include <ros/network.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <thread>
#include <utility>

#include "console/console.h"
#include "console/outcome.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

constexpr const char* kCaller = "/insonify";
constexpr int kDoneCode = 1;

// roscore's response: code, text and value. Empty if there is none.
std::optional<XmlRpc::XmlRpcValue> ask(const std::string& host, int port, const char* method,
                                       const XmlRpc::XmlRpcValue& request) {
  XmlRpc::XmlRpcClient client(host.c_str(), port, "/");
  XmlRpc::XmlRpcValue answer;
  if (!client.execute(method, request, answer) || client.isFault() ||
      answer.getType() != XmlRpc::XmlRpcValue::TypeArray || answer.size() != 3 ||
      answer[0].getType() != XmlRpc::XmlRpcValue::TypeInt) {
    return {};
  }
  return answer;
}

}  // namespace

RosMaster::RosMaster(std::string uri) : uri_(std::move(uri)) {
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri_, host_, port) || host_.empty() || port == 0 || port > 65535) {
    throw InputError(fmt::format("ROS_MASTER_URI = {} must be like http://localhost:11311", printable(uri_)));
  }
  port_ = static_cast<int>(port);
}

std::optional<int> RosMaster::pid() const {
  XmlRpc::XmlRpcValue request;
  request[0] = kCaller;
  auto answer = call("getPid", request);
  if (!answer || answer->getType() != XmlRpc::XmlRpcValue::TypeInt) {
    return {};
  }
  return static_cast<int>(*answer);
}

std::optional<RosRegistration> RosMaster::lookup(const std::string& node) const {
  XmlRpc::XmlRpcValue request;
  request[0] = node;
  request[1] = node;
  auto answer = ask(host_, port_, "lookupNode", request);
  if (!answer) {
    return {};
  }
  const bool known = static_cast<int>((*answer)[0]) == kDoneCode;
  const bool has_uri = known && (*answer)[2].getType() == XmlRpc::XmlRpcValue::TypeString;
  return RosRegistration{.known = known, .uri = has_uri ? static_cast<std::string>((*answer)[2]) : std::string()};
}

std::optional<XmlRpc::XmlRpcValue> RosMaster::call(const char* method, const XmlRpc::XmlRpcValue& request) const {
  auto answer = ask(host_, port_, method, request);
  if (!answer || static_cast<int>((*answer)[0]) != kDoneCode) {
    return {};
  }
  return (*answer)[2];
}

int RosMaster::wait() const {
  constexpr std::chrono::milliseconds kInterval{200};
  if (const auto process = pid()) {
    return *process;
  }
  complain(fmt::format("no roscore answers at {} (ROS_MASTER_URI); waiting for it", printable(uri_)));
  while (true) {
    if (const auto process = pid()) {
      complain("roscore answers");
      return *process;
    }
    std::this_thread::sleep_for(kInterval);
  }
}

std::string ros_master_uri(int argc, const char* const* argv) {
  const std::string word = ros::getROSArg(argc, argv, "__master");
  if (!word.empty()) {
    return word;
  }
  const char* const variable = std::getenv("ROS_MASTER_URI");
  return variable == nullptr || *variable == '\0' ? ros::getDefaultMasterURI() : variable;
}

}  // namespace insonify
