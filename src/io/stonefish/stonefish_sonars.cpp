// stonefish_sonars.cpp -- converts forward-looking, scanning and side-scan sensors.

#include "io/stonefish/stonefish_sonars.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "insonify/printable.h"
#include "io/file/missing_parts.h"
#include "io/file/scene_folders.h"
#include "io/stonefish/stonefish_bodies.h"
#include "io/stonefish/stonefish_source.h"

namespace insonify {
namespace {

// Stonefish's defaults for a sensor without <settings>.
constexpr double kMinRange = 0.5, kMaxRange = 10;  // [m]

// Orientation of a sonar in the frame of its sensor.
// @param axis  Acoustic axis, a unit vector.
// @param up    Direction whose part across the axis is the sonar's up.
Pose sensor_from_sonar(const Vec3& axis, const Vec3& up) {
  Eigen::Matrix3d columns;
  columns.col(0) = axis;
  columns.col(2) = (up - up.dot(axis) * axis).normalized();
  columns.col(1) = columns.col(2).cross(columns.col(0));
  return {Vec3::Zero(), Eigen::Quaterniond(columns).normalized()};
}

// A sensor looks along its z, with x to starboard and y down.
Pose looking_along_z() {
  return sensor_from_sonar(Vec3::UnitZ(), -Vec3::UnitY());
}

// A whole number from 1 to what an int holds; its own limits are checked with the sonar's.
int count(const StonefishElement& sensor, const char* attribute) {
  const double number = stonefish_number(sensor, "specs", attribute);
  if (!(number >= 1) || number > 1e9 || number != std::floor(number)) {
    throw Error(
        fmt::format("{}: <specs> {} = {} must be a whole number of at least 1", sensor.what(), attribute, number));
  }
  return static_cast<int>(number);
}

double angle(const StonefishElement& sensor, const char* attribute) {
  return radians_from_degrees(stonefish_number(sensor, "specs", attribute));
}

// Common part of the three types. A name becomes part of file names.
SonarConfig common(const StonefishElement& sensor) {
  SonarConfig sonar;
  sonar.name = stonefish_text(sensor, "", "name");
  for (char& letter : sonar.name) {
    const bool is_plain = letter != '/' && letter != '\\' && static_cast<unsigned char>(letter) >= ' ' && letter != 127;
    letter = is_plain ? letter : '_';
  }
  sonar.model = "Stonefish " + sensor.type();
  sonar.min_range = stonefish_number_or(sensor, "settings", "range_min", kMinRange);
  sonar.max_range = stonefish_number_or(sensor, "settings", "range_max", kMaxRange);
  sonar.gain = stonefish_number_or(sensor, "settings", "gain", 1);
  sonar.bin_count = count(sensor, "bins");
  return sonar;
}

SonarConfig forward_looking(const StonefishElement& sensor) {
  SonarConfig sonar = common(sensor);
  sonar.beam_count = count(sensor, "beams");
  sonar.azimuth_aperture = angle(sensor, "horizontal_fov");
  sonar.elevation_aperture = angle(sensor, "vertical_fov");
  return sonar;
}

// The head turns to starboard from the port edge of its sector, in steps that divide the circle evenly.
SonarConfig scanning(const StonefishElement& sensor) {
  SonarConfig sonar = common(sensor);
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = angle(sensor, "horizontal_beam_width");
  sonar.elevation_aperture = angle(sensor, "vertical_beam_width");
  const double step = stonefish_number(sensor, "specs", "step");
  if (!(step > 0) || step > 180) {
    throw Error(fmt::format("{}: <specs> step = {} deg must be above 0 and at most 180 deg", sensor.what(), step));
  }
  sonar.head.step = -2 * std::numbers::pi / std::ceil(360 / step);
  const double low = stonefish_number_or(sensor, "settings", "rotation_min", -180);
  const double high = stonefish_number_or(sensor, "settings", "rotation_max", 180);
  if (!(low < high) || low < -180 || high > 180) {
    throw Error(fmt::format("{}: <settings> rotation_min = {} and rotation_max = {} deg must rise within -180 to 180",
                            sensor.what(), low, high));
  }
  sonar.head.sector_center = radians_from_degrees(-(low + high) / 2);
  sonar.head.sector_width = radians_from_degrees(high - low);
  return sonar;
}

// One of the two transducers of a side-scan sensor, whose z looks down, with x to starboard: a beam that is narrow
// along the track. `vertical_tilt` is the angle of its axis below the horizontal; the bins are those of both sides.
SonarConfig side_scan(const StonefishElement& sensor, const char* side) {
  SonarConfig sonar = common(sensor);
  sonar.name += fmt::format("_{}", side);
  sonar.bin_count = (sonar.bin_count + 1) / 2;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = angle(sensor, "horizontal_beam_width");
  sonar.elevation_aperture = angle(sensor, "vertical_beam_width");
  return sonar;
}

Pose side_looking(const StonefishElement& sensor, double sign) {
  const double tilt = stonefish_number(sensor, "specs", "vertical_tilt");
  if (tilt < 0 || tilt > 90) {
    throw Error(fmt::format("{}: <specs> vertical_tilt = {} deg must be from 0 to 90 deg", sensor.what(), tilt));
  }
  const double below = radians_from_degrees(tilt);
  const Vec3 axis(sign * std::cos(below), 0, std::sin(below));
  // Straight down has no up of its own: there the side is up.
  return sensor_from_sonar(axis, tilt < 89 ? Vec3(-Vec3::UnitZ()) : Vec3(sign * Vec3::UnitX()));
}

class SonarList {
 public:
  explicit SonarList(bool on_vehicle) : on_vehicle_(on_vehicle) {}

  void add(const StonefishSensor& sensor) {
    const StonefishElement& element = sensor.element;
    if (element.type() == "fls") {
      add(sensor, forward_looking(element), looking_along_z());
    } else if (element.type() == "msis") {
      add(sensor, scanning(element), looking_along_z());
    } else {
      add(sensor, side_scan(element, "port"), side_looking(element, -1));
      add(sensor, side_scan(element, "starboard"), side_looking(element, 1));
    }
  }

  std::vector<StonefishSonar> take() { return std::move(sonars_); }

 private:
  void add(const StonefishSensor& sensor, SonarConfig sonar, const Pose& sensor_from_sonar) {
    const Pose pose =
        up_from_down() * (on_vehicle_ ? sensor.vehicle_from_sensor : sensor.world_from_sensor) * sensor_from_sonar;
    sonar.position = pose.position;
    sonar.orientation = rpy_from_orientation(pose.orientation);
    if (names_.contains(sonar.name) && !sensor.owner.empty()) {
      sonar.name = sensor.owner + "_" + sonar.name;
    }
    for (int i = 2; !names_.insert(sonar.name).second; ++i) {
      sonar.name += fmt::format("_{}", i);
    }
    const Place place = sensor.element.file->place(sensor.element.node);
    try {
      sonar.validate(fmt::format("{} '{}'", sensor.element.node.name(), printable(sensor.element.name())));
    } catch (const Error& error) {
      throw error.at(place);
    }
    sonars_.push_back({std::move(sonar), place});
  }

  bool on_vehicle_;
  std::set<std::string> names_;
  std::vector<StonefishSonar> sonars_;
};

}  // namespace

StonefishSonars load_stonefish_sonars(const std::filesystem::path& path, bool on_vehicle,
                                      std::span<const std::string> arguments) {
  const SceneFolders folders(path);
  MissingParts missing;
  const StonefishSource source(path, arguments, missing);
  const StonefishBodies bodies(source, missing);
  SonarList list(on_vehicle);
  for (const StonefishSensor& sensor : bodies.sensors()) {
    try {
      list.add(sensor);
    } catch (const UnreadablePart& unreadable) {
      missing.add(unreadable);
    }
  }
  return {list.take(), missing.empty() ? "" : missing.text()};
}

}  // namespace insonify
