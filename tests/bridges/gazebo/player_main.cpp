// player_main.cpp -- a process that stands in for Gazebo, controlled by lines on its standard input.
//
//     gazebo_player WORLD ignition|gz
//
//     add ID NAME X Y Z YAW static|free GEOMETRY      add-silently ... the same     remove ID     remove-silently ID
//     move ID X Y Z YAW     poses TIME     wait SECONDS     followed     live ID STEP SPEED
//
// Each line is answered by "ok"; `followed`, by which it waits for a subscriber of poses, perhaps by "no".

#include <chrono>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>

#include "bridges/gazebo/gazebo_player.h"

namespace insonify {
namespace {

Pose read_pose(std::istream& words) {
  double x = 0, y = 0, z = 0, yaw = 0;
  words >> x >> y >> z >> yaw;
  return {Vec3(x, y, z), orientation_from_rpy(0, 0, yaw)};
}

bool wait_for_followers(const GazeboPlayer& player) {
  for (int attempt = 0; attempt < 500; ++attempt) {
    if (player.is_followed()) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

std::string act(GazeboPlayer& player, const std::string& line) {
  std::istringstream words(line);
  std::string command;
  words >> command;
  if (command == "followed") {
    return wait_for_followers(player) ? "ok" : "no";
  }
  if (command == "poses" || command == "wait") {
    double time = 0;
    words >> time;
    command == "poses" ? player.tell_poses(time) : std::this_thread::sleep_for(std::chrono::duration<double>(time));
    return words ? "ok" : "what?";
  }
  std::uint32_t id = 0;
  words >> id;
  if (command == "live") {
    double step = 0, speed = 0;
    words >> step >> speed;
    player.live(id, step, speed);
  } else if (command == "remove" || command == "remove-silently") {
    command == "remove" ? player.remove(id) : player.remove_in_silence(id);
  } else if (command == "move") {
    player.move(id, read_pose(words));
  } else if (command == "add" || command == "add-silently") {
    std::string name, kind, geometry;
    words >> name;
    const Pose pose = read_pose(words);
    words >> kind;
    std::getline(words >> std::ws, geometry);
    (player.*(command == "add" ? &GazeboPlayer::add : &GazeboPlayer::add_in_silence))(id, name, pose, kind == "static",
                                                                                      geometry);
  } else {
    return "what?";
  }
  return words ? "ok" : "what?";
}

}  // namespace
}  // namespace insonify

int main(int count, char** arguments) {
  if (count != 3) {
    std::cerr << "gazebo_player WORLD ignition|gz\n";
    return 2;
  }
  insonify::GazeboPlayer player(arguments[1], arguments[2] == std::string("gz"));
  for (std::string line; std::getline(std::cin, line);) {
    std::cout << insonify::act(player, line) << std::endl;
  }
}
