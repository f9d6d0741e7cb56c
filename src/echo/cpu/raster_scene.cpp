// raster_scene.cpp -- sorts triangles along a space-filling curve, so that neighbours share a cluster.

#include "echo/cpu/raster_scene.h"

#include <algorithm>
#include <bit>

namespace insonify {
namespace {

constexpr std::size_t kClusterSize = 64;
static_assert(kClusterSize % kBlockSize == 0);

// Inserts two zero bits after each of the ten lowest bits.
std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ffU;
  x = (x | x << 8) & 0x0300f00fU;
  x = (x | x << 4) & 0x030c30c3U;
  return (x | x << 2) & 0x09249249U;
}

// Position of a point on the Z-order curve through a box (Morton, 1966): points close on the curve are close in space.
std::uint32_t morton_code(const Vec3f& point, const Vec3f& low, const Vec3f& scale) {
  std::uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float cell = std::clamp((point[axis] - low[axis]) * scale[axis], 0.0F, 1023.0F);
    code |= spread_bits(static_cast<std::uint32_t>(cell)) << axis;
  }
  return code;
}

// Indices of a mesh's triangles in the order of their centres on that curve.
std::vector<std::uint32_t> near_order(const Mesh& mesh, const std::vector<Vec3f>& vertices) {
  Vec3f low = vertices.front(), high = low;
  for (const Vec3f& vertex : vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const Vec3f scale = 1023.0F * (high - low).cwiseMax(1e-20F).cwiseInverse();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> codes;
  codes.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const Vec3f middle = (vertices[corners[0]] + vertices[corners[1]] + vertices[corners[2]]) / 3;
    codes.emplace_back(morton_code(middle, low, scale), t);
  }
  std::ranges::sort(codes);
  std::vector<std::uint32_t> order;
  order.reserve(codes.size());
  for (const auto& [code, triangle] : codes) {
    order.push_back(triangle);
  }
  return order;
}

}  // namespace

void RasterScene::set(const Scene& scene) {
  parts_.clear();
  clusters_.clear();
  blocks_.clear();
  triangles_.clear();
  block_instances_.clear();
  reflectivity_.clear();
  for (const Material& material : scene.materials) {
    reflectivity_.push_back(static_cast<float>(material.effective_reflectivity()));
  }
  origin_ = scene.middle();
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (scene.instances[i].present) {
      add(scene.instances[i], static_cast<int>(i));
    } else {
      parts_.emplace_back();
    }
  }
}

void RasterScene::add(const Instance& instance, int index) {
  const Mesh& mesh = *instance.mesh;
  Part& part = parts_.emplace_back();
  part.mesh = &mesh;
  part.moving = instance.moving;
  part.turn = instance.world_from_mesh.orientation.toRotationMatrix().cast<float>();
  if (instance.moving) {
    part.scene_from_part = relative(instance.world_from_mesh);
  }
  for (const std::uint16_t material : instance.materials) {
    part.surfaces.push_back(surface_label(static_cast<std::uint16_t>(index), material));
  }

  std::vector<Vec3f> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vec3f& vertex : mesh.vertices) {
    vertices.push_back(
        instance.moving ? vertex : (instance.world_from_mesh * vertex.cast<double>().eval() - origin_).cast<float>());
  }
  const std::vector<std::uint32_t> order = near_order(mesh, vertices);
  Eigen::AlignedBox3f box;
  part.first_cluster = static_cast<std::uint32_t>(clusters_.size());
  for (std::size_t first = 0; first < order.size(); first += kClusterSize) {
    const std::size_t count = std::min(order.size() - first, kClusterSize);
    box.extend(add_cluster(index, mesh, vertices, std::span(order).subspan(first, count)));
  }
  part.last_cluster = static_cast<std::uint32_t>(clusters_.size());
  part.sphere = Sphere::around(box.min(), box.max());
}

// Adds a cluster of the given triangles, and returns the box around it. The last triangle fills up the last block.
Eigen::AlignedBox3f RasterScene::add_cluster(int instance, const Mesh& mesh, std::span<const Vec3f> vertices,
                                             std::span<const std::uint32_t> triangles) {
  TriangleCluster& cluster = clusters_.emplace_back();
  cluster.instance = instance;
  cluster.first_block = static_cast<std::uint32_t>(blocks_.size());
  cluster.triangle_count = static_cast<std::uint32_t>(triangles.size());
  Eigen::AlignedBox3f box;
  for (std::size_t first = 0; first < triangles.size(); first += kBlockSize) {
    TriangleBlock& block = blocks_.emplace_back();
    block_instances_.push_back(instance);
    for (std::size_t lane = 0; lane < kBlockSize; ++lane) {
      const std::uint32_t triangle = triangles[std::min(triangles.size() - 1, first + lane)];
      triangles_.push_back(triangle);
      for (int k = 0; k < 3; ++k) {
        const Vec3f& corner = vertices[mesh.triangles[triangle][k]];
        block.x[k][lane] = corner.x();
        block.y[k][lane] = corner.y();
        block.z[k][lane] = corner.z();
        box.extend(corner);
      }
    }
  }
  cluster.sphere = Sphere::around(box.min(), box.max());
  return box;
}

void RasterScene::move(int instance, const Pose& world_from_mesh) {
  parts_[instance].scene_from_part = relative(world_from_mesh);
  parts_[instance].turn = world_from_mesh.orientation.toRotationMatrix().cast<float>();
}

std::size_t RasterScene::bytes() const {
  return clusters_.capacity() * sizeof(TriangleCluster) + blocks_.capacity() * sizeof(TriangleBlock) +
         triangles_.capacity() * sizeof(std::uint32_t) + block_instances_.capacity() * sizeof(int);
}

}  // namespace insonify
