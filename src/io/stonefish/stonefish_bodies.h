// stonefish_bodies.h -- the bodies and sensors of a Stonefish scenario, with their poses.

#pragma once

#include <map>
#include <string>
#include <vector>

#include "insonify/log.h"
#include "io/file/missing_parts.h"
#include "io/stonefish/stonefish_source.h"

namespace insonify {

/// A static, dynamic or animated body, or a link of a robot. Frames are Stonefish's: z down.
struct StonefishBody {
  std::string name;  ///< "wall", of a link "robot::link".
  StonefishElement element;
  Pose world_from_body = {};  ///< Links with all joints at zero, animated bodies at their start.
};

/// A sensor, attached to a body or to the world. Frames are Stonefish's: z down, the sensor's z its axis.
struct StonefishSensor {
  StonefishElement element;
  std::string owner;  ///< Name of the robot or body that it is attached to; "" for the world.
  Pose world_from_sensor = {};
  Pose vehicle_from_sensor = {};  ///< In the base link of its robot or in its body; of one in the world as above.
};

/// All bodies and sensors of a scenario.
class StonefishBodies {
 public:
  /// @param missing  Receives bodies and sensors without a known pose, which are skipped.
  /// @throws Error "path:line:column: ..." for faults.
  StonefishBodies(const StonefishSource& source, MissingParts& missing);

  [[nodiscard]] const std::vector<StonefishBody>& bodies() const { return bodies_; }
  [[nodiscard]] const std::vector<StonefishSensor>& sensors() const { return sensors_; }

  /// Reports to the log what is not read, and what moves in Stonefish but not here.
  /// @param file  The scenario's name in messages.
  void report_not_read(const std::string& file, const Log& log) const;

 private:
  void add(const StonefishElement& element);
  void add_body(const StonefishElement& element);
  void add_robot(const StonefishElement& robot);
  void add_links(const StonefishElement& robot, const Pose& world_from_base, std::map<std::string, Pose>& links);
  void add_sensor(const StonefishElement& sensor, const std::string& owner, const Pose& world_from_body,
                  const Pose& vehicle_from_body, const char* pose);
  void count_environment(const StonefishElement& environment);
  void count(const StonefishElement& element);

  MissingParts& missing_;
  std::vector<StonefishBody> bodies_;
  std::vector<StonefishSensor> sensors_;
  std::map<std::string, int> not_read_;  // Number of elements of each kind.
  int joints_ = 0, animated_ = 0;        // Numbers of those that move in Stonefish.
  bool has_ocean_ = false;
};

}  // namespace insonify
