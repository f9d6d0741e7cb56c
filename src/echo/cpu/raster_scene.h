// raster_scene.h -- a Scene's triangles as the fan rasteriser reads them: sixteen side by side, near ones together.

#pragma once

#include <cstdint>
#include <vector>

#include "echo/grid/echo.h"
#include "insonify/scene.h"

namespace insonify {

inline constexpr int kBlockSize = 16;

/// Corners of sixteen triangles, coordinate by coordinate. The last block of a cluster is filled up with its last
/// triangle.
struct TriangleBlock {
  float x[3][kBlockSize], y[3][kBlockSize], z[3][kBlockSize];
};

/// Holds things, in the coordinates that they have.
struct Sphere {
  Vec3f centre = Vec3f::Zero();
  float radius = 0;

  /// Around a box, rounding included.
  static Sphere around(const Vec3f& low, const Vec3f& high) {
    return {0.5F * (low + high), 0.5F * (high - low).norm() * 1.0001F};
  }
};

/// A few neighbouring triangles of one instance.
struct TriangleCluster {
  Sphere sphere;
  int instance = 0;
  std::uint32_t first_block = 0;
  std::uint32_t triangle_count = 0;
};

/// What stands still lies in the world's coordinates, relative to the middle of the scene; what moves in its mesh's.
class RasterScene {
 public:
  /// The scene must outlive this or the next call.
  void set(const Scene& scene);
  void move(int instance, const Pose& world_from_mesh);

  [[nodiscard]] const std::vector<TriangleCluster>& clusters() const { return clusters_; }
  [[nodiscard]] const std::vector<TriangleBlock>& blocks() const { return blocks_; }
  [[nodiscard]] const Vec3& origin() const { return origin_; }

  /// Of the lane of a block: which triangle of the instance's mesh it is.
  [[nodiscard]] std::uint32_t triangle(std::uint32_t block, int lane) const {
    return triangles_[static_cast<std::size_t>(block) * kBlockSize + lane];
  }

  [[nodiscard]] int instance(std::uint32_t block) const { return block_instances_[block]; }

  struct Part {
    const Mesh* mesh = nullptr;
    Pose scene_from_part;                // Identity for what stands still.
    Eigen::Matrix3f turn;                // Of the mesh's normals into the scene's frame.
    std::vector<SurfaceLabel> surfaces;  // Of each slot.
    bool moving = false;
    Sphere sphere;                                      // Around all of it.
    std::uint32_t first_cluster = 0, last_cluster = 0;  // [first, last)
  };
  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  [[nodiscard]] float reflectivity(SurfaceLabel surface) const { return reflectivity_[material_of(surface)]; }

  /// Bytes kept.
  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] Pose relative(Pose world_from_mesh) const {
    world_from_mesh.position -= origin_;
    return world_from_mesh;
  }
  void add(const Instance& instance, int index);

  Vec3 origin_ = Vec3::Zero();
  std::vector<Part> parts_;
  std::vector<TriangleCluster> clusters_;
  std::vector<TriangleBlock> blocks_;
  std::vector<std::uint32_t> triangles_;  // [block][lane]
  std::vector<int> block_instances_;
  std::vector<float> reflectivity_;
};

}  // namespace insonify
