// raster_scene.h -- the triangles of a Scene for the fan rasteriser, in blocks of sixteen and clusters of neighbours.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/grid/echo.h"
#include "insonify/scene.h"

namespace insonify {

inline constexpr int kBlockSize = 16;

/// Corners of sixteen triangles, as arrays of coordinates: [corner][triangle]. The last block of a cluster is padded
/// with copies of its last triangle.
struct TriangleBlock {
  float x[3][kBlockSize], y[3][kBlockSize], z[3][kBlockSize];
};

/// Bounding sphere.
struct Sphere {
  Vec3f centre = Vec3f::Zero();
  float radius = 0;

  /// Bounding sphere of a box, enlarged for rounding.
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

/// Static instances have coordinates relative to the middle of the scene, moving ones those of their mesh.
class RasterScene {
 public:
  /// The scene must outlive this object or the next call.
  void set(const Scene& scene);
  void move(int instance, const Pose& world_from_mesh);

  [[nodiscard]] const std::vector<TriangleCluster>& clusters() const { return clusters_; }
  [[nodiscard]] const std::vector<TriangleBlock>& blocks() const { return blocks_; }
  [[nodiscard]] const Vec3& origin() const { return origin_; }

  /// Index in the instance's mesh of the triangle in a lane of a block.
  [[nodiscard]] std::uint32_t triangle(std::uint32_t block, int lane) const {
    return triangles_[static_cast<std::size_t>(block) * kBlockSize + lane];
  }

  [[nodiscard]] int instance(std::uint32_t block) const { return block_instances_[block]; }

  struct Part {
    const Mesh* mesh = nullptr;
    Pose scene_from_part;                // Identity for static instances.
    Eigen::Matrix3f turn;                // Rotation of the mesh's normals into the world frame.
    std::vector<SurfaceLabel> surfaces;  // [material slot]
    bool moving = false;
    Sphere sphere;                                      // Around all clusters.
    std::uint32_t first_cluster = 0, last_cluster = 0;  // [first, last)
  };
  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  [[nodiscard]] float reflectivity(SurfaceLabel surface) const { return reflectivity_[material_of(surface)]; }

  /// Bytes of memory in use.
  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] Pose relative(Pose world_from_mesh) const {
    world_from_mesh.position -= origin_;
    return world_from_mesh;
  }
  void add(const Instance& instance, int index);
  Eigen::AlignedBox3f add_cluster(int instance, const Mesh& mesh, std::span<const Vec3f> vertices,
                                  std::span<const std::uint32_t> triangles);

  Vec3 origin_ = Vec3::Zero();
  std::vector<Part> parts_;
  std::vector<TriangleCluster> clusters_;
  std::vector<TriangleBlock> blocks_;
  std::vector<std::uint32_t> triangles_;  // [block][lane]
  std::vector<int> block_instances_;
  std::vector<float> reflectivity_;
};

}  // namespace insonify
