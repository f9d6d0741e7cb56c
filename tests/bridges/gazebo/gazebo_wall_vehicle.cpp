// gazebo_wall_vehicle.cpp -- plays a Gazebo with a vehicle beside a wall, and measures the wall's distance in the sonar
// images that come back. `bench/follow_wall.py gazebo` starts it.
//
//   gazebo_wall_vehicle LOW HIGH       the levels of the images [dB]; rides until its input is closed
//
// Prints "rides" once the bridge reads its poses, and at the end for each image a line with the time of its pose and
// the time when it came [s since the start], the distance measured and the length of a bin [m].

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "bridges/gazebo/gazebo_player.h"
#include "bridges/gazebo/gazebo_reader.h"
#include "bridges/wall_ride.h"

namespace insonify {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Gazebo publishes poses 60 times a second, after steps of a millisecond.
void ride(double decibels_per_value) {
  constexpr double kPoses = 60, kStep = 1e-3;  // [Hz], [s]
  constexpr double kWall = -5;                 // y of its near side [m].
  GazeboPlayer player("sea", true);
  player.add(10, "wall", {Vec3(50, kWall - 0.5, 0)}, true, "box 300 1 18");
  player.add(20, "auv", Pose{place_at(0)}, false, "sphere 0.3");
  std::mutex mutex;
  std::vector<std::pair<double, std::string>> arrived;
  const Clock::time_point start = Clock::now();
  ignition::transport::Node node;
  node.SubscribeRaw(
      "/fls/sonar_image",
      [&](const char* bytes, std::size_t size, const ignition::transport::MessageInfo&) {
        const std::lock_guard lock(mutex);
        arrived.emplace_back(seconds_since(start), std::string(bytes, size));
      },
      "gz.msgs.Image");
  std::optional<double> begin;  // When the ride begins; until then the vehicle lies still.
  for (int i = 0; begin || seconds_since(start) < 20; ++i) {
    const double now = std::round(i / kPoses / kStep) * kStep;
    std::this_thread::sleep_until(start +
                                  std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(now)));
    player.move(20, Pose{place_at(begin ? now - *begin : 0)});
    player.tell_poses(now);
    const std::lock_guard lock(mutex);
    if (!begin && !arrived.empty()) {
      begin = now;
      fmt::print("rides\n");
      std::fflush(stdout);
    }
    if (input_is_closed()) {
      break;
    }
  }
  if (!begin) {
    throw std::runtime_error("no image comes");
  }
  node.Unsubscribe("/fls/sonar_image");
  const std::lock_guard lock(mutex);
  for (const auto& [when, message] : arrived) {
    const GazeboSonarImage image(message);
    fmt::print("{:.6f} {:.6f} {:.4f} {:.6f} {}\n", image.time - *begin, when - *begin,
               first_echo(image.azimuths, image.ranges, image.values, decibels_per_value),
               image.ranges.at(1) - image.ranges.at(0), image.number);
  }
}

}  // namespace
}  // namespace insonify

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "gazebo_wall_vehicle LOW HIGH\n");
    return 2;
  }
  try {
    insonify::ride((std::atof(argv[2]) - std::atof(argv[1])) / 65535);
  } catch (const std::exception& error) {
    fmt::print(stderr, "gazebo_wall_vehicle: {}\n", error.what());
    return 1;
  }
}
