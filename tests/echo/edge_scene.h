// edge_scene.h -- bodies whose straight edges are known, and the edges that are found.

#pragma once

#include <memory>
#include <vector>

#include "echo/targets/straight_edges.h"
#include "insonify/mesh.h"
#include "support/test_engine.h"

namespace insonify::edge_scene {

inline Workers workers(2);

/// A mesh at a place, of the default material.
struct Body {
  Mesh mesh;
  Pose pose = {};
  double rms_height = 1e-5;  ///< Roughness of its surface [m].
  bool moving = false;
};

inline Scene scene_of(std::vector<Body> bodies) {
  Scene scene;
  for (Body& body : bodies) {
    Instance instance;
    instance.name = "body";
    instance.mesh = std::make_shared<const Mesh>(std::move(body.mesh));
    instance.world_from_mesh = body.pose;
    instance.moving = body.moving;
    instance.materials.assign(instance.mesh->material_names.size(), static_cast<std::uint16_t>(scene.materials.size()));
    Material material;
    material.rms_height = body.rms_height;
    scene.materials.push_back(material);
    scene.instances.push_back(std::move(instance));
  }
  return scene;
}

inline StraightEdges edges_of(const Scene& scene, LeftOut left_out = {}) {
  const GlintingFaces faces = find_glinting_faces(scene, left_out, workers);
  const std::unique_ptr<TestEngine> engine = test_engine("cpu", 1);
  engine->set_scene(scene);
  return find_straight_edges(scene, faces, engine->engine());
}

/// The edges of all groups, in the world's frame.
inline std::vector<StraightEdges::Edge> all_edges(const Scene& scene) {
  std::vector<StraightEdges::Edge> all;
  for (const StraightEdges::Group& group : edges_of(scene).groups) {
    for (StraightEdges::Edge edge : group.edges) {
      edge.middle += group.origin;
      all.push_back(edge);
    }
  }
  return all;
}

/// [m]
inline double total_length(const std::vector<StraightEdges::Edge>& edges) {
  double sum = 0;
  for (const StraightEdges::Edge& edge : edges) {
    sum += 2 * edge.half;
  }
  return sum;
}

/// Two triangles with a normal of their own.
inline void add_rectangle(Mesh& mesh, const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3f& corner : {a, b, c, d}) {
    mesh.vertices.push_back(corner);
    mesh.normals.emplace_back((b - a).cross(c - a).normalized());
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// A box of steps x steps squares a face.
inline Mesh tessellated_box(const Vec3f& size, int steps) {
  Mesh mesh;
  const auto at = [&](int axis, int side, int i, int j) {
    Vec3f place;
    const auto count = static_cast<float>(steps);
    place[axis] = static_cast<float>(side) * size[axis];
    place[(axis + 1) % 3] = static_cast<float>(i) / count * size[(axis + 1) % 3];
    place[(axis + 2) % 3] = static_cast<float>(j) / count * size[(axis + 2) % 3];
    return Vec3f(place - 0.5F * size);
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; j < steps; ++j) {
        add_rectangle(mesh, at(axis, 1, i, j), at(axis, 1, i + 1, j), at(axis, 1, i + 1, j + 1), at(axis, 1, i, j + 1));
        add_rectangle(mesh, at(axis, 0, i, j), at(axis, 0, i, j + 1), at(axis, 0, i + 1, j + 1), at(axis, 0, i + 1, j));
      }
    }
  }
  return mesh;
}

}  // namespace insonify::edge_scene
