// movable_objects.h -- what requests may move, and where it is now.

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "insonify/scenario.h"
#include "insonify/simulator.h"

namespace insonify {

/// Objects are instances of a scene: those of the object's very name, and all whose name starts with it and "::".
class MovableObjects {
 public:
  /// Makes the objects that motions name movable, and marks their instances moving. The frame of each is where its
  /// trajectory has it at time 0.
  /// @throws Error for one that is not there, or already moves.
  void add(std::span<const Motion> motions, Scene& scene);

  /// The same for objects among the instances from `first` on. They may be parts of others.
  void add(std::span<const MovableObject> movable, Scene& scene, std::size_t first = 0);

  /// Makes instances from `first` on movable that are marked moving already.
  void add_marked(const Scene& scene, std::size_t first = 0);

  /// Has the engine place everything where a request has it, and all else where the scene has it. Allocates nothing.
  /// @throws Error for what does not move or is not there; everything then is where it was.
  void place(std::span<const MovedObject> moved, const Scene& scene, Engine& engine);

  /// Tells that the engine has taken in the scene anew, perhaps with fewer instances.
  void reset(const Scene& scene);

 private:
  // An instance that moves.
  struct Part {
    int instance = 0;
    Pose now, next;  // World from mesh: as the engine has it, and as this ping is to have it.
  };
  struct Piece {
    std::size_t part = 0;
    Pose object_from_mesh;
  };
  struct Object {
    std::string name;
    std::vector<Piece> pieces;
  };

  Object& add_object(const std::string& name, std::size_t first, const std::optional<Pose>& world_from_object,
                     Scene& scene);
  [[nodiscard]] Part* find_part(int instance);
  void set_next(const MovedObject& moved, const Scene& scene);

  std::vector<Part> parts_;
  std::vector<Object> objects_;
};

/// Whether an instance is an object of this name, or part of it.
[[nodiscard]] bool belongs_to(const Instance& instance, std::string_view object);

/// "box, floor, ship": the first parts of the scoped names of what is there.
[[nodiscard]] std::string object_names(const Scene& scene);

}  // namespace insonify
