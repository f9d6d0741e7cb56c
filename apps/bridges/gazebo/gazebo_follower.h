// gazebo_follower.h -- passes objects, poses and time of a running Gazebo to a LiveLoop.

#pragma once

#include <ignition/msgs/pose_v.pb.h>
#include <ignition/msgs/scene.pb.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <ignition/transport/Node.hh>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "gazebo/gazebo_server.h"
#include "gazebo/gazebo_world.h"
#include "gazebo/scene_keeper.h"
#include "gazebo/sonar_carriers.h"
#include "gazebo/world_stepper.h"
#include "insonify/live_loop.h"
#include "insonify/log.h"

namespace insonify {

struct FollowerOptions {
  std::string world = {};                             ///< Name; "": the only one.
  std::map<std::string, Carrier> carriers = {};       ///< Models or links that carry the sonars; see SonarCarriers.
  bool clock = true;                                  ///< Whether time comes from the stamps of poses.
  bool lock_step = false;                             ///< Whether the world is paused and stepped from ping to ping.
  std::map<std::string, std::string> materials = {};  ///< By the full names of visuals.
};

/// A thread that waits for Gazebo, follows it, and waits again after it ends.
class GazeboFollower {
 public:
  /// @param loop  Driven, and clocked with FollowerOptions::clock. Must live until end().
  GazeboFollower(FollowerOptions options, WorldParts parts, LiveLoop& loop, Log log);
  ~GazeboFollower() { end(); }
  GazeboFollower(const GazeboFollower&) = delete;
  GazeboFollower& operator=(const GazeboFollower&) = delete;

  /// After the loop was started.
  void start();
  void end();

  /// To be called when the loop has made the pings that are due. From any thread.
  void wake();

 private:
  using Clock = std::chrono::steady_clock;
  using Id = GazeboWorld::Id;

  // Received since the last check: all changes, the newest poses.
  struct Mail {
    std::optional<std::string> poses, dynamic_poses;
    struct News {
      bool is_deletion = false;
      std::string bytes;
    };
    std::vector<News> news;
  };

  // Shared with callbacks: unsubscribing does not wait for one that is running.
  struct MailBox {
    std::mutex mutex;
    std::condition_variable arrived;
    Mail mail;
    bool ending = false;
    bool woken = false;
  };

  void follow();
  [[nodiscard]] bool look_for_server();
  void warn_of_several_servers(const ServedWorld& world);
  void subscribe();
  void read_scene();
  void take(Mail mail);
  void take_poses(const std::string& bytes, bool dynamic);
  void update_objects();
  void drive();
  void step();
  void warn_once(const std::string& text);

  FollowerOptions options_;
  LiveLoop& loop_;
  Log log_;
  std::shared_ptr<MailBox> mail_box_ = std::make_shared<MailBox>();

  ignition::transport::Node node_;
  GazeboServer server_{node_};
  GazeboWorld world_;
  SonarCarriers carriers_;
  SceneKeeper keeper_;
  std::optional<ServedWorld> served_;
  std::string subscribed_;  // Name of the world.
  bool announced_waiting_ = false;
  bool needs_scene_ = false, has_scene_ = false, needs_update_ = false, announced_world_ = false;
  bool newest_changes_ = false;  // Whether poses arrived since the last drive().
  double stamp_ = 0;             // Time of the newest poses [s].
  WorldStepper stepper_;
  Clock::time_point next_look_, next_request_, settled_at_;
  std::optional<Clock::time_point> several_since_;  // Since when several servers have this world.
  std::string last_warning_;
  std::thread thread_;
};

}  // namespace insonify
