// gazebo_transport.cpp -- makes two publishers for each topic.

#include "gazebo/gazebo_transport.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "gazebo/gazebo_names.h"
#include "insonify/error.h"

namespace insonify {

void GazeboTransport::open(std::size_t sonar, const std::vector<MessageChannel>& channels) {
  channels_.resize(std::max(channels_.size(), sonar + 1));
  channels_[sonar].clear();
  for (const MessageChannel& channel : channels) {
    auto found = topics_.find(channel.topic);
    if (found == topics_.end()) {
      Topic topic{channel.topic, channel.type, ignition_type_name(channel.type), channel.kind, {}, {}};
      topic.gz = gz_node_.Advertise(topic.name, topic.gz_type);
      topic.ignition = ignition_node_.Advertise(topic.name, topic.ignition_type);
      if (!topic.gz || !topic.ignition) {
        throw Error(fmt::format("the topic {} cannot be advertised", topic.name));
      }
      found = topics_.emplace(topic.name, std::move(topic)).first;
    }
    channels_[sonar].push_back(&found->second);
    if (channel.kind == MessageKind::kScenario) {
      scenario_ = &found->second;
    }
  }
}

bool GazeboTransport::is_read(std::size_t sonar, std::size_t channel) const {
  return channels_.at(sonar).at(channel)->is_read();
}

void GazeboTransport::publish(Topic& topic, const std::string& bytes) {
  for (auto& [publisher, type] :
       {std::pair<Publisher&, std::string&>(topic.gz, topic.gz_type), {topic.ignition, topic.ignition_type}}) {
    if (publisher.HasConnections() && !publisher.PublishRaw(bytes, type)) {
      throw Error(fmt::format("a message could not be published on {}", topic.name));
    }
  }
}

void GazeboTransport::remind_of_scenario() {
  if (scenario_ == nullptr || scenario_message_.empty()) {
    return;
  }
  const bool gz = scenario_->gz.HasConnections(), ignition = scenario_->ignition.HasConnections();
  const bool is_new = (gz && !scenario_gz_read_) || (ignition && !scenario_ignition_read_);
  scenario_gz_read_ = gz;
  scenario_ignition_read_ = ignition;
  if (is_new) {
    publish(*scenario_, scenario_message_);
  }
}

void GazeboTransport::send(std::size_t sonar, std::size_t channel, std::uint64_t /*time_ns*/,
                           const std::vector<std::byte>& message) {
  Topic& topic = *channels_.at(sonar).at(channel);
  std::string bytes(reinterpret_cast<const char*>(message.data()), message.size());
  publish(topic, bytes);
  if (topic.kind == MessageKind::kScenario) {
    scenario_message_ = std::move(bytes);
    scenario_gz_read_ = topic.gz.HasConnections();
    scenario_ignition_read_ = topic.ignition.HasConnections();
  } else {
    remind_of_scenario();
  }
}

}  // namespace insonify
