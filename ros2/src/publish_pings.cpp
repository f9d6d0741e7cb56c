// publish_pings.cpp -- what the component publishes, and when.

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

#include "sonar_node.h"

namespace insonify_ros2 {
namespace {

using insonify::LivePing;
using insonify::LiveWorld;
using insonify::MessageChannel;
using insonify::MessageKind;

constexpr std::ptrdiff_t kMostWaiting = 4;  // More that are due are dropped, the oldest first.

// Matches readers that request less, such as those of sensor data.
rclcpp::QoS qos_of(const MessageChannel& channel) {
  constexpr std::size_t kKept = 10, kKeptTransforms = 100;
  rclcpp::QoS qos(channel.latched ? 1 : channel.kind == MessageKind::kTransforms ? kKeptTransforms : kKept);
  qos.reliable();
  if (channel.latched) {
    qos.transient_local();
  }
  return qos;
}

// The bytes are CDR with its header, as rmw has them.
rclcpp::SerializedMessage serialized(const std::vector<std::byte>& bytes) {
  rclcpp::SerializedMessage message(bytes.size());
  rcl_serialized_message_t& raw = message.get_rcl_serialized_message();
  std::memcpy(raw.buffer, bytes.data(), bytes.size());
  raw.buffer_length = bytes.size();
  return message;
}

}  // namespace

// The clock by which pings are due [s]: ROS's simulated time, or the time since some moment.
double SonarNode::now_of_pings() const {
  return clocked_ ? clock_time_
                  : std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void SonarNode::on_ping(const std::shared_ptr<const LivePing>& ping) {
  const insonify::SonarConfig& sonar = ping->world->sonars[static_cast<std::size_t>(ping->sonar)];
  const double travel = at_once_ ? 0 : 2 * sonar.max_range / *sonar.assumed_sound_speed;
  const std::lock_guard lock(mutex_);
  const double transmitted = clocked_ ? ping->clock : now_of_pings() - ping->computing_time;
  waiting_.emplace(transmitted + travel, ping);
  const auto due = std::distance(waiting_.begin(), waiting_.upper_bound(now_of_pings()));
  if (!on_request_ && due > kMostWaiting) {
    waiting_.erase(waiting_.begin());
  }
  changed_.notify_all();
}

// Its topics are there before its first ping, but after the last of the world before.
void SonarNode::on_world(const std::shared_ptr<const LiveWorld>& world) {
  const std::lock_guard lock(mutex_);
  next_world_ = world;
  changed_.notify_all();
}

// Pings from before the clock was set back are late.
void SonarNode::on_clock(double time) {
  const std::lock_guard lock(mutex_);
  if (time < clock_time_) {
    waiting_.clear();
  }
  clock_time_ = time;
  changed_.notify_all();
}

void SonarNode::publish_until_end() {
  std::unique_lock lock(mutex_);
  while (!ending_) {
    std::shared_ptr<const LivePing> ping;
    std::shared_ptr<const LiveWorld> world;
    if (waiting_.empty() && next_world_) {
      world = std::exchange(next_world_, nullptr);
    } else if (waiting_.empty() || (clocked_ && waiting_.begin()->first > clock_time_)) {
      changed_.wait(lock);
      continue;
    } else if (const double rest = waiting_.begin()->first - now_of_pings(); rest > 0) {
      changed_.wait_for(lock, std::chrono::duration<double>(rest));
      continue;
    } else {
      ping = waiting_.extract(waiting_.begin()).mapped();
      world = ping->world;
    }
    if (std::exchange(opens_, false)) {
      world_.reset();
    }
    const std::map<std::string, double> gains = gains_db_;
    lock.unlock();
    try {
      if (!world_ || (ping ? world_->change != world->change : world_->change < world->change)) {
        open(*world, gains);
        world_ = world;
      }
      if (ping) {
        publish(*ping);
      }
      last_problem_.clear();
    } catch (const std::exception& error) {
      if (std::exchange(last_problem_, error.what()) != error.what()) {
        on_note(error.what());
      }
    }
    lock.lock();
  }
}

void SonarNode::open(const LiveWorld& world, const std::map<std::string, double>& gains_db) {
  messages_.clear();
  channels_.clear();
  std::vector<std::string> labels;
  for (const insonify::Instance& instance : world.scene.instances) {
    labels.push_back(instance.name);
  }
  for (const insonify::SonarConfig& sonar : world.sonars) {
    insonify::MessageSource source = insonify::message_source(world.scenario, sonar);
    source.labels = labels;
    insonify::MessageOptions options = message_options_;
    const auto gain = gains_db.find(source.name);
    const insonify::MessageLevels levels = insonify::SonarMessages(source, options).levels();
    if (gain != gains_db.end() && levels.decibels) {
      options.low_db = levels.low_db - gain->second;
      options.high_db = levels.high_db - gain->second;
    }
    auto& channels = channels_.emplace_back();
    for (const MessageChannel& channel : messages_.emplace_back(source, options).channels()) {
      channels.push_back(publisher(channel));
    }
  }
  publish_latched();
}

// A type whose package is not installed is not published.
rclcpp::GenericPublisher::SharedPtr SonarNode::publisher(const MessageChannel& channel) {
  const auto [found, is_new] = publishers_.try_emplace(channel.topic);
  if (is_new) {
    try {
      found->second = create_generic_publisher(channel.topic, channel.type, qos_of(channel));
    } catch (const std::exception& error) {
      on_note(channel.topic + " is not published: " + error.what());
    }
  }
  return found->second;
}

// The scenario's text and the mountings of all sonars are one message each.
void SonarNode::publish_latched() {
  for (std::size_t sonar = 0; sonar < messages_.size(); ++sonar) {
    const std::vector<MessageChannel>& channels = messages_[sonar].channels();
    for (std::size_t channel = 0; channel < channels.size(); ++channel) {
      const MessageKind kind = channels[channel].kind;
      if (channels[channel].latched && channels_[sonar][channel] && (sonar == 0 || kind == MessageKind::kDescription)) {
        channels_[sonar][channel]->publish(serialized(kind == MessageKind::kTransforms
                                                          ? insonify::SonarMessages::mountings(messages_)
                                                          : messages_[sonar].encode(channel)));
      }
    }
  }
}

// Messages have the stamp of the pose that the ping was made from; further pings from the same pose are later by the
// interval between them. On the scenario's own trajectory it is the time of transmission. A stamp of 0 means "the
// latest" to readers of transforms.
void SonarNode::publish(const LivePing& live) {
  constexpr double kEarliest = 1e-9;  // [s]
  const auto sonar = static_cast<std::size_t>(live.sonar);
  insonify::SonarMessages& messages = messages_[sonar];
  const bool driven = live.received_at > 0;
  const bool is_new_pose = driven && std::exchange(received_at_[live.sonar], live.received_at) != live.received_at;
  const double transmitted = live.made_at - live.computing_time;
  const double by_clock =
      clocked_ ? std::max(live.clock, live.stamp) : transmitted + (driven ? live.stamp - live.received_at : 0);
  messages.take(live.ping, std::max(kEarliest, is_new_pose ? live.stamp : by_clock));
  for (std::size_t channel = 0; channel < messages.channels().size(); ++channel) {
    const MessageChannel& is = messages.channels()[channel];
    const auto& to = channels_[sonar][channel];
    if (!is.latched && to && to->get_subscription_count() > 0 &&
        (is.kind != MessageKind::kScan || messages.is_due(channel))) {
      to->publish(serialized(messages.encode(channel)));
    }
  }
}

}  // namespace insonify_ros2
