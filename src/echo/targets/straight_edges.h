// straight_edges.h -- the straight edges of plane faces: edges of boxes and profiles, borders of plates.

#pragma once

#include <array>
#include <vector>

#include "echo/engine.h"
#include "echo/targets/face_glints.h"

namespace insonify {

/// The straight edges of a scene at which two plane faces that reflect coherently meet, or one ends. Edges between two
/// faces are outside ones, with an exterior angle above 180 degrees. Thin parts (ropes, rods, narrow profiles) have
/// edges only where they are square: others may be round bodies of a few triangles.
struct StraightEdges {
  static constexpr double kLeastLength = 0.03;  ///< Shorter edges are left out [m].
  static constexpr double kSquareTurn = 1.3;    ///< EdgePart::kLeastTurn for thin parts [rad].
  static constexpr double kStraight = 2.5e-4;   ///< Largest distance of an edge's vertices from its line [m].
  static constexpr double kFree = 1e-3;  ///< Edges that something else comes this close to are left out, and the two
                                         ///< edges of a sheet thinner than this are one [m].
  static constexpr std::size_t kNoGlint = ~0ULL;
  static constexpr std::size_t kMost = 5000;  ///< Most edges of a scene; the longest are taken.

  /// One face at an edge.
  struct Side {
    Vec3 inwards = Vec3::UnitX();  ///< Unit vector in the face, from the edge and perpendicular to it.
    Vec3 normal = Vec3::UnitZ();   ///< Unit normal of the face on the side of the water.
    SurfaceLabel surface = kNoSurface;
    double sign = 1;  ///< Sign of its reflection coefficient: -1 if its impedance is below water's.
    std::size_t face =
        kNoGlint;  ///< Index among all GlintingFaces; kNoGlint for faces of thin parts, which have no glint.
  };

  struct Edge {
    Vec3 middle = Vec3::Zero();      ///< In the frame of its group [m].
    Vec3 along = Vec3::UnitY();      ///< Unit vector.
    double half = 0;                 ///< Half the length [m].
    double apart = 0;                ///< Distance of the two close edges that are joined in it, < kFree [m].
    double exterior = 2;             ///< Exterior angle over pi: n of wedge_backscatter(), in (1, 2].
    std::array<Side, 2> sides = {};  ///< The two sides of a plate at its border.
  };

  /// Edges of one moving instance in the frame of its mesh, or of all static instances, also as arrays for vector
  /// loops.
  struct Group {
    int instance = -1;           ///< -1: all static instances.
    Vec3 origin = Vec3::Zero();  ///< Origin of the static edges' frame, whose axes are the world's [m].
    std::vector<Edge> edges;
    std::vector<float> middle_x, middle_y, middle_z;  ///< [edge], like all of these [m].
    std::vector<float> along_x, along_y, along_z;
    std::vector<float> first_x, first_y, first_z;     ///< Normals of the first face.
    std::vector<float> second_x, second_y, second_z;  ///< Normals of the second face.
    std::vector<float> half;
  };
  std::vector<Group> groups;
  std::size_t left_out = 0;  ///< Edges beyond kMost.

  [[nodiscard]] bool any() const { return !groups.empty(); }
  [[nodiscard]] std::size_t most_of_a_group() const;

  /// Pose of a group's frame.
  [[nodiscard]] static Pose frame(const Group& group, const Placement& placement) {
    return group.instance < 0 ? Pose{.position = group.origin} : placement[group.instance];
  }
};

/// Finds the edges of a scene. Edges that something else touches are left out, such as those of a box on a floor, or of
/// parts of a body that touch without common vertices.
/// @param engine  Has the scene; its rays test whether edges are free.
[[nodiscard]] StraightEdges find_straight_edges(const Scene& scene, const GlintingFaces& faces, Engine& engine);

}  // namespace insonify
