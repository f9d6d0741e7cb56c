// ros_settings.cpp -- serves rqt_reconfigure and dynparam, and settings on the topic ~set.

#include "ros1/ros_settings.h"

#include <fmt/format.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include <future>
#include <utility>

#include "console/outcome.h"
#include "insonify/messages.h"
#include "insonify/printable.h"
#include "ros1/ros_topics.h"

namespace insonify {
namespace {

constexpr const char* kRange = "range";
constexpr const char* kGain = "gain";
constexpr double kHighestGain = 100;  // [dB]

void check_gain(double gain_db) {
  if (!(gain_db >= -kHighestGain && gain_db <= kHighestGain)) {
    throw InputError(fmt::format("gain = {} dB must be from {} to {} dB", gain_db, -kHighestGain, kHighestGain));
  }
}

// Waits until the loop has applied it. @throws Error if the loop rejects it.
void set_now(LiveLoop& loop, std::string setting) {
  const auto answer = std::make_shared<std::promise<std::string>>();
  loop.set({std::move(setting)}, [answer](const std::string& error) { answer->set_value(error); });
  if (const std::string error = answer->get_future().get(); !error.empty()) {
    throw Error(error);
  }
}

}  // namespace

RosSonarSettings::RosSonarSettings(ros::NodeHandle node, std::size_t sonar, Bridge& bridge)
    : node_(std::move(node)), sonar_(sonar), bridge_(bridge), given_(sonar_now()) {
  const MessageSource source = message_source(bridge.loop().world()->scenario, given_);
  has_gain_ = SonarMessages(source, {}, MessageForm::kRos1).levels().decibels;
}

void RosSonarSettings::start(double gain_db) {
  if (has_gain_) {
    set(kGain, gain_db);
  }
  server_ = std::make_unique<RosReconfigure>(
      node_, [this] { return read(); }, [this](const std::string& name, double value) { set(name, value); });
}

// The limits of the range are those of the slider; other programs may set more.
std::vector<RosSetting> RosSonarSettings::read() const {
  constexpr double kLeastShare = 0.05, kMostTimes = 4;
  std::vector<RosSetting> settings = {
      {.name = kRange,
       .description = "Far edge of the last bin [m]",
       .value = sonar_now().max_range,
       .least = given_.min_range + kLeastShare * (given_.max_range - given_.min_range),
       .most = kMostTimes * given_.max_range},
  };
  if (has_gain_) {
    settings.push_back({.name = kGain,
                        .description = "Raises the levels of images [dB]",
                        .value = gain_db_,
                        .least = -kHighestGain,
                        .most = kHighestGain});
  }
  return settings;
}

void RosSonarSettings::set(const std::string& name, double value) {
  if (name == kRange) {
    set_now(bridge_.loop(), fmt::format("sonars[{}].max_range={}", sonar_, value));
  } else if (name == kGain && has_gain_) {
    check_gain(value);
    bridge_.set_gain(sonar_, value);
    gain_db_ = value;
  } else {
    throw Error(fmt::format("there is no parameter {}; there {}", printable(name),
                            has_gain_ ? "are range and gain" : "is range"));
  }
}

RosSettings::RosSettings(Bridge& bridge) : bridge_(bridge) {
  node_.setCallbackQueue(&queue_);
  const auto world = bridge.loop().world();
  for (std::size_t i = 0; i < world->sonars.size(); ++i) {
    const std::string name = message_source(world->scenario, world->sonars[i]).name;
    const ros::NodeHandle node = world->sonars.size() == 1 ? node_ : ros::NodeHandle(node_, name);
    double gain = 0;
    if (!ros::param::get(fmt::format("{}/{}/{}", ros::this_node::getName(), name, kGain), gain)) {
      ros::param::get(fmt::format("{}/{}", ros::this_node::getName(), kGain), gain);
    }
    sonars_.push_back(std::make_unique<RosSonarSettings>(node, i, bridge));
    sonars_.back()->start(gain);
  }
  answer_ = advertise_text(node_, "set_result");
  settings_ = subscribe_text(node_, "set",
                             [this](const std::string& text) { request_settings(bridge_.loop(), text, answer_); });
  spinner_.start();
}

std::vector<std::string> RosSettings::services() const {
  std::vector<std::string> names;
  for (const auto& sonar : sonars_) {
    names.push_back(sonar->service());
  }
  return names;
}

}  // namespace insonify
