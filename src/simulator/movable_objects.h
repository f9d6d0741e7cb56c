// movable_objects.h -- objects that ping requests can move, and their current poses.

#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "echo/batch/ping_view.h"
#include "insonify/scenario.h"
#include "insonify/simulator.h"

namespace insonify {

/// An object is one or several instances of the scene: the one of that name, and all whose name starts with it and
/// "::".
class MovableObjects {
 public:
  /// Makes the objects named by `motions` movable and marks their instances as moving. An object's frame is its
  /// trajectory's pose at time 0.
  /// @throws Error for an object that is not in the scene or already moves.
  void add(std::span<const Motion> motions, Scene& scene);

  /// Likewise for objects among the instances [first, last). An object may be part of another.
  void add(std::span<const MovableObject> movable, Scene& scene, std::size_t first, std::size_t last);

  /// Makes movable all instances of [first, last) that are already marked as moving.
  void add_marked(const Scene& scene, std::size_t first, std::size_t last);

  /// Places objects as a request has them, and all others as the scene has them.
  /// @param placement  Its list of moved instances is replaced.
  /// @throws Error for an object that does not exist or cannot be moved.
  void place(std::span<const MovedObject> moved, const Scene& scene, Placement& placement);

  /// The scene with everything where a request has it.
  /// @throws Error as place().
  [[nodiscard]] Scene placed(std::span<const MovedObject> moved, const Scene& scene);

  /// Removes the instances that have been removed from the scene, and objects without any other. Their indices may be
  /// those of other instances later.
  void forget_removed(const Scene& scene);

 private:
  struct Piece {
    int instance = 0;
    Pose object_from_mesh;
  };
  struct Object {
    std::string name;
    std::vector<Piece> pieces;
  };

  Object& add_object(const std::string& name, std::size_t first, std::size_t last,
                     const std::optional<Pose>& world_from_object, Scene& scene);
  void set_next(const MovedObject& moved, const Scene& scene);
  void set_all_next(std::span<const MovedObject> moved, const Scene& scene);

  std::map<int, Pose> next_;  // World from mesh at this ping, of each instance that can move.
  std::vector<Object> objects_;
};

/// Whether an instance is the object of this name or part of it.
[[nodiscard]] bool belongs_to(const Instance& instance, std::string_view object);

/// "box, floor, ship": the objects of a scene, each by the first part of its scoped name.
[[nodiscard]] std::string object_names(const Scene& scene);

}  // namespace insonify
