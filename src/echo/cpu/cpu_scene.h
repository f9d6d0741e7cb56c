// cpu_scene.h -- a Scene as Embree holds it, with what shading needs beside it.

#pragma once

#include <atomic>
#include <vector>

#include "echo/cpu/embree.h"
#include "echo/cpu/ray_packet.h"
#include "echo/grid/echo.h"
#include "echo/model/box_cut.h"
#include "echo/model/ray_tube.h"
#include "echo/model/reliefs.h"
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

  /// RayPacket::occlude(). Embree as GCC 12 compiles it may never return from coherent packets among instances: of a
  /// mask of 16 bits it reads 64 from its stack (github.com/RenderKit/embree/pull/574).
  void occlude(RayPacket& packet) const {
    packet.occlude(scene_, any_moving_ ? Coherence::kScattered : Coherence::kAlike);
  }

  /// Around all that is there.
  [[nodiscard]] const BoxCut& boxes() const { return boxes_; }

  /// World position that Embree's coordinates are relative to: single precision goes to where the scene is.
  [[nodiscard]] const Vec3& origin() const { return origin_; }

  /// Bytes kept beside the meshes themselves and what Embree allocates.
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] std::size_t embree_bytes() const { return static_cast<std::size_t>(embree_bytes_.load()); }

  /// What sixteen rays met. Normals are neither of unit length nor on any particular side.
  struct alignas(64) Shading {
    float normal_x[kPacketSize], normal_y[kPacketSize], normal_z[kPacketSize];
    float reflectivity[kPacketSize];    ///< 0 where nothing was met.
    float texture[kPacketSize];         ///< ReliefPoint::reflectivity, which `reflectivity` holds already.
    SurfaceLabel surface[kPacketSize];  ///< kNoSurface where nothing was met.

    [[nodiscard]] Vec3f normal(int lane) const { return {normal_x[lane], normal_y[lane], normal_z[lane]}; }
  };
  void shade(const RTCHit16& hits, Shading& shading) const;

  /// What a mirror makes of sound that meets it.
  /// @param surface, triangle  Of the mirror.
  [[nodiscard]] RayTube tube(SurfaceLabel surface, std::uint32_t triangle, const Vec3f& direction, const Vec3f& normal,
                             float range) const;

  /// The small shape of the surfaces.
  [[nodiscard]] const Reliefs& reliefs() const { return reliefs_; }

  /// What relief there is where sixteen rays met something, after shade(): changes reflectivities.
  /// @param reliefs  Of each ray; none where nothing was met.
  void add_relief(const RTCRayHit16& rays, Shading& shading, ReliefPoint* reliefs) const;

  /// The same, and bends the normals.
  void bend_normals(const RTCRayHit16& rays, Shading& shading) const;

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
  BoxCut boxes_;
  Reliefs reliefs_;
  std::vector<float> reflectivity_;
  Vec3 origin_ = Vec3::Zero();
  bool any_moving_ = false, moved_ = false;
};

}  // namespace insonify
