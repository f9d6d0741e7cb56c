// gazebo_player.cpp -- serves a scene and publishes poses.

#include "bridges/gazebo/gazebo_player.h"

#include <gz_types.pb.h>
#include <ignition/msgs/boolean.pb.h>
#include <ignition/msgs/empty.pb.h>
#include <ignition/msgs/uint32_v.pb.h>
#include <ignition/msgs/world_control.pb.h>

#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace insonify {
namespace {

using ignition::msgs::Geometry;

void set(ignition::msgs::Pose& to, const Pose& pose) {
  to.mutable_position()->set_x(pose.position.x());
  to.mutable_position()->set_y(pose.position.y());
  to.mutable_position()->set_z(pose.position.z());
  to.mutable_orientation()->set_x(pose.orientation.x());
  to.mutable_orientation()->set_y(pose.orientation.y());
  to.mutable_orientation()->set_z(pose.orientation.z());
  to.mutable_orientation()->set_w(pose.orientation.w());
}

void set_geometry(Geometry& geometry, const std::string& text) {
  std::istringstream words(text);
  std::string kind;
  words >> kind;
  const auto number = [&] {
    double value = 0;
    words >> value;
    return value;
  };
  if (kind == "box") {
    geometry.set_type(Geometry::BOX);
    geometry.mutable_box()->mutable_size()->set_x(number());
    geometry.mutable_box()->mutable_size()->set_y(number());
    geometry.mutable_box()->mutable_size()->set_z(number());
  } else if (kind == "sphere") {
    geometry.set_type(Geometry::SPHERE);
    geometry.mutable_sphere()->set_radius(number());
  } else if (kind == "cylinder") {
    geometry.set_type(Geometry::CYLINDER);
    geometry.mutable_cylinder()->set_radius(number());
    geometry.mutable_cylinder()->set_length(number());
  } else if (kind == "mesh") {
    geometry.set_type(Geometry::MESH);
    std::string file;
    words >> file;
    geometry.mutable_mesh()->set_filename(file);
    geometry.mutable_mesh()->mutable_scale()->set_x(1);
    geometry.mutable_mesh()->mutable_scale()->set_y(1);
    geometry.mutable_mesh()->mutable_scale()->set_z(1);
  } else {
    geometry.set_type(Geometry::EMPTY);
  }
  if (words.fail()) {
    throw std::runtime_error("no geometry: " + text);
  }
}

void put(ignition::msgs::Scene& scene, std::uint32_t id, const std::string& name, const Pose& pose, bool is_static,
         const std::string& geometry) {
  auto& model = *scene.add_model();
  model.set_id(id);
  model.set_name(name);
  model.set_is_static(is_static);
  set(*model.mutable_pose(), pose);
  auto& link = *model.add_link();
  link.set_id(id + 1);
  link.set_name("link");
  set(*link.mutable_pose(), {});
  auto& visual = *link.add_visual();
  visual.set_id(id + 2);
  visual.set_parent_id(id + 1);
  visual.set_name("visual");
  set(*visual.mutable_pose(), {});
  set_geometry(*visual.mutable_geometry(), geometry);
}

}  // namespace

GazeboPlayer::Publisher GazeboPlayer::advertise(const std::string& topic, const std::string& type) {
  return node_.Advertise(topic, (newer_ ? "gz.msgs." : "ignition.msgs.") + type);
}

template <typename Message>
void GazeboPlayer::publish(Publisher& publisher, const Message& message) {
  const std::string type = message.GetTypeName();
  publisher.PublishRaw(message.SerializeAsString(), newer_ ? "gz." + type.substr(type.find('.') + 1) : type);
}

GazeboPlayer::GazeboPlayer(const std::string& world, bool newer) : newer_(newer) {
  const std::string at = "/world/" + world + "/";
  poses_ = advertise(at + "pose/info", "Pose_V");
  dynamic_poses_ = advertise(at + "dynamic_pose/info", "Pose_V");
  new_models_ = advertise(at + "scene/info", "Scene");
  deletions_ = advertise(at + "scene/deletion", "UInt32_V");
  if (newer) {
    std::function<bool(const gz::msgs::Empty&, gz::msgs::Scene&)> serve = [this](const auto&, gz::msgs::Scene& answer) {
      const std::lock_guard lock(mutex_);
      return answer.ParseFromString(scene_.SerializeAsString());
    };
    node_.Advertise(at + "scene/info", serve);
  } else {
    std::function<bool(ignition::msgs::Scene&)> serve = [this](ignition::msgs::Scene& answer) {
      const std::lock_guard lock(mutex_);
      answer = scene_;
      return true;
    };
    node_.Advertise(at + "scene/info", serve);
  }
  serve_control(at + "control");
}

void GazeboPlayer::serve_control(const std::string& service) {
  using ignition::msgs::WorldControl;
  if (newer_) {
    std::function<bool(const gz::msgs::WorldControl&, gz::msgs::Boolean&)> serve =
        [this](const gz::msgs::WorldControl& asked, gz::msgs::Boolean& answer) {
          WorldControl control;
          ignition::msgs::Boolean done;
          done.set_data(control.ParseFromString(asked.SerializeAsString()) && control.pause() &&
                        make_steps(control.multi_step()));
          return answer.ParseFromString(done.SerializeAsString());
        };
    node_.Advertise(service, serve);
  } else {
    std::function<bool(const WorldControl&, ignition::msgs::Boolean&)> serve = [this](const WorldControl& control,
                                                                                      ignition::msgs::Boolean& answer) {
      answer.set_data(control.pause() && make_steps(control.multi_step()));
      return true;
    };
    node_.Advertise(service, serve);
  }
}

bool GazeboPlayer::make_steps(unsigned count) {
  const std::lock_guard lock(mutex_);
  time_ += count * step_;
  for (auto& model : *scene_.mutable_model()) {
    if (model.id() == moving_) {
      model.mutable_pose()->mutable_position()->set_x(model.pose().position().x() + count * step_ * speed_);
    }
  }
  return count > 0 && step_ > 0;
}

void GazeboPlayer::live(std::uint32_t id, double step, double speed) {
  {
    const std::lock_guard lock(mutex_);
    moving_ = id;
    step_ = step;
    speed_ = speed;
  }
  living_ = std::jthread([this](const std::stop_token& ending) {
    while (!ending.stop_requested()) {
      tell_poses();
      std::this_thread::sleep_for(std::chrono::milliseconds(16));
    }
  });
}

void GazeboPlayer::add_in_silence(std::uint32_t id, const std::string& name, const Pose& pose, bool is_static,
                                  const std::string& geometry) {
  const std::lock_guard lock(mutex_);
  put(scene_, id, name, pose, is_static, geometry);
}

void GazeboPlayer::add(std::uint32_t id, const std::string& name, const Pose& pose, bool is_static,
                       const std::string& geometry) {
  add_in_silence(id, name, pose, is_static, geometry);
  ignition::msgs::Scene news;
  put(news, id, name, pose, is_static, geometry);
  publish(new_models_, news);
}

void GazeboPlayer::remove_in_silence(std::uint32_t id) {
  const std::lock_guard lock(mutex_);
  for (int i = 0; i < scene_.model_size(); ++i) {
    if (scene_.model(i).id() == id) {
      scene_.mutable_model()->DeleteSubrange(i, 1);
      return;
    }
  }
  throw std::runtime_error("no model " + std::to_string(id));
}

void GazeboPlayer::remove(std::uint32_t id) {
  remove_in_silence(id);
  ignition::msgs::UInt32_V news;
  news.add_data(id);
  publish(deletions_, news);
}

void GazeboPlayer::move(std::uint32_t id, const Pose& pose) {
  const std::lock_guard lock(mutex_);
  for (auto& model : *scene_.mutable_model()) {
    if (model.id() == id) {
      set(*model.mutable_pose(), pose);
    } else if (model.id() + 1 == id) {
      set(*model.mutable_link(0)->mutable_pose(), pose);
    } else if (model.id() + 2 == id) {
      set(*model.mutable_link(0)->mutable_visual(0)->mutable_pose(), pose);
    }
  }
}

void GazeboPlayer::tell_poses(double time) {
  {
    const std::lock_guard lock(mutex_);
    time_ = time;
  }
  tell_poses();
}

// Time and places of one step.
void GazeboPlayer::tell_poses() {
  std::unique_lock lock(mutex_);
  const double time = time_;
  ignition::msgs::Pose_V all, moving;
  const double whole = std::floor(time);
  for (ignition::msgs::Pose_V* poses : {&all, &moving}) {
    poses->mutable_header()->mutable_stamp()->set_sec(static_cast<std::int64_t>(whole));
    poses->mutable_header()->mutable_stamp()->set_nsec(static_cast<std::int32_t>(std::lround((time - whole) * 1e9)));
  }
  const auto add = [](ignition::msgs::Pose_V& to, const auto& entity) {
    auto& pose = *to.add_pose();
    pose = entity.pose();
    pose.set_name(entity.name());
    pose.set_id(entity.id());
  };
  for (const auto& model : scene_.model()) {
    const auto& link = model.link(0);
    add(all, model);
    add(all, link);
    add(all, link.visual(0));
    if (!model.is_static()) {
      add(moving, model);
      add(moving, link);
    }
  }
  lock.unlock();
  auto& light = *all.add_pose();  // The models of the scene do not have it.
  light.set_id(4'000'000);
  light.set_name("sun");
  publish(poses_, all);
  publish(dynamic_poses_, moving);
}

}  // namespace insonify
