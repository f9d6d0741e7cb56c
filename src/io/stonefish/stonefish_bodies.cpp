// stonefish_bodies.cpp -- places bodies, walks along the joints of robots and collects sensors.

#include "io/stonefish/stonefish_bodies.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <string_view>

#include "base/log_line.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// Elements without a shape that belong to a scenario's physics or looks: nobody misses them in an echo.
bool is_silent(std::string_view name) {
  static const std::set<std::string_view> kSilent = {"materials", "looks", "solver", "world_transform"};
  return kSilent.contains(name) || name.starts_with("ros_");
}

bool is_body(std::string_view name) {
  return name == "static" || name == "dynamic" || name == "animated";
}

// Pose of a body in the world. That of an animated one is its trajectory's first point.
Pose world_from_body(const StonefishElement& element) {
  if (element.node.name() != std::string_view("animated")) {
    return stonefish_pose(element, "world_transform");
  }
  const StonefishElement trajectory = element.child("trajectory");
  if (!trajectory) {
    throw Error(element.what() + ": <trajectory> is missing");
  }
  const StonefishElement point = trajectory.child("keypoint");
  return point ? stonefish_pose(point, "") : Pose{};
}

std::string name_of(const StonefishElement& element) {
  return stonefish_text(element, "", "name");
}

std::vector<StonefishElement> children(const StonefishElement& element, const char* name) {
  std::vector<StonefishElement> found;
  for (const pugi::xml_node node : element.node.children(name)) {
    found.push_back({node, element.file, element.path});
  }
  return found;
}

}  // namespace

StonefishBodies::StonefishBodies(const StonefishSource& source, MissingParts& missing) : missing_(missing) {
  for (const StonefishElement& element : source.elements()) {
    try {
      add(element);
    } catch (const UnreadablePart& unreadable) {
      missing_.add(unreadable);
    }
  }
}

void StonefishBodies::add(const StonefishElement& element) {
  const std::string_view name = element.node.name();
  if (is_body(name)) {
    add_body(element);
  } else if (name == "robot") {
    add_robot(element);
  } else if (name == "sensor") {
    add_sensor(element, "", {}, {}, "world_transform");
  } else if (name == "environment") {
    count_environment(element);
  } else {
    count(element);
  }
}

void StonefishBodies::add_body(const StonefishElement& element) {
  const std::string name = name_of(element);
  const Pose pose = world_from_body(element);
  bodies_.push_back({name, element, pose});
  const std::vector<StonefishElement> points = children(element.child("trajectory"), "keypoint");
  if (points.size() > 1) {
    ++animated_;
  }
  for (const StonefishElement& sensor : children(element, "sensor")) {
    add_sensor(sensor, name, pose, {}, "origin");
  }
  for (const char* other : {"light", "comm"}) {
    for (const StonefishElement& device : children(element, other)) {
      count(device);
    }
  }
}

// Places the base link, then the links that joints connect to it, outwards.
void StonefishBodies::add_links(const StonefishElement& robot, const Pose& world_from_base,
                                std::map<std::string, Pose>& links) {
  const StonefishElement base = robot.child("base_link");
  if (!base) {
    throw Error(robot.what() + ": <base_link> is missing");
  }
  std::map<std::string, StonefishElement> loose;
  for (const StonefishElement& link : children(robot, "link")) {
    loose.emplace(name_of(link), link);
  }
  std::multimap<std::string, StonefishElement> joints;  // By their parents.
  for (const StonefishElement& joint : children(robot, "joint")) {
    joints.emplace(stonefish_text(joint, "parent", "name"), joint);
  }
  std::vector<std::string> placed;
  const auto place = [&](const std::string& name, const StonefishElement& link, const Pose& pose) {
    links[name] = pose;
    bodies_.push_back({robot.name() + "::" + name, link, pose});
    placed.push_back(name);
  };
  place(name_of(base), base, world_from_base);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const std::string parent = placed[i];
    for (auto [joint, end] = joints.equal_range(parent); joint != end; ++joint) {
      const auto child = loose.find(stonefish_text(joint->second, "child", "name"));
      if (child == loose.end()) {
        continue;
      }
      place(child->first, child->second, links.at(parent) * stonefish_pose(joint->second, "origin"));
      loose.erase(child);
      joints_ += joint->second.type() != "fixed" ? 1 : 0;
    }
  }
  for (const auto& [name, link] : loose) {
    missing_.add(link.what(), " is joined to no link of its robot");
  }
}

void StonefishBodies::add_robot(const StonefishElement& robot) {
  (void)name_of(robot);
  const Pose world_from_base = stonefish_pose(robot, "world_transform");
  std::map<std::string, Pose> links;
  add_links(robot, world_from_base, links);
  for (const pugi::xml_node node : robot.node.children()) {
    const StonefishElement part{node, robot.file, robot.path};
    const std::string_view kind = node.name();
    if (node.type() != pugi::node_element || kind == "base_link" || kind == "link" || kind == "joint") {
      continue;
    }
    if (kind != "sensor" || part.child("joint")) {
      count(part);
      continue;
    }
    const auto link = links.find(part.child("link").name());
    if (link == links.end()) {
      missing_.add(part.what(), " is attached to no link of its robot");
      continue;
    }
    add_sensor(part, robot.name(), link->second, world_from_base.inverse() * link->second, "origin");
  }
}

void StonefishBodies::add_sensor(const StonefishElement& sensor, const std::string& owner, const Pose& world_from_body,
                                 const Pose& vehicle_from_body, const char* pose) {
  static const std::set<std::string> kSonars = {"fls", "msis", "sss"};
  if (!kSonars.contains(sensor.type())) {
    count(sensor);
    return;
  }
  try {
    const Pose body_from_sensor = stonefish_pose(sensor, pose);
    sensors_.push_back({sensor, owner, world_from_body * body_from_sensor, vehicle_from_body * body_from_sensor});
  } catch (const UnreadablePart& unreadable) {
    missing_.add(unreadable);
  }
}

// Currents and waves act on vehicles, and the sea's surface is a setting of our scenarios.
void StonefishBodies::count_environment(const StonefishElement& environment) {
  const StonefishElement ocean = environment.child("ocean");
  has_ocean_ = has_ocean_ || ocean;
  for (const StonefishElement& current : children(ocean, "current")) {
    count(current);
  }
  for (const StonefishElement& wind : children(environment.child("atmosphere"), "wind")) {
    count(wind);
  }
}

void StonefishBodies::count(const StonefishElement& element) {
  const std::string name = printable(element.node.name());
  if (is_silent(name)) {
    return;
  }
  const bool has_type = name == "sensor" && !element.type().empty();
  ++not_read_[has_type ? fmt::format("sensor of type {}", printable(element.type())) : name];
}

void StonefishBodies::report_not_read(const std::string& file, const Log& log) const {
  const auto report = [&](const std::string& what) {
    log_line(log, Severity::kInfo, fmt::format("{}: {}", file, what));
  };
  std::vector<std::string> kinds;
  for (const auto& [kind, times] : not_read_) {
    kinds.push_back(fmt::format("{} ({})", kind, times));
  }
  if (!kinds.empty()) {
    report(fmt::format("not read: {}", fmt::join(kinds, ", ")));
  }
  if (joints_ > 0) {
    report(fmt::format("at their zero position: joints that move ({})", joints_));
  }
  if (animated_ > 0) {
    report(fmt::format("where their trajectories begin: animated bodies ({})", animated_));
  }
  if (has_ocean_) {
    report("the ocean's surface is not read: it is where `surface` of a scenario of insonify says");
  }
}

}  // namespace insonify
