// straight_edges.h -- the straight edges of plane faces: corners of boxes and profiles, borders of plates.

#pragma once

#include <array>
#include <vector>

#include "echo/engine.h"
#include "echo/targets/face_glints.h"

namespace insonify {

/// The straight edges of a scene at which two plane faces that reflect coherently meet, or one ends: of those between
/// two faces the side with more than half of the water around them. Of thin parts (ropes, rods, narrow profiles) those
/// of square ones alone: the others may be round bodies of few triangles.
struct StraightEdges {
  static constexpr double kLeastLength = 0.03;  ///< Shorter ones are left out [m].
  static constexpr double kLeastTurn = 0.5;     ///< Least angle between the normals of two faces [rad].
  static constexpr double kSquareTurn = 1.3;    ///< Likewise, of thin parts.
  static constexpr double kStraight = 2.5e-4;   ///< Distance from a line that does not matter [m].
  static constexpr double kFree = 1e-3;         ///< Nothing else touches an edge within this distance [m].
  static constexpr std::size_t kNoGlint = ~0ULL;
  static constexpr std::size_t kMost = 5000;  ///< Most edges of a scene: the longest are taken.

  /// One face at an edge.
  struct Side {
    Vec3 inwards = Vec3::UnitX();  ///< Unit vector in the face, from the edge and perpendicular to it.
    Vec3 normal = Vec3::UnitZ();   ///< Its unit normal on the side of the water.
    SurfaceLabel surface = kNoSurface;
    double sign = 1;              ///< That of its reflection coefficient: -1 where it is softer than water.
    std::size_t face = kNoGlint;  ///< Number among all GlintingFaces; kNoGlint for thin parts, whose faces are lobes.
  };

  struct Edge {
    Vec3 middle = Vec3::Zero();      ///< In the frame of its group [m].
    Vec3 along = Vec3::UnitY();      ///< Unit vector.
    double half = 0;                 ///< Half the length [m].
    double exterior = 2;             ///< Angle of the water between the faces, over pi: above 1, at most 2.
    std::array<Side, 2> sides = {};  ///< The two sides of a plate at its border.
  };

  /// Edges of one instance that moves, in the frame of its mesh, or of all others, and what of them a first pass needs.
  struct Group {
    int instance = -1;           ///< -1: of all that does not move.
    Vec3 origin = Vec3::Zero();  ///< Of the frame of these, in the world [m]; its axes are the world's.
    std::vector<Edge> edges;
    std::vector<float> middle_x, middle_y, middle_z;  ///< [edge], as all of these [m].
    std::vector<float> along_x, along_y, along_z;
    std::vector<float> first_x, first_y, first_z;     ///< Normals of the first face.
    std::vector<float> second_x, second_y, second_z;  ///< Of the second.
    std::vector<float> half;
  };
  std::vector<Group> groups;
  std::size_t left_out = 0;  ///< Edges beyond kMost.

  [[nodiscard]] bool any() const { return !groups.empty(); }
  [[nodiscard]] std::size_t most_of_a_group() const;

  /// Pose of a group's frame.
  /// @param world_from_mesh  [instance]
  [[nodiscard]] static Pose frame(const Group& group, std::span<const Pose> world_from_mesh) {
    return group.instance < 0 ? Pose{.position = group.origin}
                              : world_from_mesh[static_cast<std::size_t>(group.instance)];
  }
};

/// Finds them. Edges in the angle of which something else stands are none: where a box stands on a floor, where parts
/// of a body touch each other without common vertices.
/// @param engine  With the scene as it is; its rays look around the edges.
[[nodiscard]] StraightEdges find_straight_edges(const Scene& scene, const GlintingFaces& faces, Engine& engine);

}  // namespace insonify
