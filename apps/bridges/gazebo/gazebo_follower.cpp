// gazebo_follower.cpp -- the thread that follows Gazebo.

#include "gazebo/gazebo_follower.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ignition/msgs/uint32_v.pb.h>

#include <algorithm>
#include <utility>

#include "gazebo/gazebo_names.h"
#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

constexpr std::chrono::milliseconds kLook{300};       // Between checks for worlds.
constexpr std::chrono::milliseconds kRequest{200};    // Between requests for the scene.
constexpr std::chrono::milliseconds kSettling{1000};  // Until it is known whether Gazebo marks static entities.
constexpr std::chrono::milliseconds kDeath{4000};     // Until a dead server is forgotten: 3 s of silence, by default.

double seconds(const ignition::msgs::Time& time) {
  return static_cast<double>(time.sec()) + 1e-9 * time.nsec();
}

}  // namespace

GazeboFollower::GazeboFollower(FollowerOptions options, WorldParts parts, LiveLoop& loop, Log log)
    : options_(std::move(options)),
      loop_(loop),
      log_(std::move(log)),
      carriers_(options_.carriers),
      keeper_(std::move(parts), options_.materials) {}

void GazeboFollower::start() {
  thread_ = std::thread([this] { follow(); });
}

void GazeboFollower::end() {
  if (!thread_.joinable()) {
    return;
  }
  for (const std::string& topic : node_.SubscribedTopics()) {
    node_.Unsubscribe(topic);
  }
  {
    const std::lock_guard lock(mail_box_->mutex);
    mail_box_->ending = true;
  }
  mail_box_->arrived.notify_all();
  thread_.join();
}

void GazeboFollower::wake() {
  const std::lock_guard lock(mail_box_->mutex);
  mail_box_->woken = true;
  mail_box_->arrived.notify_all();
}

void GazeboFollower::follow() {
  MailBox& box = *mail_box_;
  std::unique_lock lock(box.mutex);
  while (!box.ending) {
    box.arrived.wait_for(lock, kLook / 2, [&box] {
      return box.ending || box.woken || !box.mail.news.empty() || box.mail.poses || box.mail.dynamic_poses;
    });
    if (box.ending) {
      return;
    }
    Mail mail = std::exchange(box.mail, {});
    box.woken = false;
    lock.unlock();
    try {
      if (Clock::now() >= next_look_) {
        if (look_for_server()) {
          mail = {};  // It is from the previous server.
        }
        next_look_ = Clock::now() + kLook;
      }
      take(std::move(mail));
      if (served_ && needs_scene_ && Clock::now() >= next_request_) {
        read_scene();
        next_request_ = Clock::now() + kRequest;
      }
      if (has_scene_) {
        update_objects();
        drive();
        step();
      }
    } catch (const std::exception& error) {
      warn_once(error.what());
    }
    lock.lock();
  }
}

void GazeboFollower::warn_once(const std::string& text) {
  if (text != last_warning_) {
    log_(Severity::kWarning, text);
    last_warning_ = text;
  }
}

// Finds the world to follow; detects that Gazebo ended.
// @return  Whether Gazebo was started or restarted.
bool GazeboFollower::look_for_server() {
  std::vector<ServedWorld> worlds = server_.worlds();
  std::vector<std::string> names;
  for (const ServedWorld& world : worlds) {
    names.push_back(printable(world.name));
  }
  const std::string& wanted = options_.world.empty() ? subscribed_ : options_.world;
  if (!wanted.empty()) {
    std::erase_if(worlds, [&](const ServedWorld& world) { return world.name != wanted; });
  }
  if (worlds.size() > 1) {
    warn_once(fmt::format("Gazebo has several worlds: {}; choose one by --world", fmt::join(names, ", ")));
    return false;
  }
  if (worlds.empty()) {
    if (!std::exchange(announced_waiting_, true)) {
      const std::string partition = gazebo_partition();
      log_(Severity::kWarning,
           fmt::format("there is no Gazebo{}{}{}: waiting for it",
                       wanted.empty() ? "" : " with the world " + printable(wanted),
                       partition.empty() ? "" : " in the partition " + printable(partition),
                       names.empty() ? "" : fmt::format(", but one with {}", fmt::join(names, ", "))));
    }
    served_.reset();
    return false;
  }
  const ServedWorld& found = worlds.front();
  warn_of_several_servers(found);
  if (served_ && served_->process == found.process) {
    return false;
  }
  served_ = found;
  announced_waiting_ = false;
  announced_world_ = false;
  needs_scene_ = true;
  world_.clear();
  has_scene_ = false;
  settled_at_ = Clock::now() + kSettling;
  carriers_.forget_poses();
  last_warning_.clear();
  newest_changes_ = false;
  stamp_ = 0;
  stepper_ = {};
  subscribe();
  return true;
}

// A server that died without a word is listed for some seconds more.
void GazeboFollower::warn_of_several_servers(const ServedWorld& world) {
  if (world.servers < 2) {
    several_since_.reset();
  } else if (!several_since_) {
    several_since_ = Clock::now();
  } else if (Clock::now() - *several_since_ > kDeath) {
    warn_once(
        fmt::format("{} servers have a world {} in the partition {}: their poses are mixed; give each its own "
                    "GZ_PARTITION",
                    world.servers, printable(world.name), printable(gazebo_partition())));
  }
}

void GazeboFollower::subscribe() {
  if (subscribed_ == served_->name) {
    return;
  }
  subscribed_ = served_->name;
  const WorldTopics topics(subscribed_);
  using ignition::transport::MessageInfo;
  const auto keep = [this](std::optional<std::string> Mail::*of) {
    return [box = mail_box_, of](const char* bytes, std::size_t size, const MessageInfo&) {
      const std::lock_guard lock(box->mutex);
      (box->mail.*of).emplace(bytes, size);
      box->arrived.notify_all();
    };
  };
  const auto queue = [this](bool is_deletion) {
    return [box = mail_box_, is_deletion](const char* bytes, std::size_t size, const MessageInfo&) {
      const std::lock_guard lock(box->mutex);
      box->mail.news.push_back({is_deletion, std::string(bytes, size)});
      box->arrived.notify_all();
    };
  };
  if (!node_.SubscribeRaw(topics.poses, keep(&Mail::poses)) ||
      !node_.SubscribeRaw(topics.dynamic_poses, keep(&Mail::dynamic_poses)) ||
      !node_.SubscribeRaw(topics.scene, queue(false)) || !node_.SubscribeRaw(topics.deletion, queue(true))) {
    throw Error(fmt::format("the topics of the world {} cannot be subscribed to", printable(subscribed_)));
  }
}

void GazeboFollower::read_scene() {
  const std::optional<ignition::msgs::Scene> scene = server_.scene(*served_);
  if (!scene) {
    warn_once(
        fmt::format("Gazebo does not answer with the scene of the world {}: asking again", printable(served_->name)));
    return;
  }
  world_.set(*scene);
  world_.accept();
  needs_scene_ = false;
  needs_update_ = true;
  has_scene_ = true;
}

void GazeboFollower::take_poses(const std::string& bytes, bool dynamic) {
  ignition::msgs::Pose_V poses;
  if (!poses.ParseFromString(bytes)) {
    throw Error(fmt::format("a message about poses of the world {} cannot be read", printable(subscribed_)));
  }
  world_.take(poses, dynamic);
  stamp_ = std::max(newest_changes_ ? stamp_ : 0, seconds(poses.header().stamp()));
  newest_changes_ = true;
}

void GazeboFollower::take(Mail mail) {
  for (const Mail::News& news : mail.news) {
    if (news.is_deletion) {
      ignition::msgs::UInt32_V ids;
      if (ids.ParseFromString(news.bytes)) {
        world_.remove(std::vector<Id>(ids.data().begin(), ids.data().end()));
      }
    } else if (ignition::msgs::Scene scene; has_scene_ && scene.ParseFromString(news.bytes)) {
      world_.add(scene);
    }
    needs_update_ = true;
  }
  if (mail.poses) {
    take_poses(*mail.poses, false);
    needs_scene_ = needs_scene_ || world_.is_outdated();
  }
  if (mail.dynamic_poses) {
    take_poses(*mail.dynamic_poses, true);
  }
  needs_update_ = needs_update_ || newest_changes_;
}

void GazeboFollower::update_objects() {
  if (!needs_update_ || (!world_.knows_dynamic() && Clock::now() < settled_at_)) {
    return;
  }
  needs_update_ = false;
  const std::string name = fmt::format("the world {}", printable(served_ ? served_->name : subscribed_));
  const SceneKeeper::Change change =
      keeper_.update(world_, carriers_.ids(loop_.world()->scenario.sonars, world_), name, stamp_, loop_, log_);
  if (!std::exchange(announced_world_, true)) {
    log_(Severity::kInfo, fmt::format("following {}: {} visuals, {} of them in models that move", name,
                                      keeper_.object_count(), keeper_.moving_count()));
    keeper_.report_unused_patterns(name);
  } else if (change.added + change.removed > 0) {
    log_(Severity::kInfo, fmt::format("{}: {} visuals added, {} removed", name, change.added, change.removed));
  }
}

// A pose received before a time must affect the pings of that time, so the time is passed last.
void GazeboFollower::drive() {
  if (!announced_world_ || !std::exchange(newest_changes_, false)) {
    return;
  }
  std::vector<CarriedSonar> carried = carriers_.poses(*loop_.world(), world_, stamp_);
  LiveDrive drive{.world_from_vehicle = carried.front().world_from_carrier,
                  .twist = carried.front().twist,
                  .moved = keeper_.moved(world_),
                  .stamp = stamp_,
                  .carried = std::move(carried)};
  loop_.drive(std::move(drive));
  if (options_.clock) {
    loop_.advance(stamp_);
  }
}

// Once the poses of the last steps have come, and the pings until then are made.
void GazeboFollower::step() {
  if (!options_.lock_step || !served_ || !announced_world_) {
    return;
  }
  const unsigned steps = stepper_.steps(stamp_, loop_.state().awaited, Clock::now());
  if (steps > 0 && !server_.step(*served_, steps)) {
    warn_once(fmt::format("Gazebo does not step the world {}: asking again", printable(served_->name)));
  }
}

}  // namespace insonify
