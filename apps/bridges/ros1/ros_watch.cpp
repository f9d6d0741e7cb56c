// ros_watch.cpp -- registers this node's topics and services with a restarted roscore.

#include "ros1/ros_watch.h"

#include <fmt/format.h>
#include <ros/connection_manager.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/network.h>
#include <ros/publication.h>
#include <ros/this_node.h>
#include <ros/topic_manager.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <chrono>
#include <optional>
#include <utility>

#include "console/console.h"

namespace insonify {
namespace {

using XmlRpc::XmlRpcValue;

template <typename... Values>
XmlRpcValue request_of(const Values&... values) {
  XmlRpcValue request;
  int i = 0;
  ((request[i++] = values), ...);
  return request;
}

// roscore's response to a subscription lists the publishers. They are passed to ROS as roscore does in later updates.
// An empty list would drop connections to publishers that the new roscore does not know yet.
void connect_to(const std::string& topic, const XmlRpcValue& publishers, const std::string& own_uri) {
  if (publishers.getType() == XmlRpcValue::TypeArray && publishers.size() > 0) {
    (void)RosMaster(own_uri).call("publisherUpdate", request_of(std::string("/master"), topic, publishers));
  }
}

}  // namespace

RosWatch::RosWatch(RosMaster master, int pid, std::vector<std::string> services, std::function<void()> on_end)
    : master_(std::move(master)), pid_(pid), services_(std::move(services)), on_end_(std::move(on_end)) {
  for (const char* name : {"~get_loggers", "~set_logger_level"}) {  // Every node has them.
    services_.push_back(ros::names::resolve(name));
  }
  own_uri_ = ros::XMLRPCManager::instance()->getServerURI();
  own_services_uri_ =
      fmt::format("rosrpc://{}:{}", ros::network::getHost(), ros::ConnectionManager::instance()->getTCPPort());
  thread_ = std::thread([this] { look(); });
}

void RosWatch::end() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void RosWatch::look() {
  constexpr std::chrono::milliseconds kInterval{500};
  bool is_there = true;
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, kInterval, [this] { return ending_; })) {
    lock.unlock();
    if (ros::isShuttingDown()) {
      complain(fmt::format("ROS ends node {}: it was killed, or another of its name was started",
                           ros::this_node::getName()));
      on_end_();
      return;
    }
    const auto pid = master_.pid();
    const auto registration = pid ? master_.lookup(ros::this_node::getName()) : std::nullopt;
    if (ros::isShuttingDown()) {
      // It is being unregistered from roscore.
    } else if (registration && registration->known && registration->uri != own_uri_) {
      complain(fmt::format("node {} ends: another program has its name now", ros::this_node::getName()));
      on_end_();
      return;
    } else if (!registration && is_there) {
      complain(fmt::format("roscore at {} does not answer any more; waiting for it", master_.uri()));
    } else if (registration && (!registration->known || *pid != pid_)) {
      register_again();
      complain(fmt::format("roscore {}; it knows the node's topics now",
                           std::exchange(pid_, *pid) != *pid ? "was started again" : "had forgotten this node"));
    } else if (registration && !is_there) {
      complain("roscore answers again");
    }
    is_there = registration.has_value();
    lock.lock();
  }
}

void RosWatch::register_again() const {
  const std::string& name = ros::this_node::getName();
  const auto& topics = ros::TopicManager::instance();
  std::vector<std::string> names;
  topics->getAdvertisedTopics(names);
  for (const std::string& topic : names) {
    if (const ros::PublicationPtr publication = topics->lookupPublication(topic)) {
      (void)master_.call("registerPublisher", request_of(name, topic, publication->getDataType(), own_uri_));
    }
  }
  names.clear();
  topics->getSubscribedTopics(names);
  for (const std::string& topic : names) {
    // The type comes from the publishers.
    if (const auto publishers =
            master_.call("registerSubscriber", request_of(name, topic, std::string("*"), own_uri_))) {
      connect_to(topic, *publishers, own_uri_);
    }
  }
  for (const std::string& service : services_) {
    (void)master_.call("registerService", request_of(name, service, own_services_uri_, own_uri_));
  }
}

}  // namespace insonify
