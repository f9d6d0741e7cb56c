// gpu_scene.h -- a Scene on a device: meshes once each, and instances where a ping has them.

#pragma once

#include <map>
#include <memory>
#include <vector>

#include "echo/batch/ping_view.h"
#include "echo/gpu/shaders/layout.h"
#include "echo/gpu/tree.h"
#include "gpu/device.h"
#include "gpu/staged.h"
#include "insonify/scene.h"

namespace insonify {

/// A mesh and its tree, in the mesh's frame.
struct GpuMesh {
  GpuMesh(gpu::Device& device, std::shared_ptr<const Mesh> of);

  std::shared_ptr<const Mesh> mesh;
  LeafBox box;
  gpu::Buffer nodes, triangles, corners, vertices, normals, slots;
  [[nodiscard]] std::size_t bytes() const;
};

/// The instances of a scene in one placement: the tree over them, and where each is.
struct GpuPlacement {
  gpu::StagedBuffer buffer;
  std::uint64_t scene = 0;  ///< Number of the scene, see GpuScene::place(); 0: none.
  std::vector<Placement::Moved> moved = {};

  /// Address of the shader::PlacedScene.
  [[nodiscard]] std::uint64_t address() const { return buffer.address(); }
};

class GpuScene {
 public:
  explicit GpuScene(gpu::Device& device) : device_(device) {}

  /// Uploads meshes that the device does not hold yet, and drops those that are gone. The scene must outlive this or
  /// the next call.
  void set(const Scene& scene);

  /// Puts the instances where a placement has them; null: where the scene has them. Commands that use it must copy its
  /// buffer first; nothing is done where they are there already.
  void place(const Placement* placement, GpuPlacement& placed) const;

  /// World position that the device's coordinates are relative to, so that single precision suffices.
  [[nodiscard]] const Vec3& origin() const { return origin_; }

  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] shader::PlacedMesh placed_mesh(std::size_t instance, const Pose& world_from_mesh) const;

  gpu::Device& device_;
  const Scene* scene_ = nullptr;
  std::uint64_t number_ = 0;  // Of calls of set().
  Vec3 origin_ = Vec3::Zero();
  std::map<const Mesh*, std::unique_ptr<GpuMesh>> meshes_;
  std::vector<const GpuMesh*> mesh_of_;     // [instance]; null where it is not present.
  gpu::Buffer surfaces_;                    // Of all instances, slot by slot.
  std::vector<std::size_t> first_surface_;  // [instance]
};

}  // namespace insonify
