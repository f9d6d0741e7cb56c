// gpu_scene.h -- a Scene on a device: meshes once each, and instances where a ping has them.

#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "echo/batch/ping_view.h"
#include "echo/gpu/gpu_reliefs.h"
#include "echo/gpu/shaders/layout.h"
#include "echo/gpu/tree.h"
#include "echo/mirror/faces.h"
#include "echo/model/left_out.h"
#include "gpu/device.h"
#include "gpu/staged.h"
#include "insonify/scene.h"

namespace insonify {

/// A mesh and its tree, in the mesh's frame.
struct GpuMesh {
  /// @param faces  Null for the paper's model, which has none.
  GpuMesh(gpu::Device& device, std::shared_ptr<const Mesh> of, const std::shared_ptr<const MeshFaces>& faces);

  std::shared_ptr<const Mesh> mesh;
  LeafBox box;
  gpu::Buffer nodes, triangles, corners, vertices, normals, slots, face_of, faces;
  [[nodiscard]] std::size_t bytes() const;

 private:
  static std::vector<shader::PlaneFace> planes_of(const Mesh& mesh, const MeshFaces& plane);
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
  /// @param paper  For the paper's model alone, which needs no plane faces.
  void set(const Scene& scene, bool paper, Workers& workers);

  /// Sets the primary echoes that are left out, until the next set(). Null: none.
  void leave_out(const LeftOut* left_out);

  /// Moves the instances to where a placement has them, until the next call or set().
  void move(const Placement& placement) { placement_ = placement; }

  /// Puts the instances where a placement has them; null: where move() has them. Commands that use it must copy its
  /// buffer first; nothing is done where they are there already.
  void place(const Placement* placement, GpuPlacement& placed) const;

  /// World position that the device's coordinates are relative to, so that single precision suffices.
  [[nodiscard]] const Vec3& origin() const { return origin_; }

  /// Whether any surface has a relief.
  [[nodiscard]] bool has_relief() const { return reliefs_.any(); }

  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] shader::PlacedMesh placed_mesh(std::size_t instance, const Pose& world_from_mesh) const;

  gpu::Device& device_;
  const Scene* scene_ = nullptr;
  std::uint64_t number_ = 0;  // Calls of set() and leave_out().
  Vec3 origin_ = Vec3::Zero();
  std::map<const Mesh*, std::unique_ptr<GpuMesh>> meshes_;
  std::optional<Placement> placement_;   // By move().
  std::vector<const GpuMesh*> mesh_of_;  // [instance]; null where it is not present.
  GpuReliefs reliefs_;
  gpu::Buffer surfaces_;                                              // All instances', slot by slot.
  std::vector<std::size_t> first_surface_;                            // [instance]
  std::map<const void*, gpu::Buffer> left_out_;                       // By the host's table.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> left_out_of_;  // [instance] thickness, glinting; 0: none.
};

}  // namespace insonify
