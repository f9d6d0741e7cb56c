// world_parts.h -- a scene of shapes that another program describes, such as a simulator that runs.

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "insonify/files.h"
#include "insonify/geometry.h"
#include "insonify/log.h"
#include "insonify/scene.h"

namespace insonify {

enum class ShapeKind { kBox, kSphere, kEllipsoid, kCylinder, kCapsule, kCone, kPlane, kMesh, kHeightmap };

/// One of the shapes of SDF, in its own frame. Each kind has some of the fields.
struct Shape {
  ShapeKind kind = ShapeKind::kBox;
  std::optional<Vec3> size =
      {};                        ///< kBox: full lengths; kEllipsoid: radii; kPlane: its sides in x and y, absent for an
                                 ///< endless one; kHeightmap: full lengths, absent for the grid's own [m]; each > 0.
  double radius = 0;             ///< kSphere, kCylinder, kCapsule, kCone [m], > 0.
  double length = 0;             ///< kCylinder, kCapsule (without its ends), kCone [m], > 0.
  Vec3 normal = Vec3::UnitZ();   ///< kPlane: a unit vector.
  std::string uri = {};          ///< kMesh, kHeightmap: file as SDF names it: "model://ship/hull.dae", a path ...
  std::string submesh = {};      ///< kMesh: the part of the file to take; "" for all.
  bool center_submesh = false;   ///< kMesh: whether that part is moved to the origin.
  Vec3 scale = Vec3::Ones();     ///< kMesh: factors, none 0; negative ones mirror.
  Vec3 position = Vec3::Zero();  ///< kHeightmap: of its middle [m].
  int sampling = 1;              ///< kHeightmap: steps per pixel, 1..16.
};

/// A visual or a collision.
struct WorldPart {
  std::string name;  ///< In full: "ship::hull::plate"; of one scene all differ.
  Shape shape;
  Pose world_from_part;
  bool moving = false;         ///< Becomes Instance::moving.
  bool for_eyes_only = false;  ///< Whether it is water, or invisible to cameras: told to the log.
  std::string material = {};   ///< Becomes Instance::user_material.
};

/// What carries a sonar that stands in the SDF file of a world.
struct SonarCarrier {
  std::string sonar;
  std::string carrier;        ///< A link or model, in full: "rov::base_link".
  Pose carrier_from_vehicle;  ///< Where the file has the vehicle, to which the sonar's pose in the scenario refers: the
                              ///< carrier of the file's first sonar.
};

/// The carriers of those sonars of a scenario that have the name of one in its world's SDF file. None where the world
/// is none of SDF's.
/// @throws Error as load_scenario().
[[nodiscard]] std::vector<SonarCarrier> load_sonar_carriers(const Scenario& scenario);

/// Makes scenes of parts as load_scene() does of an SDF world. Files are read once, however many parts name them.
class WorldParts {
 public:
  /// @param base     A file, there or not, whose folder is searched for URIs first, then those above it and those that
  ///                 the variables of the environment name (docs/reference/sdf.md).
  /// @param options  `ignore` leaves parts out; with `strict` a part that cannot be made is an error. `collisions` has
  ///                 no effect.
  /// @param log      Takes one warning a call for all parts that are left out since they cannot be made.
  explicit WorldParts(std::filesystem::path base, WorldOptions options = {}, Log log = {});
  ~WorldParts();
  WorldParts(WorldParts&&) noexcept;
  WorldParts& operator=(WorldParts&&) noexcept;

  /// Those of the parts that are not left out, in their order; it may be empty. Materials are not assigned.
  /// @param name  Of all of them, for the log: "the world tank".
  /// @throws Error for two parts of the same name, and with `strict` for one that cannot be made.
  [[nodiscard]] Scene scene(std::span<const WorldPart> parts, const std::string& name);

  /// Warns of each pattern of `ignore` that has matched no part so far.
  void report_unused_patterns(const std::string& name) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
