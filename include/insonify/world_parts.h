// world_parts.h -- makes a scene from shapes described by another program, such as a running simulator.

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

/// One of SDF's shapes, in its own frame. Each kind uses some of the fields.
struct Shape {
  ShapeKind kind = ShapeKind::kBox;
  std::optional<Vec3> size =
      {};                        ///< kBox: full lengths; kEllipsoid: radii; kPlane: its sides in x and y, absent for an
                                 ///< endless one; kHeightmap: full lengths, absent for the grid's own [m]; each > 0.
  double radius = 0;             ///< kSphere, kCylinder, kCapsule, kCone [m], > 0.
  double length = 0;             ///< kCylinder, kCapsule (without its ends), kCone [m], > 0.
  Vec3 normal = Vec3::UnitZ();   ///< kPlane: a unit vector.
  std::string uri = {};          ///< kMesh, kHeightmap: file as in SDF: "model://ship/hull.dae", a path ...
  std::string submesh = {};      ///< kMesh: the part of the file to use; "": all.
  bool center_submesh = false;   ///< kMesh: whether that part is moved to the origin.
  Vec3 scale = Vec3::Ones();     ///< kMesh: factors, none 0; negative ones mirror.
  Vec3 position = Vec3::Zero();  ///< kHeightmap: of its middle [m].
  int sampling = 1;              ///< kHeightmap: steps per pixel, 1..16.
};

/// A visual or a collision.
struct WorldPart {
  std::string name;  ///< Full name: "ship::hull::plate"; unique in a scene.
  Shape shape;
  Pose world_from_part;
  bool moving = false;         ///< Becomes Instance::moving.
  bool for_eyes_only = false;  ///< Whether it is water, or invisible to cameras.
  std::string material = {};   ///< Becomes Instance::user_material.
};

/// The carrier of a sonar in a world's SDF file.
struct SonarCarrier {
  std::string sonar;
  std::string carrier;        ///< Full name of a link or model: "rov::base_link".
  Pose carrier_from_vehicle;  ///< Pose of the vehicle in the file, the frame of the sonar's pose in the scenario: the
                              ///< carrier of the file's first sonar.
};

/// The carriers of a scenario's sonars that have the name of a sonar in the world's SDF file. None for other
/// worlds.
/// @throws Error as load_scenario().
[[nodiscard]] std::vector<SonarCarrier> load_sonar_carriers(const Scenario& scenario);

/// Makes scenes from parts, as load_scene() does from an SDF world. Each file is read only once.
class WorldParts {
 public:
  /// @param base     A file, existing or not, whose folder is searched for URIs first, then its parents and those named
  ///                 by environment variables (docs/reference/sdf.md).
  /// @param options  `ignore` skips parts; with `strict` a part that cannot be made is an error. `collisions` and
  ///                 `parts` have no effect.
  /// @param log      Receives one warning per call for all parts that cannot be made and are skipped.
  explicit WorldParts(std::filesystem::path base, WorldOptions options = {}, Log log = {});
  ~WorldParts();
  WorldParts(WorldParts&&) noexcept;
  WorldParts& operator=(WorldParts&&) noexcept;

  /// A scene of the parts that are not skipped, in order; may be empty. Materials are not assigned.
  /// @param name  Name of the whole, for the log: "the world tank".
  /// @throws Error for two parts of the same name, and with `strict` for one that cannot be made.
  [[nodiscard]] Scene scene(std::span<const WorldPart> parts, const std::string& name);

  /// Notes the name of a part that the caller leaves out: `ignore` patterns that match it are not reported as unused.
  void leave_out(const std::string& name);

  /// Warns of each `ignore` pattern without a match so far.
  void report_unused_patterns(const std::string& name) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
