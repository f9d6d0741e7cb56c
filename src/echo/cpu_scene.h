// cpu_scene.h -- a Scene as Embree holds it, with what shading needs beside it.

#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <vector>

#include "echo/echo.h"
#include "insonify/scene.h"

namespace insonify {

/// What stands still is one Embree geometry an instance, its vertices already in place; what moves is an Embree
/// instance of a scene of its own, so that moving it rebuilds nothing but the top of the tree.
class CpuScene {
 public:
  CpuScene();
  ~CpuScene();
  CpuScene(const CpuScene&) = delete;
  CpuScene& operator=(const CpuScene&) = delete;

  void set(const Scene& scene);
  void move(int instance, const Pose& world_from_mesh);

  /// Makes the moves since the last call count for the rays that follow.
  void commit_moves();

  [[nodiscard]] RTCScene handle() const { return scene_; }

  /// World position that Embree's coordinates are relative to: single precision goes to where the scene is.
  [[nodiscard]] const Vec3& origin() const { return origin_; }

  [[nodiscard]] const std::vector<float>& reflectivity() const { return reflectivity_; }

  /// Bytes kept beside the meshes themselves and what Embree allocates.
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] std::size_t embree_bytes() const { return static_cast<std::size_t>(embree_bytes_.load()); }

  /// A hit's surface and its shading normal, neither of unit length nor on any particular side.
  struct Shading {
    Vec3f normal;
    SurfaceLabel surface;
  };
  [[nodiscard]] Shading shade(unsigned geometry, unsigned instance, unsigned triangle, float u, float v) const {
    const bool moves = instance != RTC_INVALID_GEOMETRY_ID;
    const Part& part = parts_[moves ? instance : geometry];
    const auto& corners = part.triangles[triangle];
    const Vec3f normal =
        (1 - u - v) * part.normals[corners[0]] + u * part.normals[corners[1]] + v * part.normals[corners[2]];
    const std::uint16_t slot = part.slots == nullptr ? std::uint16_t{0} : part.slots[triangle];
    return {moves ? Vec3f(part.rotation * normal) : normal, part.surfaces[slot]};
  }

 private:
  // One instance of the scene.
  struct Part {
    const std::array<std::uint32_t, 3>* triangles = nullptr;
    const Vec3f* normals = nullptr;  // In the world; of a moving part in its own frame.
    const std::uint16_t* slots = nullptr;
    std::vector<SurfaceLabel> surfaces;                      // Of each slot.
    Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();  // Of a moving part.
    std::vector<Vec3f> own_vertices, own_normals;
    RTCScene own_scene = nullptr;
    RTCGeometry placed = nullptr;  // The Embree instance of a moving part.
  };

  void clear();
  void add_still(const Instance& instance, unsigned id);
  void add_moving(const Instance& instance, unsigned id);
  RTCGeometry make_triangles(const Mesh& mesh, const std::vector<Vec3f>& vertices);

  std::atomic<std::ptrdiff_t> embree_bytes_ = 0;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::vector<Part> parts_;
  std::vector<float> reflectivity_;
  Vec3 origin_ = Vec3::Zero();
  bool moved_ = false;
};

}  // namespace insonify
