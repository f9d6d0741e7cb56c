// gpu_scene.cpp -- uploads meshes with their trees, and places instances.

#include "echo/gpu/gpu_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "echo/gpu/shader_values.h"
#include "echo/grid/echo.h"
#include "echo/mirror/water_path.h"

namespace insonify {
namespace {

LeafBox box_of(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3f &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]], &c = mesh.vertices[triangle[2]];
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

// Triangles in the order of the leaves.
std::vector<shader::TreeTriangle> triangles_of(const Mesh& mesh, const std::vector<std::uint32_t>& order) {
  std::vector<shader::TreeTriangle> triangles;
  triangles.reserve(order.size());
  for (const std::uint32_t index : order) {
    const auto& corners = mesh.triangles[index];
    const Vec3f& first = mesh.vertices[corners[0]];
    triangles.push_back(
        {plain(first), index, plain(first - mesh.vertices[corners[1]]), plain(mesh.vertices[corners[2]] - first)});
  }
  return triangles;
}

shader::mat3x4 columns_of(const Eigen::Matrix3d& rotation, const Vec3& offset) {
  shader::mat3x4 columns;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      columns.values[3 * column + row] = static_cast<float>(column < 3 ? rotation(row, column) : offset[row]);
    }
  }
  return columns;
}

// The box around a box that is turned and moved. A little larger than it need be, since shaders compute in single
// precision.
LeafBox moved_box(const LeafBox& box, const Pose& scene_from_mesh) {
  const Vec3 half = 0.5 * (box.high - box.low).cast<double>(), middle = 0.5 * (box.high + box.low).cast<double>();
  const Eigen::Matrix3d rotation = scene_from_mesh.orientation.toRotationMatrix();
  const Vec3 reach = rotation.cwiseAbs() * half, at = scene_from_mesh * middle;
  const double slack = 1e-6 * (at.cwiseAbs().maxCoeff() + reach.maxCoeff());
  const Vec3 around = reach + Vec3::Constant(slack);
  return {(at - around).cast<float>(), (at + around).cast<float>()};
}

template <typename Value>
std::size_t bytes_of(const std::vector<Value>& values) {
  return values.size() * sizeof(Value);
}

}  // namespace

GpuMesh::GpuMesh(gpu::Device& device, std::shared_ptr<const Mesh> of, const std::shared_ptr<const MeshFaces>& plane)
    : mesh(std::move(of)) {
  std::vector<LeafBox> boxes;
  boxes.reserve(mesh->triangles.size());
  box = {Vec3f::Constant(INFINITY), Vec3f::Constant(-INFINITY)};
  for (const auto& triangle : mesh->triangles) {
    boxes.push_back(box_of(*mesh, triangle));
    box = {box.low.cwiseMin(boxes.back().low), box.high.cwiseMax(boxes.back().high)};
  }
  const Tree tree = build_tree(boxes, kMostInLeaf, TreeDepth::kTriangles);
  gpu::upload(device, tree.nodes, nodes);
  gpu::upload(device, triangles_of(*mesh, tree.order), triangles);
  gpu::upload(device, mesh->triangles, corners);
  gpu::upload(device, mesh->vertices, vertices);
  gpu::upload(device, mesh->normals, normals);
  if (plane != nullptr && !plane->faces.empty()) {
    gpu::upload(device, plane->face_of, face_of);
    gpu::upload(device, planes_of(*mesh, *plane), faces);
  }
  if (!mesh->material_slots.empty()) {
    gpu::upload(device, std::vector<std::uint32_t>(mesh->material_slots.begin(), mesh->material_slots.end()), slots);
  }
}

// The plane faces as shaders have them.
std::vector<shader::PlaneFace> GpuMesh::planes_of(const Mesh& mesh, const MeshFaces& plane) {
  std::vector<shader::PlaneFace> faces;
  for (const Face& face : plane.faces) {
    faces.push_back({plain(mesh.vertices[face.corner]),
                     {plain(face.axes[0]), plain(face.axes[1])},
                     {face.middle[0], face.middle[1]},
                     {face.half[0], face.half[1]}});
  }
  return faces;
}

std::size_t GpuMesh::bytes() const {
  return nodes.bytes() + triangles.bytes() + corners.bytes() + vertices.bytes() + normals.bytes() + slots.bytes() +
         face_of.bytes() + faces.bytes();
}

void GpuScene::set(const Scene& scene, bool paper, Workers& workers) {
  scene_ = &scene;
  ++number_;
  left_out_.clear();
  left_out_of_.clear();
  placement_.reset();
  origin_ = scene.middle();
  mesh_of_.clear();
  first_surface_.clear();
  std::map<const Mesh*, std::unique_ptr<GpuMesh>> kept;
  std::vector<std::uint32_t> surfaces;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    first_surface_.push_back(surfaces.size());
    for (const std::uint16_t material : instance.materials) {
      surfaces.push_back(surface_label(static_cast<std::uint16_t>(i), material));
    }
    mesh_of_.push_back(nullptr);
    if (!instance.present) {
      continue;
    }
    std::unique_ptr<GpuMesh>& mesh = kept[instance.mesh.get()];
    if (mesh == nullptr) {
      std::unique_ptr<GpuMesh>& before = meshes_[instance.mesh.get()];
      mesh = before != nullptr ? std::move(before)
                               : std::make_unique<GpuMesh>(device_, instance.mesh,
                                                           paper ? nullptr : shared_faces(instance.mesh, workers));
    }
    mesh_of_.back() = mesh.get();
  }
  meshes_ = std::move(kept);
  gpu::upload(device_, surfaces, surfaces_);
  reliefs_.set(device_, scene);
}

shader::PlacedMesh GpuScene::placed_mesh(std::size_t instance, const Pose& world_from_mesh) const {
  const GpuMesh& mesh = *mesh_of_[instance];
  const Eigen::Matrix3d rotation = world_from_mesh.orientation.toRotationMatrix();
  const Vec3 offset = world_from_mesh.position - origin_;
  return {columns_of(rotation.transpose(), -(rotation.transpose() * offset)),
          columns_of(rotation, offset),
          mesh.nodes.address(),
          mesh.triangles.address(),
          mesh.corners.address(),
          mesh.vertices.address(),
          mesh.normals.address(),
          mesh.slots.address(),
          surfaces_.address() + first_surface_[instance] * sizeof(std::uint32_t),
          instance < left_out_of_.size() ? left_out_of_[instance].first : 0,
          instance < left_out_of_.size() ? left_out_of_[instance].second : 0,
          mesh.face_of.address(),
          mesh.faces.address(),
          reliefs_.tiles(instance),
          reliefs_.texture(instance)};
}

void GpuScene::leave_out(const LeftOut* left_out) {
  left_out_.clear();
  left_out_of_.assign(left_out == nullptr ? 0 : scene_->instances.size(), {});
  ++number_;  // Placements hold the tables' addresses.
  const auto address_of = [&](const auto& tables, std::size_t instance, auto to_upload) -> std::uint64_t {
    if (instance >= tables.size() || tables[instance] == nullptr) {
      return 0;
    }
    gpu::Buffer& buffer = left_out_[tables[instance].get()];
    if (buffer.address() == 0) {
      gpu::upload(device_, to_upload(*tables[instance]), buffer);
    }
    return buffer.address();
  };
  for (std::size_t i = 0; i < left_out_of_.size(); ++i) {
    left_out_of_[i] = {address_of(left_out->thickness, i, [](const std::vector<float>& table) { return table; }),
                       address_of(left_out->glinting, i, [](const std::vector<std::uint8_t>& table) {
                         return std::vector<std::uint32_t>(table.begin(), table.end());
                       })};
  }
}

void GpuScene::place(const Placement* placement, GpuPlacement& placed) const {
  if (placement == nullptr && placement_) {
    placement = &*placement_;
  }
  static const std::vector<Placement::Moved> kNone;
  const std::vector<Placement::Moved>& moved = placement == nullptr ? kNone : placement->moved;
  if (placed.scene == number_ && placed.moved == moved) {
    return;
  }
  std::vector<LeafBox> boxes;
  std::vector<std::uint32_t> instances;
  std::vector<shader::PlacedMesh> meshes(scene_->instances.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (mesh_of_[i] == nullptr) {
      continue;
    }
    const Pose& pose = placement == nullptr ? scene_->instances[i].world_from_mesh : (*placement)[static_cast<int>(i)];
    meshes[i] = placed_mesh(i, pose);
    boxes.push_back(moved_box(mesh_of_[i]->box, {pose.position - origin_, pose.orientation}));
    instances.push_back(static_cast<std::uint32_t>(i));
  }
  Tree tree = build_tree(boxes, 1, TreeDepth::kInstances);
  for (std::uint32_t& leaf : tree.order) {
    leaf = instances[leaf];
  }
  gpu::BufferLayout layout;
  const std::size_t head = layout.take(sizeof(shader::PlacedScene)), nodes = layout.take(bytes_of(tree.nodes)),
                    leaves = layout.take(bytes_of(tree.order)), places = layout.take(bytes_of(meshes));
  std::byte* const to = placed.buffer.refill(device_, layout.end());
  const std::uint64_t at = placed.address();
  const WaterPlane water = WaterPlane::of(*scene_, origin_);
  const shader::PlacedScene scene = {at + nodes, at + leaves, at + places, static_cast<float>(water.level),
                                     water.label};
  std::memcpy(to + head, &scene, sizeof(scene));
  std::memcpy(to + nodes, tree.nodes.data(), bytes_of(tree.nodes));
  std::memcpy(to + leaves, tree.order.data(), bytes_of(tree.order));
  std::memcpy(to + places, meshes.data(), bytes_of(meshes));
  placed.scene = number_;
  placed.moved = moved;
}

std::size_t GpuScene::bytes() const {
  std::size_t sum = surfaces_.bytes() + reliefs_.bytes();
  for (const auto& [of, mesh] : meshes_) {
    sum += mesh->bytes();
  }
  return sum;
}

}  // namespace insonify
