// wall_vehicle.cpp -- a vehicle of ROS 2 beside a wall: writes its odometry, and measures the wall's distance in the
// sonar images that come back. `bench/follow_wall.py dds` starts it.
//
//   wall_vehicle DOMAIN LOW HIGH       the levels of the images [dB]; rides until its input is closed
//
// Prints "rides" once the bridge reads its odometry, and at the end for each image a line with the time of its pose and
// the time when it came [s since the start], the distance measured and the length of a bin [m].

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "bridges/dds/fast_node.h"
#include "bridges/dds/own_domain.h"
#include "bridges/dds/ros_messages.h"
#include "bridges/wall_ride.h"

namespace insonify {
namespace {

double unix_time() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

void ride(int domain, double decibels_per_value) {
  constexpr std::chrono::milliseconds kPosePeriod{20};
  double start = 0;
  std::mutex mutex;
  std::string lines;
  FastNode node(domain);
  const auto odometry_writer = node.writer("rt/auv/odom", "nav_msgs::msg::dds_::Odometry_", {.kept = 1});
  auto reader = node.reader(
      "rt/fls/sonar_image", "marine_acoustic_msgs::msg::dds_::ProjectedSonarImage_", {}, [&](const Bytes& message) {
        const double now = unix_time();
        const SonarImage image = sonar_image(message);
        const std::lock_guard lock(mutex);
        lines += fmt::format("{:.6f} {:.6f} {:.4f} {:.6f}\n", image.time - start, now - start,
                             first_echo(image.azimuths, image.ranges, image.values, decibels_per_value),
                             image.ranges.at(1) - image.ranges.at(0));
      });
  if (!odometry_writer->wait_for_reader() || !reader->wait_for_writer()) {
    throw std::runtime_error("the bridge is not found");
  }
  std::this_thread::sleep_for(kDiscovery);
  fmt::print("rides\n");
  std::fflush(stdout);
  start = unix_time();
  for (auto next = std::chrono::steady_clock::now(); !input_is_closed(); next += kPosePeriod) {
    std::this_thread::sleep_until(next);
    const double now = unix_time();
    const Vec3 place = place_at(now - start);
    odometry_writer->write(odometry(now, place.x(), place.y()));
  }
  reader.reset();
  fmt::print("{}", lines);
}

}  // namespace
}  // namespace insonify

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "wall_vehicle DOMAIN LOW HIGH\n");
    return 2;
  }
  try {
    insonify::ride(std::atoi(argv[1]), (std::atof(argv[3]) - std::atof(argv[2])) / 65535);
  } catch (const std::exception& error) {
    fmt::print(stderr, "wall_vehicle: {}\n", error.what());
    return 1;
  }
}
